// Linear and angular momentum of grains that collide with friction in free space, conserved to rounding.
#include <gtest/gtest.h>

#include "tests/support/scenes.hpp"

namespace galet::test::momentum_test {
namespace {

/// side^D unequal spinning grains in free space that rush towards their common centre.
template <int D>
Sample<D> imploding_cluster(int side) {
  Sample<D> sample = lattice_sample<D>(side, 1.2);
  vary_sizes<D>(sample, 0.15, 21);
  shake<D>(sample, 0.3, 22, 1);
  const Vec<D> centre = Vec<D>::Constant(10);
  for (Vec<D>& x : sample.position) x += centre - Vec<D>::Constant(side * 0.6);
  for (int i = 0; i < sample.count(); ++i) sample.velocity[i] -= 0.5 * (sample.position[i] - centre);
  sample.cell = cube<D>(20, false);
  return sample;
}

template <int D>
struct Momenta {
  Vec<D> linear = Vec<D>::Zero();
  Spin<D> angular = zero_spin<D>();
  Spin<D> of_spins = zero_spin<D>();  ///< the part of `angular` that is in the spins
  double scale = 0;                   ///< sum of |m v| |x|: what rounding is relative to
};

template <int D>
Momenta<D> momenta(const Snapshot<D>& state) {
  const Vec<D> centre = Vec<D>::Constant(10);  // any fixed point does; this one keeps rounding small
  Momenta<D> sum;
  for (int i = 0; i < state.grains(); ++i) {
    const Vec<D> arm = state.position[i] - centre, momentum = state.mass[i] * state.velocity[i];
    sum.linear += momentum;
    sum.of_spins += inertia_ratio<D> * state.mass[i] * state.radius[i] * state.radius[i] * state.spin[i];
    sum.angular += cross(arm, momentum);
    sum.scale += (1 + arm.norm()) * momentum.norm();
  }
  sum.angular += sum.of_spins;
  return sum;
}

template <int D>
void check(EngineKind kind, int side, DampingConvention convention) {
  SCOPED_TRACE(to_string(kind) + " D = " + std::to_string(D) + " " + to_string(convention));
  Scene scene = free_scene(D, 0.5, 0.4, 1e4);
  scene.material.convention = convention;
  scene.cd.dt = 1e-3;
  scene.cd.tolerance = 1e-4;  // an impulse acts on both grains whether it is accurate or not
  // Moving overlapping grains apart shifts the arms of the momenta; a tolerance never reached keeps that out.
  scene.cd.penetration = 0.1;
  const Sample<D> sample = imploding_cluster<D>(side);
  const auto engine = make_engine<D>(kind, scene, sample);
  const Momenta<D> before = momenta<D>(engine->snapshot());
  const EnergyParts energy_before = engine->energy();
  engine->advance(std::lround(1.5 / engine->dt()));
  const Momenta<D> after = momenta<D>(engine->snapshot());
  EXPECT_EQ(engine->solver_summary().corrections, 0);
  // Enough happened: energy was lost, and the spins exchanged angular momentum with the orbits.
  EXPECT_LT(engine->energy().total(), 0.7 * energy_before.total());
  EXPECT_GT(spin_norm(after.of_spins - before.of_spins), 1e-3 * before.scale);
  // Some 3000 steps, each with a rounding error of 1e-16 per grain, adding up at worst.
  const double rounding = 3e-13 * before.scale;
  EXPECT_LT((after.linear - before.linear).norm(), rounding);
  EXPECT_LT(spin_norm(after.angular - before.angular), rounding);
}

TEST(Momentum, IsConservedInFreeSpaceMd) {
  for (DampingConvention convention : both_conventions) {
    check<2>(EngineKind::md, 5, convention);
    check<3>(EngineKind::md, 3, convention);
  }
}

TEST(Momentum, IsConservedInFreeSpaceCd) {
  check<2>(EngineKind::cd, 5, DampingConvention::elastic);
  check<3>(EngineKind::cd, 3, DampingConvention::elastic);
}

/// In a sheared periodic cell the fluctuations' momentum p obeys dp/dt = -L p: from p = 0 it stays 0.
template <int D>
void check_periodic(EngineKind kind) {
  SCOPED_TRACE(to_string(kind) + " D = " + std::to_string(D));
  Scene scene = sheared_scene<D>(0.5, 0);
  scene.cd.dt = 1e-3;
  const auto engine = make_engine<D>(kind, scene, sheared_sample<D>(D == 2 ? 5 : 3));
  const double scale = momenta<D>(engine->snapshot()).scale;
  engine->advance(std::lround(1.0 / engine->dt()));
  EXPECT_LT(momenta<D>(engine->snapshot()).linear.norm(), 3e-13 * scale);
}

TEST(Momentum, OfFluctuationsStaysZeroInAShearedCell) {
  for (EngineKind kind : both_engines) {
    check_periodic<2>(kind);
    check_periodic<3>(kind);
  }
}

}  // namespace
}  // namespace galet::test::momentum_test
