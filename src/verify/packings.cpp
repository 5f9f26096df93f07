// Packings: equilibrium to rounding, a stiffness level of 1e7, long rests, a long shear, a sudden unloading.
#include <algorithm>

#include <fmt/format.h>

#include "common/measure/balance.hpp"
#include "common/measure/block_average.hpp"
#include "common/measure/coordination.hpp"
#include "common/measure/equilibrium_matrix.hpp"
#include "common/measure/stress.hpp"
#include "src/simulation.hpp"
#include "src/verify/trial.hpp"

namespace galet::verify {

namespace {

/// Disks +-20 % compressed from a gas to P = 1.
Scene packing_scene(int count, double friction, double stiffness_level) {
  Scene scene = periodic_scene(2, count, friction, 0.3, 1);
  scene.material.normal_stiffness.reset();
  scene.material.stiffness_level = stiffness_level;
  scene.material.convention = DampingConvention::total;
  scene.grains.diameter = {SizeKind::uniform, 1, 0.2, {}, {}};
  scene.initial.kind = InitialKind::compressed_gas;
  scene.loading.kind = LoadingKind::isotropic;
  scene.loading.pressure = 1;
  scene.cd.dt = 0.02, scene.cd.tolerance = 1e-4, scene.cd.max_sweeps = 20000;
  scene.run.duration = 100;
  scene.run.samples = 20;
  return scene;
}

RunResult run(Simulation<2>& simulation, Report& report) {
  const RunResult result = simulation.run();
  report.add_steps(result.total_steps);
  if (result.ending == Ending::failed) throw RunError(result.failure);
  return result;
}

void frictionless_packing(EngineKind kind, Report& report) {
  Scene scene = packing_scene(100, 0, 1e5);
  scene.initial.friction = 0;
  scene.run.unbalanced = 1e-10;
  scene.run.stress_tolerance = 1e-6;
  scene.run.duration = 3000;
  scene.md.drag = 0.3;
  scene.cd.tolerance = 1e-11;
  scene.cd.max_sweeps = 200000;
  scene.cd.dt = 0.05;
  Simulation<2> simulation(checked(kind, scene), kind);
  run(simulation, report);
  const Snapshot<2> state = simulation.engine().snapshot();
  const std::vector<char> loose = rattlers<2>(state, false);
  report.small("unbalanced force ratio", unbalance<2>(state, loose).force, 1e-10, "asked for");
  const Indeterminacy network = indeterminacy<2>(state, {.friction = false}, {Mat<2>::Identity()});
  if (kind == EngineKind::cd)
    report.near("force indeterminacy", static_cast<double>(network.indeterminacy()), 0, 0,
                "rigid frictionless grains of unlike sizes are isostatic (Roux 2000)");
  else
    report.small("force indeterminacy / contacts", static_cast<double>(network.indeterminacy()) / network.forces, 0.03,
                 "contacts beyond isostaticity, z - 4 about 3 (kappa)^(-1/2) (O'Hern et al. 2003)");
  report.relative("pressure", stress<2>(state).total().trace() / 2, 1, 1e-6, "asked for");
}

/// P = z Phi <F_N> / (pi d) with a branch of d - h: what the mean deflection must be.
void stiff_packing(EngineKind kind, Report& report) {
  constexpr double kappa = 1e7;
  Scene scene = packing_scene(30, 0.3, kappa);
  scene.cd.compliance = true;
  scene.cd.tolerance = 1e-8;
  scene.md.drag = 0.5;
  scene.run.duration = 20;
  Simulation<2> simulation(checked(kind, scene), kind);
  run(simulation, report);
  const Snapshot<2> state = simulation.engine().snapshot();
  const Mat<2> sigma = stress<2>(state).total();
  report.relative("pressure", sigma.trace() / 2, 1, 0.01, "equilibrium of the compression");
  double force = 0, deflection = 0;
  for (std::size_t c = 0; c < state.contacts->size(); ++c)
    force += state.contacts->force[c].dot(state.contacts->normal[c]), deflection -= state.contacts->gap[c];
  report.relative("K <h> / <F_N>", kappa * deflection / force, 1, 0.01, "what still moves, by its dashpots");
  double left = kinetic_energy_of(state) / 30;
  report.small("kinetic energy per grain", left, 1e-5, "equilibrium of the compression");
}

struct Rest {
  double moved = 0, kinetic = 0;  ///< of grains with two contacts and more, their common motion taken off
  double drift = 0;               ///< how far they moved together
  double overlap = 0;
};

/// Whether a grain carries load: in two contacts with more than 1e-3 of the mean force.
std::vector<char> held_grains(const Snapshot<2>& state) {
  const ContactColumns<2>& contacts = *state.contacts;
  double mean = 0;
  for (const Vec<2>& force : contacts.force) mean += force.norm() / static_cast<double>(contacts.size());
  std::vector<int> count(state.grains(), 0);
  for (std::size_t c = 0; c < contacts.size(); ++c)
    if (contacts.force[c].norm() > 1e-3 * mean) ++count[contacts.i[c]], ++count[contacts.j[c]];
  std::vector<char> bearing(state.grains());
  for (int i = 0; i < state.grains(); ++i) bearing[i] = count[i] > 1;
  return bearing;
}

/// What changes between two states of a packing at rest. Nothing holds the packing as a whole: rattlers that fly in
/// their cages carry momentum, and as the total is zero the packing moves the other way, by 1e-5 per inertial time or
/// less. That is no creep: displacements and velocities are counted from the packing's own.
Rest compare(const std::vector<Vec<2>>& before, const Snapshot<2>& state) {
  Rest rest;
  const std::vector<char> bearing = held_grains(state);
  const Mat<2> inverse = state.cell->box.inverse();
  std::vector<Vec<2>> moved(state.grains(), Vec<2>::Zero());
  Vec<2> drift = Vec<2>::Zero(), velocity = Vec<2>::Zero();
  double mass = 0;
  for (int i = 0; i < state.grains(); ++i) {
    if (!bearing[i]) continue;
    Vec<2> shift = inverse * (state.position[i] - before[i]);
    for (int a = 0; a < 2; ++a) shift[a] -= std::round(shift[a]);
    moved[i] = state.cell->box * shift;
    mass += state.mass[i];
    drift += state.mass[i] * moved[i], velocity += state.mass[i] * state.velocity[i];
  }
  drift /= mass, velocity /= mass;
  rest.drift = drift.norm();
  for (int i = 0; i < state.grains(); ++i) {
    if (!bearing[i]) continue;
    rest.moved = std::max(rest.moved, (moved[i] - drift).norm());
    rest.kinetic += 0.5 * state.mass[i] * (state.velocity[i] - velocity).squaredNorm();
  }
  for (const double gap : state.contacts->gap) rest.overlap = std::max(rest.overlap, -gap);
  return rest;
}

void long_rest(EngineKind kind, long steps, Report& report) {
  const bool rigid = kind == EngineKind::cd;
  Scene scene = packing_scene(30, 0.5, 1e4);
  scene.material.tangential_damping_ratio = 0.2;
  scene.cd.dt = 0.02, scene.cd.tolerance = 1e-6, scene.cd.penetration = 1e-5;
  scene.run.duration = 300;
  Simulation<2> simulation(checked(kind, scene), kind);
  run(simulation, report);
  Engine<2>& engine = simulation.engine();
  const Snapshot<2> first = engine.snapshot();
  const std::vector<Vec<2>> before(first.position.begin(), first.position.end());
  const double fraction = first.cell->volume(), overlap = compare(before, first).overlap;
  engine.advance(steps);
  report.add_steps(steps);
  const Rest rest = compare(before, engine.snapshot());
  report.small("momentum", momentum<2>(engine.snapshot()).norm(), 1e-10, "rounding of each step, 1e-17, with one sign");
  report.small(
      "largest displacement, the common one taken off", rest.moved, rigid ? 1e-4 : 1e-7,
      rigid ? "corrections of the drift, 1e-5 each where needed"
            : fmt::format("modes that still decay, impacts of rattlers (the packing moved by {:.1e})", rest.drift));
  report.small("kinetic energy, the common one taken off", rest.kinetic, rigid ? 1e-10 : 1e-15,
               rigid ? "(tolerance P d dt / m)^2 per grain" : "rounding of positions times frequencies");
  report.small("change of volume / volume", engine.snapshot().cell->volume() / fraction - 1, rigid ? 1e-5 : 1e-8,
               "the same");
  if (rigid)
    report.small("largest penetration", engine.solver_summary().penetration, 1e-5, "asked for");
  else
    report.near("largest overlap", rest.overlap, overlap, 1e-8, "rounding, and modes that still decay");
}

/// mu* and Phi must not wander once the flow is steady, and the cell must stay near its least tilt.
void strain_1000(EngineKind kind, Report& report) {
  Scene scene = packing_scene(40, 0.4, 1e3);
  scene.material.restitution = 0.1;
  scene.loading.kind = LoadingKind::plane_shear;
  scene.loading.inertial_number = 0.1;
  scene.run.duration.reset();
  scene.run.strain = 1000;
  scene.run.samples = 1000;
  scene.cd.tolerance = 1e-3;
  Simulation<2> simulation(checked(kind, scene), kind);
  const RunResult result = run(simulation, report);
  const auto halves = [&](Observable observable) {
    std::vector<double> values = result.series.column(observable, result.time / 100);
    const std::size_t half = values.size() / 2;
    return std::pair{block_average(std::span(values).first(half)), block_average(std::span(values).last(half))};
  };
  report.near("strain", result.last[Observable::strain], 1000, 1e-2, "one step");
  report.relative("mean sigma_yy", result.averages[Observable::sigma_yy].value, 1, 0.01,
                  "the cell's momentum over the duration, and kinetic energy");
  for (const auto& [name, observable] :
       {std::pair{"sigma_xy", Observable::sigma_xy}, {"Phi", Observable::solid_fraction}}) {
    const auto [first, second] = halves(observable);
    const double error = std::hypot(first.error, second.error);
    report.near(fmt::format("{}, second half", name), second.value, first.value, 3 * error,
                "3 standard errors of the difference");
  }
  const Snapshot<2> state = simulation.engine().snapshot();
  report.small("tilt of the cell / its width, beyond 1/2",
               std::max(0.0, std::abs(state.cell->box(0, 1)) / state.cell->box(0, 0) - 0.5), 0.2,
               "brought back whenever the list is made anew");
  report.small("momentum per grain", momentum<2>(state).norm() / 40, 1e-9, "rounding of 1e6 steps and more");
}

/// Gravity falls to a hundredth: rigid grains carry the new weights in the next step; soft ones are thrown up by what
/// their contacts had stored, and settle.
void sudden_unloading(EngineKind kind, Report& report) {
  constexpr int n = 10;
  constexpr double less = 0.01, stiffness = 1e5;
  Scene scene = free_scene(2, 0.3, 0.1, stiffness);
  add_floor(scene);
  for (int k = 0; k < n; ++k) add_grain(scene, {0, 0.5 + k});
  scene.cd.dt = 1e-2, scene.cd.tolerance = 1e-10, scene.cd.max_sweeps = 100000;
  Trial<2> trial(report, kind, scene);
  trial.run_to(kind == EngineKind::cd ? 0.1 : 15);
  scene.loading.gravity = {0, -less};
  trial.change(scene);
  if (kind == EngineKind::cd)
    trial.advance(1);
  else
    trial.run_to(trial.time() + 60);
  double largest = 0;
  const Snapshot<2> state = trial.state();
  for (std::size_t c = 0; c < state.contacts->size(); ++c) {
    const int i = state.contacts->i[c], j = state.contacts->j[c], below = j >= n ? 0 : std::max(i, j);
    largest = std::max(largest, std::abs(std::abs(state.contacts->force[c].y()) / less - (n - below)));
  }
  const bool rigid = kind == EngineKind::cd;
  report.near("contacts", static_cast<double>(state.contacts->size()), n, 0, "none is lost");
  report.small("largest error of a force / new weight of a grain", largest, rigid ? 5e-5 : 1e-4,
               rigid ? "tolerance 1e-10 times 4700, over 0.01" : "the slowest mode is down to exp(-14)");
}

}  // namespace

std::vector<Case> packing_cases() {
  return {
      {.name = "frictionless_packing",
       .tags = {"packing", "equilibrium"},
       .effort = Effort::full,
       .scene = "100 frictionless disks +-20 % under P = 1, until the unbalanced force is 1e-10",
       .exact = "equilibrium; isostaticity of rigid frictionless grains (Roux 2000)",
       .trouble = "a residue of forces that never falls, contacts too many or too few",
       .run = frictionless_packing},
      {.name = "kappa_1e7",
       .tags = {"packing", "stiff"},
       .effort = Effort::full,
       .scene = "30 frictional disks under P = 1 at kappa = 1e7 (cd with compliance)",
       .exact = "K <h> = <F_N>, sigma = P",
       .trouble = "noise of stiff contacts, a cell that rings",
       .run = stiff_packing},
      {.name = "long_rest",
       .tags = {"packing", "drift"},
       .effort = Effort::full,
       .scene = "30 frictional disks under P = 1, at rest for 1e7 steps (md) or 1e6 (cd)",
       .exact = "nothing moves",
       .trouble = "creep, heating, penetration that grows",
       .run = [](EngineKind kind,
                 Report& report) { long_rest(kind, kind == EngineKind::md ? 10000000 : 1000000, report); }},
      {.name = "short_rest",
       .tags = {"packing", "drift"},
       .effort = Effort::full,
       .scene = "the same for 1e5 steps (md) or 1e4 (cd)",
       .exact = "nothing moves",
       .trouble = "the same",
       .run = [](EngineKind kind,
                 Report& report) { long_rest(kind, kind == EngineKind::md ? 100000 : 10000, report); }},
      {.name = "strain_1000",
       .tags = {"flow", "drift"},
       .effort = Effort::full,
       .scene = "40 disks in plane shear at I = 0.1, to a strain of 1000",
       .exact = "steady state: both halves alike; sigma_yy = P",
       .trouble = "a density or friction that wanders, a cell that tilts without end",
       .run = strain_1000},
      {.name = "sudden_unloading",
       .tags = {"statics", "column", "reversal"},
       .effort = Effort::quick,
       .scene = "a column of 10 disks whose weight falls to a hundredth at once",
       .exact = "force = new weight above",
       .trouble = "forces of before that stay, grains that fly off for good",
       .run = sudden_unloading},
  };
}

}  // namespace galet::verify
