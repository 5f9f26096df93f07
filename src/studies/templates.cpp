#include "src/studies/templates.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "src/engines.hpp"
#include "src/studies/scene_head.hpp"

namespace galet {

namespace {

constexpr int rows_of_a_run = 400;

std::string head_and_start(const ShearScene& scene) {
  const bool plane = scene.dimension == 2;
  SceneHead head{scene.title, scene.engine, scene.dimension};
  head.grains = scene.grains;
  if (!plane) head.diameter = equal_grains;
  head.friction = scene.friction, head.restitution = scene.restitution;
  return scene_head(head) + fmt::format(R"(stiffness_level = {}
tangential_stiffness_ratio = 0.5
{}
[initial]
kind = "gas"
solid_fraction = {}
)",
                                        scene.stiffness_level, scene.material, plane ? 0.5 : 0.3);
}

std::string stage(const std::string& name, double strain, double inertial_number, const std::string& more,
                  const std::string& loading) {
  return fmt::format(
      "\n[[stage]]\nname = \"{}\"\nstrain = {}\n{}loading = {{kind = \"plane_shear\", inertial_number = {}{}}}\n", name,
      strain, more, inertial_number, loading);
}

}  // namespace

std::string plain_number(double value) {
  if (value != 0 && (value < 0.01 || value >= 1e4)) {
    const int exponent = static_cast<int>(std::floor(std::log10(value) + 1e-9));
    return fmt::format("{:g}e{}", value / std::pow(10, exponent), exponent);
  }
  return fmt::format("{:g}", value);
}

StudyRun shear_row(const std::string& study, ShearScene scene) {
  scene.title =
      fmt::format("{}: {}, homogeneous shear, I = {:g}", study, engine_name(scene.engine), scene.inertial_number);
  return {fmt::format("{}_I_{:g}", engine_name(scene.engine), scene.inertial_number),
          scene.engine,
          {{"I", scene.inertial_number}},
          shear_scene(scene)};
}

std::vector<const StudyRow*> shear_rows(const std::vector<StudyRow>& rows, EngineKind engine) {
  std::vector<const StudyRow*> found;
  for (const StudyRow* row : rows_with(rows, engine, {}))
    if (std::isfinite(row->plan.parameter("I"))) found.push_back(row);
  return found;
}

double settled_strain(const ShearScene& scene) {
  const double edge = std::pow(scene.grains, 1.0 / scene.dimension);
  return std::max(scene.settling, 1.6 * edge * scene.inertial_number);
}

std::string shear_scene(const ShearScene& scene) {
  std::string text = head_and_start(scene);
  const bool staged = scene.slow_start > 0 || scene.dense_strain > 0 || scene.volume_strain > 0;
  text += "\n[loading]\npressure = 1.0\n";
  if (!staged) text += fmt::format("kind = \"plane_shear\"\ninertial_number = {}\n", scene.inertial_number);
  text += md_section(scene.engine, scene.contact_steps);
  if (scene.engine == EngineKind::cd)
    text += fmt::format("\n[cd]\ntolerance = 1e-3\n{}{}", scene.compliance ? "compliance = true\n" : "",
                        scene.cd_dt_factor > 0 ? fmt::format("dt_factor = {}\n", scene.cd_dt_factor) : "");
  text += fmt::format("\n[run]\nsamples = {}\n", rows_of_a_run);
  const double last = scene.volume_strain > 0 ? scene.volume_strain : scene.strain;
  text +=
      fmt::format("average_from = {:.6g}\n", (scene.volume_strain > 0 ? scene.settling : settled_strain(scene)) / last);
  if (!staged) return text + fmt::format("strain = {}\n", scene.strain);
  if (scene.slow_start > 0)
    text += stage("pressure raised", scene.slow_start * scene.inertial_number, scene.inertial_number, "",
                  ", pressure = 0.05, pressure_to = 1.0");
  // Frictionless grains under shear pack densely whatever they came from, and the fast shear takes little time.
  if (scene.dense_strain > 0)
    text += stage("dense", scene.dense_strain, std::max(scene.inertial_number, 0.01), "friction = 0.0\n", "");
  text += stage("pressure held", scene.strain, scene.inertial_number, "", "");
  if (scene.volume_strain > 0)
    text += stage("volume held", scene.volume_strain, scene.inertial_number, "", ", fixed_volume = true");
  return text;
}

}  // namespace galet
