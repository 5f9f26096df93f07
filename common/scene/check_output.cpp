// The rules of [output]: what the measures that are asked for need.
#include <algorithm>
#include <set>

#include "common/core/near_match.hpp"
#include "common/scene/check_report.hpp"
#include "common/scene/measure_names.hpp"

namespace galet::scene_check {

namespace {

bool any_friction(const Scene& scene) {
  const auto rubs = [](const auto& spec) { return spec.friction.value_or(0) > 0; };
  return scene.material.friction > 0 || std::any_of(scene.other_materials.begin(), scene.other_materials.end(), rubs) ||
         std::any_of(scene.pairs.begin(), scene.pairs.end(), rubs);
}

void check_repeated(Report& report, const std::string& path, const std::vector<std::string>& words) {
  std::set<std::string> seen;
  for (const std::string& word : words)
    if (!seen.insert(word).second) report.add(path, fmt::format("{}: {} is there twice", path, quoted(word)));
}

}  // namespace

void check_output(Report& report) {
  const Scene& scene = report.scene;
  const OutputSpec& output = scene.output;
  const MeasureSet asked(output.measures);
  check_repeated(report, "output.measures", output.measures);
  check_repeated(report, "output.formats", output.formats);
  int periodic = 0;
  for (std::size_t a = 0; a < static_cast<std::size_t>(scene.dimension); ++a) periodic += is_periodic(scene, a) ? 1 : 0;
  const MaterialSpec& material = scene.material;
  report.rule(!asked.has(MeasureKind::friction) || any_friction(scene), "output.measures",
              "output.measures: \"friction\" needs a material with friction",
              {"material.friction", "other_material", "material_pair"});
  report.rule(!asked.has(MeasureKind::voronoi) || periodic == 0 || periodic == scene.dimension, "output.measures",
              "output.measures: \"voronoi\" needs a cell that is periodic in each direction, or in none",
              {"cell.periodic"});
  report.rule(!asked.has(MeasureKind::moduli) || periodic == scene.dimension, "output.measures",
              "output.measures: \"moduli\" needs a cell periodic in each direction", {"cell.periodic"});
  report.rule(!asked.has(MeasureKind::moduli) || material.stiffness_level || material.normal_stiffness ||
                  material.young_modulus,
              "output.measures", "output.measures: \"moduli\" needs the stiffness of [material], with cd too",
              {"material.stiffness_level", "material.normal_stiffness", "material.young_modulus"});
  report.rule(scene.dimension == 3 || output.profile_direction != Axis::z, "output.profile_direction",
              "output.profile_direction: \"z\" needs dimension = 3", {"dimension"});
  const Paths rings = {"output.profile_centre", "output.profile_radii"};
  report.components("output.profile_centre", output.profile_centre.size());
  report.rule(output.profile_centre.empty() == output.profile_radii.empty(), "output.profile_centre",
              "output.profile_centre and output.profile_radii need each other", rings);
  const bool two = output.profile_radii.size() == 2 && output.profile_radii[0] < output.profile_radii[1];
  report.rule(output.profile_radii.empty() || two, "output.profile_radii",
              "output.profile_radii: expected two radii, the smaller one first", rings);
  report.rule(output.profile_centre.empty() || (!is_periodic(scene, 0) && !is_periodic(scene, 1)),
              "output.profile_centre",
              "output.profile_centre needs a cell that is periodic in neither x nor y: rings have no images",
              {"cell.periodic"});
  report.rule(output.frames > 0 || output.formats.empty(), "output.formats", "output.formats needs output.frames",
              {"output.frames"});
}

}  // namespace galet::scene_check
