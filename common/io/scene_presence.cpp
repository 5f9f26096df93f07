#include "common/io/scene_presence.hpp"

#include <fmt/format.h>

#include "common/scene/body_shapes.hpp"
#include "common/scene/measure_names.hpp"

namespace galet {

std::vector<Finding> check_presence(const Scene& scene, const std::function<bool(const std::string&)>& written) {
  std::vector<Finding> findings;
  const auto exclusive = [&](const std::string& kept, const std::string& idle) {
    if (written(kept) && written(idle))
      findings.push_back({idle, fmt::format("{} and {} exclude each other", kept, idle), {kept}});
  };
  const auto idle = [&](bool has_effect, const std::string& path, const std::string& why) {
    if (!has_effect && written(path)) findings.push_back({path, fmt::format("{} {}", path, why), {"initial.kind"}});
  };
  const auto needed_in_si = [&](const std::string& path) {
    if (!scene.reduced_units && !written(path))
      findings.push_back({path, fmt::format("{} is needed with units = \"SI\"", path), {"units", "initial.kind"}});
  };
  const InitialKind kind = scene.initial.kind;
  const bool drawn = kind != InitialKind::listed && kind != InitialKind::packing && kind != InitialKind::checkpoint;
  exclusive("md.dt", "md.steps_per_contact");
  exclusive("cd.dt", "cd.dt_factor");
  if (drawn) exclusive("cell.size", "initial.solid_fraction");
  idle(drawn, "initial.solid_fraction", "has no effect on listed grains and packings");
  idle(drawn || any_shape(scene), "grains.diameter",
       "has no effect on listed grains and packings, which have their own");
  if (scene.grains.diameter.kind == SizeKind::discrete)
    idle(false, "grains.diameter.mean", "has no effect with distribution = \"discrete\"");
  if (drawn) needed_in_si("grains.diameter");
  if (!MeasureSet(scene.output.measures).has(MeasureKind::profile))
    for (const char* path :
         {"output.profile_layers", "output.profile_direction", "output.profile_centre", "output.profile_radii"})
      if (written(path))
        findings.push_back({path, fmt::format("{} needs \"profile\" in output.measures", path), {"output.measures"}});
  for (std::size_t k = 0; k < scene.grains.listed.size(); ++k) needed_in_si(fmt::format("grain[{}].diameter", k));
  if (written("grains.diameter.distribution") && scene.grains.diameter.kind != SizeKind::discrete && drawn)
    needed_in_si("grains.diameter.mean");
  return findings;
}

}  // namespace galet
