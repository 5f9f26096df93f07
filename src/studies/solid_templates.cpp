#include "src/studies/solid_templates.hpp"

#include <cmath>

#include <fmt/format.h>

#include "src/studies/scene_head.hpp"

namespace galet {

namespace {

/// Inertial times that a state is given to come to rest, at most.
constexpr double rest_time = 600, ramp_time = 20;

std::string rest_stage(const std::string& name, double equilibrium, const std::string& more,
                       const std::string& loading) {
  return fmt::format(
      "\n[[stage]]\nname = \"{}\"\n{}duration = {}\nequilibrium = {}\nloading = {{kind = \"isotropic\"{}}}\n", name,
      more, rest_time, equilibrium, loading);
}

}  // namespace

std::string assembly_scene(const SolidScene& scene, char state) {
  const SceneHead head{scene.title,    scene.engine,     3, scene.seed, units_of_pressure, scene.grains, equal_grains,
                       scene.friction, scene.restitution};
  std::string text = scene_head(head) + fmt::format(R"(normal_law = "hertz"
poisson_ratio = 0.3
stiffness_level = {}
{}
[initial]
kind = "gas"
solid_fraction = 0.3

[loading]
pressure = 1.0

[run]
samples = {}
average_from = 0.5
)",
                                                    scene.stiffness_level, scene.material, scene.samples);
  if (scene.engine == EngineKind::cd) text += "\n[cd]\ntolerance = 1e-4\n";
  if (state == 'D') return text + rest_stage("D", scene.equilibrium, "", "");
  text += rest_stage("A", scene.equilibrium, "friction = 0.0\n", "");
  if (state == 'A') return text;
  // Agnolin and Roux open all contacts by a dilation of 0.5 % and mix the grains by elastic collisions before they
  // compress with friction. Here fast shear to and fro, without friction and at that volume, does the mixing: grains
  // that only move apart and back find most of their contacts again.
  text +=
      "\n[[stage]]\nname = \"loosening\"\nduration = 1\nloading = {kind = \"drives\"}\n"
      "drive = [{component = \"isotropic\", rate = 0.005}]\n"
      "\n[[stage]]\nname = \"shaking\"\nfriction = 0.0\nduration = 20\ncycles = 5\nloading = {kind = \"drives\"}\n"
      "drive = [{component = \"xy\", rate = 0.02}]\n";
  return text + rest_stage("C", scene.equilibrium, "", "");
}

std::string compression_stages(const SolidScene& scene, const std::vector<double>& levels) {
  std::string text;
  double pressure = 1;
  for (const double level : levels) {
    const double next = std::pow(scene.stiffness_level / level, 1.5);
    text += fmt::format(
        "\n[[stage]]\nname = \"to kappa {:g}\"\nduration = {}\n"
        "loading = {{kind = \"isotropic\", pressure = {:.6g}, pressure_to = {:.6g}}}\n",
        level, ramp_time, pressure, next);
    text += rest_stage(fmt::format("kappa {:g}", level), scene.equilibrium * next, "",
                       fmt::format(", pressure = {:.6g}", next));
    pressure = next;
  }
  return text;
}

std::string triaxial_stage(double strain, double inertial_number) {
  return fmt::format(
      "\n[[stage]]\nname = \"triaxial\"\nstrain = {}\nloading = {{kind = \"triaxial\", inertial_number = {}}}\n",
      strain, inertial_number);
}

}  // namespace galet
