// What the contact solver costs in whole runs: steps, contacts and sweeps, time per step and per contact, the solver's
// share of it, steps that missed, for tolerances of 1e-3 and 1e-4 on the impulses (errS of a step is never above it:
// its denominator is larger).
//
//   cd_runs > cd_runs.csv        four runs, about three minutes
//
//   settling   2000 spheres, mu = 0.3, e = 0.2, fall as a gas onto a floor, wide as a column of 12, until they lie
//   there
//              (gravity, all kinds of problems between a gas and a pile at rest)
//   shear      1000 disks, mu = 0.4, e = 0.1, plane shear of the periodic cell at constant pressure, I = 0.01
// Parts of a run: `falling` and `resting` are the times before and after half of the run.
#include <cstdio>

#include <fmt/format.h>

#include "common/core/clock.hpp"
#include "common/io/scene_file.hpp"
#include "src/simulation.hpp"

namespace galet {
namespace {

constexpr const char* settling = R"(
title = "settling"
dimension = 3
seed = 3
units = "reduced"
engine = "cd"
[grains]
count = 2000
diameter = 1.0
mass = 1.0
[material]
friction = 0.3
restitution = 0.2
[initial]
kind = "gas"
[cell]
size = [12.0, 12.0, 60.0]
periodic = [true, true, false]
[[plane]]
point = [0.0, 0.0, 0.0]
normal = [0.0, 0.0, 1.0]
[loading]
gravity = [0.0, 0.0, -1.0]
pressure = 10.0
[run]
duration = 40
)";

constexpr const char* shear = R"(
title = "shear"
dimension = 2
seed = 1
units = "reduced"
engine = "cd"
[grains]
count = 1000
diameter = {distribution = "uniform", mean = 1.0, spread = 0.2}
mass = 1.0
[material]
friction = 0.4
restitution = 0.1
[initial]
kind = "gas"
solid_fraction = 0.5
[cell]
aspect = [1, 1]
[loading]
kind = "plane_shear"
pressure = 1.0
inertial_number = 0.01
[run]
strain = 1
)";

/// What the engine has spent and done so far.
struct Account {
  double seconds = 0, solving = 0;
  SolverSummary solver;
};

template <int D>
Account account(const Engine<D>& engine) {
  return {thread_seconds(), engine.profile().seconds(Stage::solve), engine.solver_summary()};
}

/// Takes `steps` steps and prints their row.
template <int D>
void part(const std::string& name, double tolerance, Engine<D>& engine, long steps) {
  const Account before = account<D>(engine);
  double contacts = 0;
  constexpr long looks = 20;
  for (long look = 0; look < looks; ++look) {
    engine.advance(steps / looks);
    contacts += static_cast<double>(engine.snapshot().contacts->size()) / looks;
  }
  const Account after = account<D>(engine);
  const double taken = static_cast<double>(after.solver.steps - before.solver.steps);
  const double per_step = (after.seconds - before.seconds) / taken;
  const double solving = (after.solving - before.solving) / taken;
  fmt::print("{},{:.0e},{:.0f},{:.0f},{:.1f},{:.3f},{:.2f},{:.0f},{},{:.1e}\n", name, tolerance, taken, contacts,
             static_cast<double>(after.solver.sweeps - before.solver.sweeps) / taken, 1e3 * per_step,
             1e6 * per_step / std::max(contacts, 1.0), 100 * solving / per_step,
             after.solver.missed - before.solver.missed, after.solver.worst_residual);
  std::fflush(stdout);
}

template <int D>
void run(const char* text, const std::vector<std::string>& parts, double tolerance) {
  Scene scene = parse_scene(text, parts[0]);
  scene.cd.tolerance = tolerance;
  Simulation<D> simulation(scene, EngineKind::cd);
  RunResult result;
  if (!simulation.prepare({}, result)) throw RunError("the gas was not compressed");
  Engine<D>& engine = simulation.engine();
  const double duration = simulation.derived().duration;
  const long steps = std::lround(duration / engine.dt() / static_cast<double>(parts.size()));
  for (const std::string& name : parts) part<D>(name, tolerance, engine, steps);
}

}  // namespace
}  // namespace galet

int main() try {
  using namespace galet;
  fmt::print(
      "part,tolerance,steps,contacts,sweeps,ms_per_step,us_per_step_and_contact,solver_percent,missed,"
      "worst_residual_so_far\n");
  for (const double tolerance : {1e-3, 1e-4}) {
    run<3>(settling, {"falling", "resting"}, tolerance);
    run<2>(shear, {"shear"}, tolerance);
  }
  return 0;
} catch (const std::exception& error) {
  fmt::print(stderr, "cd_runs: {}\n", error.what());
  return 1;
}
