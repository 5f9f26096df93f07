// A frictionless scene gives the same result in the layout with friction (mu = 0) as in the one without.
#include <gtest/gtest.h>

#include "tests/support/scenes.hpp"

namespace galet::test {
namespace {

template <int D>
void check(EngineKind kind, double pressure) {
  SCOPED_TRACE(to_string(kind) + " D = " + std::to_string(D) + " pressure " + std::to_string(pressure));
  Scene scene = sheared_scene<D>(0.5, pressure);
  scene.material.friction = 0;
  scene.cd.tolerance = 1e-12;
  scene.cd.max_sweeps = 20000;
  set_dt(scene, 1e-3);
  const Sample<D> sample = sheared_sample<D>(D == 2 ? 5 : 3);
  const auto small = make_engine<D>(kind, scene, sample);
  const auto large = make_engine<D>(kind, scene, sample, true);
  EXPECT_EQ(small->layout(), (Layout{D, false}));
  EXPECT_EQ(large->layout(), (Layout{D, true}));
  small->advance(300);
  large->advance(300);
  const Snapshot<D> a = small->snapshot(), b = large->snapshot();
  EXPECT_TRUE(a.spin.empty());
  // Rounding (the tangential part adds zeros, but sums may be ordered differently) amplified by a few collisions;
  // cd stops its sweeps at 1e-12, by a residual that has more components in one of the layouts.
  const double tolerance = kind == EngineKind::cd ? 1e-8 : 1e-9;
  EXPECT_LT(largest_difference<D>(a.velocity, b.velocity), tolerance);
  EXPECT_LT(largest_difference<D>(a.position, b.position), tolerance);
  EXPECT_GT(largest_difference<D>(a.velocity, sample.velocity), 0.5);  // something happened
  ASSERT_GT(a.contacts->size(), 0u);
  ASSERT_EQ(a.contacts->size(), b.contacts->size());
  for (std::size_t c = 0; c < a.contacts->size(); ++c)
    EXPECT_LT((a.contacts->force[c] - b.contacts->force[c]).norm(), 1e3 * tolerance);  // K or m / dt times positions
  // Without friction nothing turns a grain.
  for (int i = 0; i < b.grains(); ++i) EXPECT_EQ(spin_norm(b.spin[i] - sample.spin[i]), 0) << i;
}

TEST(Layout, LargerLayoutGivesTheSameResult) {
  for (EngineKind kind : both_engines)
    for (double pressure : {0.0, 1.0}) {
      check<2>(kind, pressure);
      check<3>(kind, pressure);
    }
}

TEST(Layout, SmallestLayoutIsDeduced) {
  Scene scene = periodic_scene(3, 0, 0.5, 1e3);
  const Sample<3> sample = gas_sample<3>(3, 0.2, 0.1, 1);
  EXPECT_FALSE(derive_for<3>(scene, sample).layout.friction);
  scene.material.friction = 0.01;
  EXPECT_TRUE(derive_for<3>(scene, sample).layout.friction);
  EXPECT_EQ(derive_for<3>(scene, sample).layout.dim, 3);
}

}  // namespace
}  // namespace galet::test
