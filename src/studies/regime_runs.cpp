#include <array>

#include <fmt/format.h>

#include "src/engines.hpp"
#include "src/studies/regimes.hpp"
#include "src/studies/scene_head.hpp"
#include "src/studies/solid_templates.hpp"
#include "src/studies/templates.hpp"

namespace galet::regimes {

namespace {

bool is_flow(Regime regime) { return regime >= Regime::critical; }

/// `elastic`: contacts of cd have a stiffness, which needs repulsive forces bounded as a whole.
std::string material_lines(const State& state, bool elastic) {
  std::string text;
  if (elastic) text += "viscous_convention = \"total\"\n";
  if (state.rolling > 0) text += fmt::format("rolling_friction = {}\n", state.rolling);
  if (state.cohesion > 0) text += fmt::format("cohesion_number = {}\n", state.cohesion);
  return text;
}

std::string flow_scene(Regime regime, EngineKind engine, const State& state, bool elastic, const std::string& title,
                       bool quick) {
  ShearScene scene;
  scene.title = title;
  scene.engine = engine;
  scene.grains = quick ? (regime == Regime::critical ? 150 : 200) : full_size_disks;
  scene.contact_steps = quick ? 0 : sparing_steps;
  scene.friction = state.friction;
  scene.restitution = state.restitution;
  scene.stiffness_level = state.stiffness_level;
  scene.inertial_number = state.inertial_number;
  scene.strain = regime == Regime::critical ? (quick ? 6 : 10) : (quick ? 16 : 60);
  if (regime == Regime::collisional) scene.strain *= 2;
  scene.settling = 2;
  scene.material = material_lines(state, elastic);
  scene.compliance = elastic;
  return shear_scene(scene);
}

/// A gas at rest is compressed at the rate I / tau_i until the pressure is P, which then holds it until it is at rest.
std::string assembly_of_disks(EngineKind engine, const State& state, bool elastic, int seed, const std::string& title,
                              bool quick) {
  SceneHead head{title, engine, 2, seed};
  head.grains = quick ? 200 : full_size_disks;
  head.friction = state.friction, head.restitution = state.restitution;
  std::string text = scene_head(head) + fmt::format(R"(stiffness_level = {}
tangential_stiffness_ratio = 0.5
{}
[initial]
kind = "gas"
solid_fraction = 0.5

[loading]
pressure = 1.0

[run]
samples = 100
)",
                                                    state.stiffness_level, material_lines(state, elastic));
  if (engine == EngineKind::cd)
    text += fmt::format("\n[cd]\ntolerance = 1e-4\n{}", elastic ? "compliance = true\n" : "");
  return text + approach_stages(state.inertial_number, 1e-6);
}

std::string solid_scene(Regime regime, EngineKind engine, const State& state, int seed, const std::string& title,
                        bool quick) {
  SolidScene scene;
  scene.title = title;
  scene.engine = engine;
  scene.grains = quick ? 120 : 4000;
  scene.contact_steps = quick ? 0 : sparing_steps;
  scene.seed = seed;
  scene.friction = state.friction;
  scene.restitution = state.restitution;
  scene.stiffness_level = state.stiffness_level;
  scene.equilibrium = 1e-6;
  scene.material = material_lines(state, false);
  if (regime == Regime::type_II) return assembly_scene(scene, 'C') + triaxial_stage(0.006, state.inertial_number);
  // Strains of the contacts, 1 / kappa, are over before a sample has answered to a rate of strain: its stress is
  // raised.
  constexpr double highest = 0.6, strain_there = 2e-4;  // at kappa = 8400
  return assembly_scene(scene, 'A') + ramp_stage(highest, strain_there / state.inertial_number);
}

}  // namespace

RegimeRow regime_row(Regime regime, StudySize size) {
  const bool quick = size == StudySize::quick;
  switch (regime) {
    case Regime::assembly:
      return {"assembly", "YNYYYY", {0.01, 1e4, 0.1, 0.3, 0, 0}, {0.1, 3e3, 0.9, 0, 0.05, 2}};
    case Regime::type_I:
      return {"solid, type I", "NYNYYY", {1e-6, 8400, 0.2, 0.3, 0, 0}, {1e-5, 39000, 0.7, 0.1, 0.05, 2}};
    case Regime::type_II:
      return {"solid, type II", "NNNYYY", {5e-4, 8400, 0.2, 0.3, 0, 0}, {1e-3, 39000, 0.7, 0.1, 0.05, 2}};
    case Regime::critical:
      return {"critical state",
              "NNNYYY",
              {quick ? 5e-3 : 1e-3, quick ? 2e3 : 1e4, 0.1, 0.4, 0, 0},
              {quick ? 1e-2 : 5e-4, quick ? 1e4 : 1e5, 0.9, 0.1, 0.05, 2}};
    case Regime::dense:
      return {"dense flow",
              "YNNYYY",
              {0.05, quick ? 2e3 : 1e4, 0.1, 0.4, 0, 0},
              {quick ? 0.02 : 0.01, quick ? 1e4 : 1e5, 0.9, 0.1, 0.05, 2}};
    case Regime::collisional:
      return {"collisional",
              "YNYYYY",
              {0.3, quick ? 2e3 : 1e4, 0.1, 0.4, 0, 0},
              {0.15, quick ? 1e4 : 1e5, 0.9, 0.1, 0.05, 2}};
  }
  return {};
}

std::vector<Quantity> quantities_of(Regime regime) {
  if (is_flow(regime)) return {{"mu*", 0.05}, {"Phi", 0.01}};
  if (regime == Regime::assembly) return {{"Phi", 0.005}, {"z*", 0.05}};
  return {{regime == Regime::type_I ? "strain from q/P = 0.1 to 0.4" : "q/P at strains of 2e-3 to 6e-3", 0.2}};
}

int samples_of(Regime regime, StudySize size) {
  if (is_flow(regime)) return 1;
  return size == StudySize::quick ? 3 : 5;
}

bool has_cell(Regime regime, EngineKind engine, int column) {
  if (engine == EngineKind::md) return true;
  return regime != Regime::type_I && !(regime == Regime::type_II && column == 1);
}

StudyRun regime_run(Regime regime, EngineKind engine, int column, int seed, StudySize size) {
  const RegimeRow row = regime_row(regime, size);
  const bool quick = size == StudySize::quick;
  State state = row.reference;
  // For cd the change of kappa is from rigid grains to elastic ones of the reference's kappa.
  const bool elastic = engine == EngineKind::cd && column == 1;
  if (column >= 0 && !elastic) state.*columns[column] = row.changed.*columns[column];
  constexpr std::array stems = {"assembly", "type_I", "type_II", "critical", "dense", "collisional"};
  constexpr std::array changes = {"I", "kappa", "e", "mu", "mu_R", "eta"};
  std::string name = fmt::format("{}_{}_{}", engine_name(engine), stems[static_cast<int>(regime)],
                                 column < 0 ? "reference" : changes[column]);
  if (!is_flow(regime)) name += fmt::format("_seed_{}", seed);
  const std::string title = "regimes: " + name;
  const std::string scene = is_flow(regime)              ? flow_scene(regime, engine, state, elastic, title, quick)
                            : regime == Regime::assembly ? assembly_of_disks(engine, state, elastic, seed, title, quick)
                                                         : solid_scene(regime, engine, state, seed, title, quick);
  const bool solid = regime == Regime::type_I || regime == Regime::type_II;
  return {
      name, engine, {{"regime", static_cast<int>(regime) + 1}, {"changed", column + 1}, {"seed", seed}}, scene, solid};
}

}  // namespace galet::regimes
