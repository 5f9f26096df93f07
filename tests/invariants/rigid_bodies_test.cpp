// What rigid bodies must keep: momentum and angular momentum to rounding, the energy budget, their shape, and that a
// step allocates no memory.
#include "tests/support/rigid_bodies.hpp"

#include <gtest/gtest.h>

#include "tests/support/limit_alloc.hpp"

namespace galet::test::rigid_bodies_test {
namespace {

template <int D>
void check_momenta(EngineKind kind, bool rolling) {
  SCOPED_TRACE(to_string(kind) + " D = " + std::to_string(D) + (rolling ? ", rolling resistance" : ""));
  auto [scene, sample] = clump_gas<D>(D == 2 ? 4 : 2, 1, 81, false);
  if (rolling) resist_rolling(scene);
  const Vec<D> origin = Vec<D>::Constant(20 + 1.6 * (D == 2 ? 4 : 2));
  for (int b = 0; b < static_cast<int>(scene.bodies.size()); ++b)
    for (int a = 0; a < D; ++a) scene.bodies[b].velocity[a] += origin[a] - sample.position[4 * b][a];
  scene.cd.penetration = 0.1;  // moving overlapping grains apart shifts the arms of the momenta
  const auto engine = make_engine<D>(kind, scene, sample);
  const BodyMomenta<D> before = body_momenta<D>(engine->snapshot(), sample.body, origin);
  const double energy = engine->energy().total();
  engine->advance(std::lround(1.5 / engine->dt()));
  const BodyMomenta<D> after = body_momenta<D>(engine->snapshot(), sample.body, origin);
  EXPECT_EQ(engine->solver_summary().corrections, 0);
  EXPECT_LT(engine->energy().total(), 0.8 * energy) << "enough happened";
  // Each step rounds by 1e-16, which adds up at worst: md's error grows by half of that per step, free flight included.
  const double rounding = 1e-16 * static_cast<double>(engine->steps()) * before.scale;
  EXPECT_LT((after.linear - before.linear).norm(), rounding);
  EXPECT_LT(spin_norm(Spin<D>(after.angular - before.angular)), rounding);
}

TEST(RigidBodies, KeepMomentumAndAngularMomentum) {
  for (EngineKind kind : both_engines)
    for (const bool rolling : {false, true}) check_momenta<2>(kind, rolling), check_momenta<3>(kind, rolling);
}

/// Grains of a body keep their distances however often it turns.
TEST(RigidBodies, KeepTheirShape) {
  for (EngineKind kind : both_engines) {
    auto [scene, sample] = clump_gas<3>(2, 5, 82);
    const auto engine = make_engine<3>(kind, scene, sample);
    engine->advance(3000);
    const Snapshot<3> state = engine->snapshot();
    for (int b = 0; b < static_cast<int>(scene.bodies.size()); ++b)
      for (int k : {1, 2}) {
        const double start = (sample.position[4 * b] - sample.position[4 * b + k]).norm();
        // Numbers of order 6 that are rounded once, not once a step.
        EXPECT_NEAR(lattice_distance<3>(*state.cell, state.position[4 * b], state.position[4 * b + k]), start, 1e-14);
      }
  }
}

/// md: what is driven in and what is dissipated change the energy, to second order in dt. Bodies with a force, a
/// torque, an imposed velocity and an imposed spin under gravity, between planes.
template <int D>
void check_budget() {
  SCOPED_TRACE("D = " + std::to_string(D));
  std::vector<double> step, error;
  double exchanged = 0;
  for (const double dt : {4e-4, 2e-4, 1e-4}) {
    auto [scene, sample] = clump_gas<D>(2, 1, 83, false);
    scene.material.normal_stiffness = 1e3;
    scene.material.convention = DampingConvention::elastic;
    scene.md.energy_budget = true;
    scene.loading.gravity.assign(D, 0.1);
    const Vec<D> centre = Vec<D>::Constant(23.2);
    for (int b = 0; b < static_cast<int>(scene.bodies.size()); ++b)
      for (int a = 0; a < D; ++a) scene.bodies[b].velocity[a] += centre[a] - sample.position[4 * b][a];
    scene.bodies[0].free.clear();
    scene.bodies[1].free_rotation.clear();
    scene.bodies[2].force.assign(D, 0.4);
    scene.bodies[3].torque.assign(D == 2 ? 1 : 3, 0.5);
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

TEST(RigidBodies, EnergyBudgetClosesMd) {
  check_budget<2>();
  check_budget<3>();
}

template <int D>
void check_allocation(EngineKind kind, bool rolling) {
  SCOPED_TRACE(to_string(kind) + " D = " + std::to_string(D) + (rolling ? ", rolling resistance" : ""));
  auto [scene, sample] = clump_gas<D>(D == 2 ? 5 : 3, 2, 84);
  if (rolling) resist_rolling(scene);
  scene.material.restitution = 1;
  scene.cd.dt = 1e-2;
  const auto engine = make_engine<D>(kind, scene, sample);
  engine->advance(3000);
  const AllocationCount count;
  engine->advance(300);
  EXPECT_EQ(count.count(), 0);
}

TEST(Allocation, NoneWithRigidBodies) {
  for (EngineKind kind : both_engines)
    for (const bool rolling : {false, true}) check_allocation<2>(kind, rolling), check_allocation<3>(kind, rolling);
}

}  // namespace
}  // namespace galet::test::rigid_bodies_test
