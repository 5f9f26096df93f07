// What must hold in cd whatever the contact law: momentum and angular momentum to rounding, no allocation in a step,
// and the same motion in a layout larger than the scene needs.
#include <gtest/gtest.h>

#include "tests/support/limit_alloc.hpp"
#include "tests/support/rigid_laws.hpp"
#include "tests/support/sanitized.hpp"

namespace galet::test::cd_laws_test {
namespace {

/// Unequal spinning grains in free space that rush towards their common centre.
template <int D>
Sample<D> imploding_cluster() {
  const int side = D == 2 ? 5 : 3;
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
  Spin<D> angular = zero_spin<D>(), of_spins = zero_spin<D>();
  double scale = 0;  ///< sum of |m v| (1 + |x|): what rounding is relative to
};

template <int D>
Momenta<D> momenta(const Snapshot<D>& state) {
  Momenta<D> sum;
  for (int i = 0; i < state.grains(); ++i) {
    const Vec<D> arm = state.position[i] - Vec<D>::Constant(10), momentum = state.mass[i] * state.velocity[i];
    sum.linear += momentum;
    sum.of_spins += inertia_ratio<D> * state.mass[i] * state.radius[i] * state.radius[i] * state.spin[i];
    sum.angular += cross(arm, momentum);
    sum.scale += (1 + arm.norm()) * momentum.norm();
  }
  sum.angular += sum.of_spins;
  return sum;
}

template <int D>
void check_momentum(const RichLaw& law) {
  SCOPED_TRACE(law.name + ", D = " + std::to_string(D));
  Scene scene = free_scene(D, 0.5, 0.4, 1e4);
  scene.cd.dt = 1e-3;
  scene.cd.penetration = 0.1;  // moving overlapping grains apart would shift the arms of the momenta
  Sample<D> sample = imploding_cluster<D>();
  law.change(scene);
  scene.cd.theta = 1;  // below, positions move by v- too, and x (x) m v is conserved to the scheme's order only
  mix_materials<D>(scene, sample);
  const auto engine = make_engine<D>(EngineKind::cd, scene, sample);
  const Momenta<D> before = momenta<D>(engine->snapshot());
  engine->advance(1500);
  const Momenta<D> after = momenta<D>(engine->snapshot());
  EXPECT_EQ(engine->solver_summary().corrections, 0);
  EXPECT_GT(spin_norm(after.of_spins - before.of_spins), 1e-3 * before.scale) << "grains have met";
  const double rounding = 3e-13 * before.scale;  // 1500 steps, 1e-16 per grain and step, adding up at worst
  EXPECT_LT((after.linear - before.linear).norm(), rounding);
  EXPECT_LT(spin_norm(after.angular - before.angular), rounding);
}

TEST(MomentumCd, IsConservedWithEveryLaw) {
  for (const RichLaw& law : rich_rigid_laws()) {
    check_momentum<2>(law);
    check_momentum<3>(law);
  }
}

/// One wall: what the plane is given and what the grain gets are the same, also where the plane moves freely.
TEST(MomentumCd, OfAGrainAndAFreePlane) {
  Scene scene = free_scene(3, 0.3, 0.6, 1e4);
  scene.cd.dt = 1e-3;
  Sample<3> sample = ball_on_plane<3>(up<3>(), 0.01, 0.5, 2);
  sample.planes[0].inverse_mass = 1 / 3.0;
  sample.velocity[0] = Vec<3>(0.2, 0.1, -1);
  const auto engine = make_engine<3>(EngineKind::cd, scene, sample);
  engine->advance(100);
  const Snapshot<3> state = engine->snapshot();
  EXPECT_GT(state.velocity[0].z(), -0.5);
  EXPECT_NEAR(2 * state.velocity[0].z() + 3 * state.planes[0].velocity.z(), -2, 1e-14);
}

/// A crystal that shakes in its place: contacts open and close, but no column has a reason to grow.
template <int D>
void check_allocation(const RichLaw& law) {
  SCOPED_TRACE(law.name + ", D = " + std::to_string(D));
  Scene scene = periodic_scene(D, 0.4, 0.9, 1e3);
  scene.cd.dt = 1e-2;
  Sample<D> sample = crystal_sample<D>(D == 2 ? 6 : 3, 1.1);
  shake<D>(sample, 0.5, 41, 0.5);
  law.change(scene);
  mix_materials<D>(scene, sample);
  const auto engine = make_engine<D>(EngineKind::cd, scene, sample);
  engine->advance(sanitized ? 200 : 1000);
  const AllocationCount count;
  engine->advance(sanitized ? 100 : 300);
  EXPECT_EQ(count.count(), 0);
}

TEST(AllocationCd, NoneWithAnyLaw) {
  for (const RichLaw& law : rich_rigid_laws()) {
    check_allocation<2>(law);
    check_allocation<3>(law);
  }
}

/// The layout with rolling on a scene without: the same motion. Bits differ, as friction is solved in another form.
template <int D>
void check_layout() {
  Scene scene = sheared_scene<D>(0.5, 1);
  scene.cd.dt = 2e-3;
  scene.cd.tolerance = 1e-11;
  const Sample<D> sample = sheared_sample<D>(D == 2 ? 5 : 3);
  Derived derived = derive_for<D>(scene, sample);
  const auto small = cd::make_engine<D>(scene, derived, sample);
  derived.layout.rolling = true;
  const auto large = cd::make_engine<D>(scene, derived, sample);
  EXPECT_EQ(large->layout(), (Layout{D, true, true}));
  std::size_t contacts = 0;
  for (int step = 0; step < 50; ++step) {
    small->advance(1);
    large->advance(1);
    contacts += small->snapshot().contacts->size();
  }
  EXPECT_GT(contacts, 10u);
  // The solver's tolerance, grown by 50 steps of a flow in which collisions part neighbouring paths.
  EXPECT_LT(largest_difference<D>(small->snapshot().velocity, large->snapshot().velocity), 1e-6);
}

TEST(LayoutCd, RollingLayoutWithoutRollingIsTheSame) {
  check_layout<2>();
  check_layout<3>();
}

}  // namespace
}  // namespace galet::test::cd_laws_test
