// Rigid bodies in a cell that moves: against free space, against grains, and the stress that they carry.
#include <gtest/gtest.h>

#include "common/measure/stress.hpp"
#include "tests/support/rigid_bodies.hpp"

namespace galet::test::clump_cell_test {
namespace {

/// Two dumbbells that collide off centre in the middle of a cell, with the total velocities V + L c of `rate`.
template <int D>
std::pair<Scene, Sample<D>> collision(EngineKind kind, double rate, double friction) {
  Scene scene = periodic_scene(D, friction, 0.5, 1e4);
  Sample<D> sample = dumbbell_sample<D>(Vec<D>::Unit(1), Vec<D>::Constant(20));
  const Vec<D> shift = 1.02 * generic_direction<D>() + 0.3 * generic_tangent<D>(generic_direction<D>());
  for (int k : {0, 1})
    add_grain<D>(sample, Vec<D>::Constant(20) + shift + 0.5 * Vec<D>::Unit(1) + k * generic_direction<D>());
  sample.cell.periodic.fill(true);
  sample.body = {0, 0, 1, 1};
  scene.bodies = {free_body(D, "a"), free_body(D, "b")};
  for (int b : {0, 1}) {
    const Vec<D> centre = 0.5 * (sample.position[2 * b] + sample.position[2 * b + 1]);
    Vec<D> velocity = (b == 0 ? 1 : -1) * 2 * generic_direction<D>();
    velocity.x() -= rate * centre.y();
    scene.bodies[b].velocity.assign(velocity.data(), velocity.data() + D);
    scene.bodies[b].spin.assign(D == 2 ? 1 : 3, b == 0 ? 0.5 : -0.2);
  }
  if (rate != 0) {
    scene.loading.kind = LoadingKind::drives;
    scene.loading.drives = {{.component = "xy", .rate = rate}};
  }
  set_dt(scene, kind == EngineKind::md ? 1e-4 : 5e-5);
  scene.cd.tolerance = 1e-12;
  return {scene, sample};
}

/// Simple shear with L L = 0: the total velocities V + L c obey Newton's laws as in a cell at rest, so the same
/// collision ends in the same motion, whatever the rate.
template <int D>
void check_frame(EngineKind kind, double friction) {
  SCOPED_TRACE(to_string(kind) + " D = " + std::to_string(D) + ", mu = " + std::to_string(friction));
  constexpr double rate = 0.7, duration = 0.2;
  std::vector<RigidBody<D>> end[2];
  for (int moving : {0, 1}) {
    const auto [scene, sample] = collision<D>(kind, moving * rate, friction);
    const auto engine = make_engine<D>(kind, scene, sample);
    const double before = (engine->snapshot().bodies[0].velocity - engine->snapshot().bodies[1].velocity).norm();
    engine->advance(std::lround(duration / engine->dt()));
    const Snapshot<D> state = engine->snapshot();
    end[moving].assign(state.bodies.begin(), state.bodies.end());
    if (moving)
      for (RigidBody<D>& body : end[1]) body.velocity.x() += rate * body.centre.y();
    else
      EXPECT_GT(before, 1.2 * (end[0][0].velocity - end[0][1].velocity).norm()) << "they have collided";
  }
  // md: (dt / tau_c)^2, tau_c = 0.02 and more. cd: the instant of impact is known to dt, in which bodies turn by dt w
  // and the cell shears by dt L.
  const double bound = kind == EngineKind::md ? 1e-4 : 3e-4;
  for (int b : {0, 1}) {
    EXPECT_LT((end[1][b].centre - end[0][b].centre).norm(), bound);
    EXPECT_LT((end[1][b].velocity - end[0][b].velocity).norm(), bound);
    EXPECT_LT(spin_norm(Spin<D>(end[1][b].spin - end[0][b].spin)), bound);
  }
}

TEST(ClumpsInACell, CollideAsInACellAtRest) {
  for (EngineKind kind : both_engines)
    for (double friction : {0.0, 0.5}) check_frame<2>(kind, friction), check_frame<3>(kind, friction);
}

/// A gas of grains in a cell that is sheared and pressed, each grain free or glued to a body of its own.
template <int D>
std::unique_ptr<Engine<D>> single_grains(EngineKind kind, bool glued, bool rolling) {
  Scene scene = sheared_scene<D>(0.5, 1);
  if (rolling) resist_rolling(scene);
  Sample<D> sample = gas_sample<D>(D == 2 ? 5 : 3, D == 2 ? 0.5 : 0.35, 0.1, 91, 1);
  set_dt(scene, kind == EngineKind::md ? 2e-4 : 1e-3);
  scene.cd.tolerance = 1e-13;
  scene.cd.max_sweeps = 10000;
  if (glued) {
    sample.body.resize(sample.count());
    for (int i = 0; i < sample.count(); ++i) {
      sample.body[i] = i;
      BodySpec body = free_body(D, std::to_string(i));
      body.velocity.assign(sample.velocity[i].data(), sample.velocity[i].data() + D);
      if constexpr (D == 2)
        body.spin = {sample.spin[i]};
      else
        body.spin.assign(sample.spin[i].data(), sample.spin[i].data() + 3);
      scene.bodies.push_back(body);
    }
  }
  return make_engine<D>(kind, scene, sample);
}

template <int D>
void check_single_grains(EngineKind kind, bool rolling) {
  SCOPED_TRACE(to_string(kind) + " D = " + std::to_string(D) + (rolling ? ", rolling resistance" : ""));
  const auto grains = single_grains<D>(kind, false, rolling), bodies = single_grains<D>(kind, true, rolling);
  std::size_t contacts = 0;
  for (int look = 0; look < (D == 2 ? 300 : 160); ++look) {
    for (const auto& engine : {&grains, &bodies}) (*engine)->advance(kind == EngineKind::md ? 25 : 5);
    const Snapshot<D> free = grains->snapshot(), glued = bodies->snapshot();
    contacts += free.contacts->size();
    EXPECT_EQ(glued.contacts->size(), free.contacts->size());
    // Rounding, and the solver's tolerance in cd, times what collisions make of it: a factor of some 10 each.
    const double bound = kind == EngineKind::md ? 1e-9 : 1e-7;
    EXPECT_LT(largest_difference<D>(glued.velocity, free.velocity), bound);
    EXPECT_LT((glued.cell->box - free.cell->box).norm(), bound);
    EXPECT_LT((stress<D>(glued).total() - stress<D>(free).total()).norm(), 1e4 * bound);
  }
  EXPECT_GT(contacts, 10u);
}

TEST(ClumpsInACell, OfOneGrainMoveAsThatGrain) {
  for (EngineKind kind : both_engines)
    for (const bool rolling : {false, true})
      check_single_grains<2>(kind, rolling), check_single_grains<3>(kind, rolling);
}

/// md: the work of the drives, with the stress from centre to centre of bodies, and what is dissipated change the
/// energy, to second order in dt: no other stress would balance the budget.
template <int D>
void check_budget() {
  SCOPED_TRACE("D = " + std::to_string(D));
  std::vector<double> step, error;
  double exchanged = 0;
  for (const double dt : {4e-4, 2e-4, 1e-4}) {
    auto [scene, sample] = clump_gas<D>(2, 1, 83);
    scene.material.normal_stiffness = 2e3;  // at 1e3 the hardest collision is deeper than lists accept
    scene.material.convention = DampingConvention::elastic;
    scene.md.energy_budget = true;
    scene.loading.kind = LoadingKind::plane_shear;
    scene.loading.shear_rate = 0.5;
    scene.loading.pressure = 2;
    set_dt(scene, dt);
    const auto engine = make_engine<D>(EngineKind::md, scene, sample);
    const double before = engine->energy().total();
    engine->advance(std::lround(2 / dt));
    const EnergyFlows flows = engine->energy_flows();
    EXPECT_GT(flows.dissipated(), 0.1);
    EXPECT_GT(std::abs(flows.work), 0.1);
    exchanged = flows.dissipated() + std::abs(flows.work);
    step.push_back(dt);
    error.push_back(std::abs(engine->energy().total() - before - flows.work + flows.dissipated()));
  }
  EXPECT_LT(error.back(), 1e-4 * exchanged);  // the trapezoidal rule over collisions of some 300 steps
  EXPECT_GT(observed_order(step, error), 1.5) << error[0] << " " << error[1] << " " << error[2];
}

TEST(ClumpsInACell, EnergyBudgetClosesMd) {
  check_budget<2>();
  check_budget<3>();
}

}  // namespace
}  // namespace galet::test::clump_cell_test
