// Elastic contacts of cd against md: deflections and forces that a packing of spheres takes up under a small deviatoric
// stress increment, contact by contact, and what each engine pays for them, at kappa = 1e3 to 1e6.
//
//   cd_compliance [N] > table.csv        N = 125
//
// Spheres with linear contacts are packed without friction by md at P = 1; they then get friction and stresses
// (1 + x, 1, 1 - x / 2), x = 0.004, and come to rest in each engine from the same positions: md by its drag in 60
// inertial times, at tau_c / 50, cd in 100 inertial times of steps of 0.2 or 0.05, whatever kappa. Columns: contacts of
// both; `change`: largest change of a deflection, over the mean one; `deflection`, `force`: largest difference between
// the engines over the largest change; steps and processor seconds of each.
//
// Friction 0.5, and 10, with which no contact slides. A weak contact that slides or opens on the way keeps a shear
// force of that way, and coarse steps go another way. What this can't tell: strains that end in sliding, where the way
// to the equilibrium counts.
#include <cstdio>
#include <cstdlib>
#include <map>
#include <tuple>

#include <fmt/format.h>

#include "cd/engine.hpp"
#include "common/core/clock.hpp"
#include "common/scene/derive.hpp"
#include "common/scene/packing.hpp"
#include "md/engine.hpp"

namespace galet {
namespace {

constexpr double increment = 0.004, rest_time = 60, cd_rest_time = 100;

Scene packing_scene(int count, double kappa, double friction) {
  Scene scene;
  scene.dimension = 3;
  scene.seed = 72;
  scene.grains.count = count;
  scene.grains.diameter = {SizeKind::uniform, 1, 0.1, {}, {}};
  scene.material.friction = friction;
  scene.material.restitution = 0.5;
  scene.material.normal_stiffness = kappa;
  scene.material.convention = DampingConvention::total;
  scene.initial.solid_fraction = 0.35;
  scene.initial.speed = 0.1;
  scene.cell.periodic.assign(3, true);
  scene.loading.pressure = 1;
  scene.loading.kind = LoadingKind::drives;
  scene.loading.drives = {
      {.component = "xx", .stress = 1.0}, {.component = "yy", .stress = 1.0}, {.component = "zz", .stress = 1.0}};
  scene.md.drag = 1;
  scene.cd.compliance = true;
  scene.cd.tolerance = 1e-11;
  scene.cd.max_sweeps = 100000;
  scene.run.duration = rest_time;
  return scene;
}

struct ContactState {
  double deflection;
  Vec<3> force;
};
using Contacts = std::map<std::tuple<int, int, Image<3>>, ContactState>;

Contacts contacts_of(const Snapshot<3>& state) {
  Contacts contacts;
  const ContactColumns<3>& c = *state.contacts;
  for (std::size_t k = 0; k < c.size(); ++k) contacts[{c.i[k], c.j[k], c.image[k]}] = {-c.gap[k], c.force[k]};
  return contacts;
}

Sample<3> at_rest(const Snapshot<3>& state, const Sample<3>& start) {
  Sample<3> sample = start;
  sample.cell = *state.cell;
  sample.cell.rate.setZero();
  sample.cell.strain.setZero();
  sample.position.assign(state.position.begin(), state.position.end());
  for (Vec<3>& velocity : sample.velocity) velocity.setZero();
  for (Vec<3>& spin : sample.spin) spin.setZero();
  return sample;
}

struct Rested {
  Contacts contacts;
  long steps = 0;
  double seconds = 0;
};

Rested rest(Engine<3>& engine, long steps) {
  const double before = thread_seconds();
  engine.advance(steps);
  return {contacts_of(engine.snapshot()), steps, thread_seconds() - before};
}

/// One line of the table.
void print_line(double kappa, double friction, double cd_dt, const Contacts& before, const Rested& expected,
                const Rested& found, const SolverSummary& solver) {
  double mean = 0, change = 0, force_change = 0, deflection = 0, force = 0;
  int common = 0;
  for (const auto& [pair, state] : expected.contacts) {
    if (!found.contacts.contains(pair) || !before.contains(pair)) continue;
    const ContactState &other = found.contacts.at(pair), &old = before.at(pair);
    ++common;
    mean += state.deflection;
    change = std::max(change, std::abs(state.deflection - old.deflection));
    force_change = std::max(force_change, (state.force - old.force).norm());
    deflection = std::max(deflection, std::abs(other.deflection - state.deflection));
    force = std::max(force, (other.force - state.force).norm());
  }
  fmt::print("{:.0e},{},{},{},{},{},{:.3g},{:.2g},{:.2g},{},{:.2f},{},{:.0f},{},{:.2f}\n", kappa, friction, cd_dt,
             expected.contacts.size(), found.contacts.size(), common, change * common / mean, deflection / change,
             force / force_change, expected.steps, expected.seconds, found.steps,
             static_cast<double>(solver.sweeps) / static_cast<double>(solver.steps), solver.missed, found.seconds);
  std::fflush(stdout);
}

void compare(int count, double kappa, double friction) {
  const Scene scene = packing_scene(count, kappa, 0);
  const Sample<3> gas = initial_sample<3>(scene);
  const auto packed = md::make_engine<3>(scene, derive(scene, grain_facts<3>(scene, gas)), gas);
  packed->advance(std::lround(2 * rest_time / packed->dt()));
  const Contacts before = contacts_of(packed->snapshot());
  const Sample<3> start = at_rest(packed->snapshot(), gas);

  Scene loaded = packing_scene(count, kappa, friction);
  loaded.loading.drives[0].stress = 1 + increment;
  loaded.loading.drives[2].stress = 1 - 0.5 * increment;
  const auto soft = md::make_engine<3>(loaded, derive(loaded, grain_facts<3>(loaded, start)), start);
  const Rested expected = rest(*soft, std::lround(rest_time / soft->dt()));
  for (const double dt : {0.2, 0.05}) {
    loaded.cd.dt = dt;
    const auto implicit = cd::make_engine<3>(loaded, derive(loaded, grain_facts<3>(loaded, start)), start);
    const Rested found = rest(*implicit, std::lround(cd_rest_time / dt));
    print_line(kappa, friction, dt, before, expected, found, implicit->solver_summary());
  }
}

}  // namespace
}  // namespace galet

int main(int argc, char** argv) {
  const int count = argc > 1 ? std::atoi(argv[1]) : 125;
  fmt::print(
      "kappa,friction,cd_dt,contacts_md,contacts_cd,common,change,deflection,force,md_steps,md_seconds,cd_steps,cd_"
      "sweeps_"
      "per_step,"
      "cd_missed,cd_seconds\n");
  for (const double friction : {0.5, 10.0})
    for (const double kappa : {1e3, 1e4, 1e5, 1e6}) galet::compare(count, kappa, friction);
}
