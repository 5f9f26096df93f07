#include "src/studies/solid_templates.hpp"

#include <cmath>

#include <fmt/format.h>

#include "src/studies/scene_head.hpp"
#include "src/studies/templates.hpp"

namespace galet {

namespace {

/// Inertial times that a state is given to come to rest, at most, and in which a stress goes to its next value.
constexpr double rest_time = 600, ramp_time = 20;

std::string rest_stage(const std::string& name, double equilibrium, const std::string& more,
                       const std::string& loading) {
  return fmt::format("\n[[stage]]\nname = \"{}\"\n{}duration = {}\nequilibrium = {}\nloading = {{{}}}\n", name, more,
                     rest_time, equilibrium, loading);
}

std::string isotropic_rest(const std::string& name, double equilibrium, const std::string& more = "") {
  return rest_stage(name, equilibrium, more, "kind = \"isotropic\"");
}

/// A stress that a kind of loading calls `stress` goes from one value to another and stays there until rest.
std::string ramp_and_rest(const SolidScene& scene, const std::string& name, const std::string& kind,
                          const std::string& stress, double from, double to) {
  const std::string held = fmt::format("kind = \"{}\", {} = ", kind, stress);
  return fmt::format("\n[[stage]]\nname = \"to {}\"\nduration = {}\nloading = {{{}{:.6g}, {}_to = {:.6g}}}\n", name,
                     ramp_time, held, from, stress, to) +
         rest_stage(name, scene.equilibrium * to, "", fmt::format("{}{:.6g}", held, to));
}

/// The pressure, in units of that at the first level, at which the stiffness level is `level`.
double pressure_at(const SolidScene& scene, double level) { return std::pow(scene.stiffness_level / level, 1.5); }

std::string solid_head(const SolidScene& scene) {
  const SceneHead head{scene.title,    scene.engine,     3, scene.seed, units_of_pressure, scene.grains, equal_grains,
                       scene.friction, scene.restitution};
  std::string text =
      scene_head(head) + fmt::format(R"(normal_law = "hertz"
poisson_ratio = 0.3
stiffness_level = {}
{}{}
[initial]
kind = "gas"
solid_fraction = 0.3

[loading]
pressure = 1.0

[run]
samples = {}
average_from = 0.5
)",
                                     scene.stiffness_level, scene.material,
                                     scene.compliance ? "viscous_convention = \"total\"\n" : "", scene.samples);
  text += md_section(scene.engine, scene.contact_steps);
  if (scene.engine == EngineKind::cd)
    text += fmt::format("\n[cd]\ntolerance = {}\n{}", plain_number(scene.tolerance),
                        scene.compliance ? "compliance = true\n" : "");
  return text;
}

}  // namespace

std::string assembly_scene(const SolidScene& scene, char state) {
  std::string text = solid_head(scene);
  if (state == 'D') return text + isotropic_rest("D", scene.equilibrium);
  text += isotropic_rest("A", scene.equilibrium, "friction = 0.0\n");
  if (state == 'A') return text;
  // Agnolin and Roux open all contacts by a dilation of 0.5 % and mix the grains by elastic collisions before they
  // compress with friction. Here fast shear to and fro, without friction and at that volume, does the mixing: grains
  // that only move apart and back find most of their contacts again.
  text +=
      "\n[[stage]]\nname = \"loosening\"\nduration = 1\nloading = {kind = \"drives\"}\n"
      "drive = [{component = \"isotropic\", rate = 0.005}]\n"
      "\n[[stage]]\nname = \"shaking\"\nfriction = 0.0\nduration = 20\ncycles = 5\nloading = {kind = \"drives\"}\n"
      "drive = [{component = \"xy\", rate = 0.02}]\n";
  return text + isotropic_rest("C", scene.equilibrium);
}

std::string approach_stages(double inertial_number, double equilibrium) {
  // From the gases' solid fractions a compression of 0.3 in size is enough; 0.4 ends an approach that fails.
  return fmt::format(
      "\n[[stage]]\nname = \"approach\"\nduration = {:.6g}\nuntil = \"isotropic\"\nuntil_stress = 1.0\n"
      "loading = {{kind = \"drives\"}}\ndrive = [{{component = \"isotropic\", rate = {}}}]\n"
      "\n[[stage]]\nname = \"rest\"\nduration = 300\nequilibrium = {}\nloading = {{kind = \"isotropic\"}}\n",
      0.4 / inertial_number, -inertial_number, equilibrium);
}

std::string approach_scene(const SolidScene& scene, double inertial_number) {
  return solid_head(scene) + approach_stages(inertial_number, scene.equilibrium);
}

std::string compression_stages(const SolidScene& scene, const std::vector<double>& levels) {
  std::string text;
  double pressure = 1;
  for (const double level : levels) {
    const double next = pressure_at(scene, level);
    text += ramp_and_rest(scene, fmt::format("kappa {:g}", level), "isotropic", "pressure", pressure, next);
    pressure = next;
  }
  return text + ramp_and_rest(scene, "back", "isotropic", "pressure", pressure, 1);
}

std::string oedometric_stages(const SolidScene& scene, double level) {
  const double stress = pressure_at(scene, level);
  return ramp_and_rest(scene, "loaded", "oedometric", "axial_stress", 1, stress) +
         ramp_and_rest(scene, "unloaded", "oedometric", "axial_stress", stress, 1);
}

std::string triaxial_stage(double strain, double inertial_number, const std::string& more) {
  return fmt::format(
      "\n[[stage]]\nname = \"triaxial\"\n{}strain = {}\nloading = {{kind = \"triaxial\", inertial_number = {}}}\n",
      more, strain, inertial_number);
}

std::string ramp_stage(double deviator, double duration) {
  return fmt::format(
      "\n[[stage]]\nname = \"triaxial\"\nduration = {}\nuntil = \"zz\"\nuntil_strain = 0.02\n"
      "loading = {{kind = \"triaxial\", axial_stress = 1.0, axial_stress_to = {}}}\n",
      duration, 1 + deviator);
}

std::string creep_stage(double equilibrium) {
  return rest_stage("creep", equilibrium, "", "kind = \"triaxial\", hold_axial = true");
}

}  // namespace galet
