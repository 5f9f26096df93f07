// Fast grains, unlike sizes, and cells barely larger than a grain.
#include <algorithm>

#include <fmt/format.h>

#include "common/core/random.hpp"
#include "common/measure/stress.hpp"
#include "src/simulation.hpp"
#include "src/verify/trial.hpp"

namespace galet::verify {

namespace {

// ---- a fast grain ------------------------------------------------------------------------------------------------

/// A bed of 5 rows of 9 disks on a floor, without gravity, and a grain of diameter 0.2 that flies at it: 50 diameters
/// of its own per step of cd.
Scene bullet_scene(double stiffness) {
  Scene scene = free_scene(2, 0.3, 0.5, stiffness);
  add_plane(scene, {0, 0}, {0, 1});
  for (int row = 0; row < 5; ++row)
    for (int k = 0; k < 9; ++k) add_grain(scene, {k + 0.5 * (row % 2), 0.5 + row * std::sqrt(0.75)});
  add_grain(scene, {4.2, 8}, {3, -100}, 0.2);
  scene.cell.size = {40, 40};
  scene.cd.dt = 0.1, scene.cd.tolerance = 1e-8, scene.cd.max_sweeps = 100000;
  return scene;
}

void fast_grain(EngineKind kind, Report& report) {
  Trial<2> trial(report, kind, bullet_scene(1e9));
  const double energy = kinetic_energy(trial);
  double most = energy, overlap = 0;
  const long looks = 400, block = kind == EngineKind::cd ? 1 : std::lround(5e-3 / trial.dt());
  for (long look = 0; look < (kind == EngineKind::cd ? 20 : looks); ++look) {
    trial.advance(block);
    most = std::max(most, trial.engine().energy().total());
    for (const double gap : trial.state().contacts->gap) overlap = std::max(overlap, -gap);
  }
  const Snapshot<2> state = trial.state();
  double lowest = INFINITY;
  for (int i = 0; i < state.grains(); ++i) lowest = std::min(lowest, state.position[i].y() - state.radius[i]);
  const bool rigid = kind == EngineKind::cd;
  report.small("energy gained / energy", most / energy - 1, 1e-6, "restitution below 1: none");
  report.small("overlap left", overlap, rigid ? 1e-3 : 1e-2,
               rigid ? "penetration allowed, with the drift of one step" : "v sqrt(m/K)");
  report.small("depth below the floor", std::max(0.0, -lowest), 1e-2, "nothing tunnels");
  report.near("the bullet stays above the bed", state.position[45].y() > 4 ? 1 : 0, 1, 0,
              "it can't pass between disks that touch");
}

/// The same with contacts so soft that the bullet would cross a disk: a run must stop and say so.
void fast_grain_soft(EngineKind kind, Report& report) {
  Scene scene = bullet_scene(1e4);
  scene.run.duration = 0.5;
  scene.guard.every = 1;
  Simulation<2> simulation(checked(kind, scene), kind);
  const RunResult result = simulation.run();
  report.add_steps(result.steps);
  if (result.ending == Ending::failed) throw RunError(result.failure);
  report.small("stopped", 1, 0, "the engine went on");
}

// ---- unlike sizes ------------------------------------------------------------------------------------------------

/// Deepest overlap of two grains, or of a grain and an image, by looking at all pairs.
double deepest_overlap(const Snapshot<2>& state) {
  double deepest = 0;
  const Mat<2> inverse = state.cell->box.inverse();
  for (int i = 0; i < state.grains(); ++i)
    for (int j = i + 1; j < state.grains(); ++j) {
      Vec<2> s = inverse * (state.position[j] - state.position[i]);
      for (int a = 0; a < 2; ++a) s[a] -= std::round(s[a]);
      deepest = std::max(deepest, state.radius[i] + state.radius[j] - (state.cell->box * s).norm());
    }
  return deepest;
}

void size_ratio_50(EngineKind kind, Report& report) {
  Scene scene = periodic_scene(2, 300, 0, 1, 1e5);
  scene.grains.diameter = {SizeKind::discrete, 1, 0, {0.2, 10}, {0.99, 0.01}};
  scene.grains.diameter.mean = 0.298;
  scene.grains.density = 4 / pi;
  scene.initial.solid_fraction = 0.3;
  scene.initial.speed = 1;
  scene.seed = 4;
  scene.cd.dt = 1e-3, scene.cd.tolerance = 1e-10, scene.cd.max_sweeps = 100000;
  Trial<2> trial(report, kind, scene);
  const double start = trial.engine().energy().total();
  double worst = 0, unseen = 0, momentum_scale = 0;
  for (const double m : trial.start().mass) momentum_scale += m;
  for (int look = 0; look < 100; ++look) {
    trial.advance(kind == EngineKind::cd ? 20 : 200);
    worst = std::max(worst, std::abs(trial.engine().energy().total() / start - 1));
    double seen = 0;
    const Snapshot<2> state = trial.state();
    for (const double gap : state.contacts->gap) seen = std::max(seen, -gap);
    // An elastic rigid pair that others push together waits for the next step: it is seen in the next step's contacts.
    unseen = std::max(unseen, deepest_overlap(state) - (kind == EngineKind::cd ? 0 : seen));
  }
  const bool rigid = kind == EngineKind::cd;
  report.small(
      "largest relative error of the energy", worst, rigid ? 1e-8 : 2e-3,
      rigid ? "tolerance 1e-10 of the solver" : "(w0 dt)^4 of a contact of the lightest pair, with either sign");
  report.small("overlap that no contact knows of", unseen, rigid ? 1e-2 : 1e-6,
               rigid ? "v dt of what other contacts push together (e = 1)" : "contacts are those of the step's forces");
  report.small("momentum / mass", momentum<2>(trial.state()).norm() / momentum_scale, 1e-12, "rounding");
}

// ---- a narrow cell -----------------------------------------------------------------------------------------------

/// Nine disks in a cell 3.1 wide; the same nine in each of four cells must do the same.
Sample<2> nine(int copies) {
  constexpr double edge = 3.1;
  Sample<2> sample;
  sample.cell.box = copies * edge * Mat<2>::Identity();
  sample.cell.periodic.fill(true);
  sample.resize(9 * copies * copies);
  for (int k = 0; k < sample.count(); ++k) {
    const int grain = k % 9, image = k / 9;
    RandomStream random(17, grain);
    sample.velocity[k] = Vec<2>(random.normal(), random.normal());
    sample.position[k] =
        edge * Vec<2>(image % copies, image / copies) +
        edge / 3 * Vec<2>(grain % 3 + 0.5 + 0.02 * random.uniform(), grain / 3 + 0.5 + 0.02 * random.uniform());
  }
  return sample;
}

void narrow_cell(EngineKind kind, Report& report) {
  const auto shear = [&](int copies) {
    Scene scene = periodic_scene(2, 9 * copies * copies, 0.4, 0.7, 1e5);
    scene.loading.kind = LoadingKind::plane_shear;
    scene.loading.shear_rate = 0.5;
    scene.cd.dt = 1e-3, scene.cd.tolerance = 1e-13, scene.cd.max_sweeps = 100000;
    scene.md.dt = 1e-4;
    Trial<2> trial(report, kind, scene, nine(copies));
    std::pair<Mat<2>, std::vector<Vec<2>>> found{Mat<2>::Zero(), {}};
    for (int look = 0; look < 100; ++look) {
      trial.run_to(0.01 * (look + 1));
      found.first += stress<2>(trial.state()).total() / 100;
    }
    const Snapshot<2> state = trial.state();
    found.second.assign(state.velocity.begin(), state.velocity.end());
    return found;
  };
  const auto [narrow, alone] = shear(1);
  const auto [wide, four] = shear(2);
  double difference = 0;
  for (std::size_t k = 0; k < four.size(); ++k) difference = std::max(difference, (four[k] - alone[k % 9]).norm());
  const std::string reason = "rounding (md) and tolerance 1e-13 (cd), magnified by each of some ten impacts";
  report.relative("mean pressure in both cells", narrow.trace(), wide.trace(), 1e-6, reason);
  report.small("largest difference of velocities", difference, 1e-6, reason);
}

}  // namespace

std::vector<Case> extreme_cases() {
  return {
      {.name = "fast_grain",
       .tags = {"fast"},
       .effort = Effort::quick,
       .scene = "a grain at 50 of its diameters per step (cd) hits a bed of 45 disks; md at K = 1e9",
       .exact = "nothing tunnels, no energy is made",
       .trouble = "a grain that passes through others, an explosion",
       .run = fast_grain},
      {.name = "fast_grain_soft",
       .tags = {"fast"},
       .scene = "the same at K = 1e4: the bullet would cross a disk",
       .exact = "the run stops and says why",
       .trouble = "a run that goes on with grains inside each other",
       .run = fast_grain_soft,
       .md = {Stance::refuses, "overlap"},
       .cd = {Stance::absent, "rigid grains have no stiffness: fast_grain is the case"}},
      {.name = "size_ratio_50",
       .tags = {"sizes", "gas"},
       .effort = Effort::quick,
       .scene = "an elastic gas of disks, size ratio 1:50, mass ratio 1:2500",
       .exact = "energy and momentum kept; contacts found by looking at all pairs",
       .trouble = "pairs that the neighbour search misses",
       .run = size_ratio_50},
      {.name = "narrow_cell",
       .tags = {"few", "flow", "invariance"},
       .effort = Effort::quick,
       .scene = "9 disks sheared in a cell 3.1 diameters wide, and four copies of them",
       .exact = "the copies do the same",
       .trouble = "grains that meet the wrong image of a neighbour, or two where there is one",
       .run = narrow_cell},
  };
}

}  // namespace galet::verify
