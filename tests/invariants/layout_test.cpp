// A frictionless scene gives the same result in the layout with friction (mu = 0) as in the one without.
#include <gtest/gtest.h>

#include "tests/support/scenes.hpp"

namespace galet::test::layout_test {
namespace {

/// Largest differences between the layouts over the looks at a run.
struct Differences {
  double velocity = 0, position = 0;
  double normal_force = 0;
  double tangential_share = 0;  ///< of the force in the larger layout
  std::size_t contacts = 0;     ///< compared in all
};

template <int D>
void compare(const Snapshot<D>& small, const Snapshot<D>& large, Differences& most) {
  most.velocity = std::max(most.velocity, largest_difference<D>(small.velocity, large.velocity));
  most.position = std::max(most.position, largest_difference<D>(small.position, large.position));
  ASSERT_EQ(small.contacts->size(), large.contacts->size());
  for (std::size_t c = 0; c < small.contacts->size(); ++c) {
    const Vec<D> a = small.contacts->force[c], b = large.contacts->force[c], n = large.contacts->normal[c];
    most.normal_force = std::max(most.normal_force, std::abs(a.dot(n) - b.dot(n)));
    most.tangential_share = std::max(most.tangential_share, (b - b.dot(n) * n).norm() / b.norm());
    ++most.contacts;
  }
}

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
  Differences most;
  for (int look = 0; look < 30; ++look) {
    small->advance(10);
    large->advance(10);
    EXPECT_TRUE(small->snapshot().spin.empty());
    compare<D>(small->snapshot(), large->snapshot(), most);
  }
  EXPECT_GT(most.contacts, 10u);  // something happened
  // Rounding (the tangential part adds zeros, but sums may be ordered differently) amplified by a few collisions; cd
  // stops its sweeps at 1e-12, by a residual that has more components in one of the layouts.
  const double tolerance = kind == EngineKind::cd ? 1e-8 : 1e-9;
  EXPECT_LT(most.velocity, tolerance);
  EXPECT_LT(most.position, tolerance);
  EXPECT_LT(most.normal_force, 1e3 * tolerance);  // K or m / dt times an error in positions or velocities
  EXPECT_LT(most.tangential_share, 1e-12);        // mu = 0: the force is along the normal that is shown with it
  // Without friction nothing turns a grain. (cd solves for R w: 300 conversions to and fro.)
  for (int i = 0; i < sample.count(); ++i) EXPECT_LT(spin_norm(large->snapshot().spin[i] - sample.spin[i]), 1e-13) << i;
}

TEST(Layout, LargerLayoutGivesTheSameResult) {
  for (EngineKind kind : both_engines)
    for (double pressure : {0.0, 1.0}) {
      check<2>(kind, pressure);
      check<3>(kind, pressure);
    }
}

/// The layout with rolling on a scene without: the same bits, since its springs are never asked.
template <int D>
void check_rolling() {
  Scene scene = sheared_scene<D>(0.5, 1);
  const Sample<D> sample = sheared_sample<D>(D == 2 ? 5 : 3);
  Derived derived = derive_for<D>(scene, sample);
  const auto small = md::make_engine<D>(scene, derived, sample);
  derived.layout.rolling = true;
  const auto large = md::make_engine<D>(scene, derived, sample);
  EXPECT_EQ(large->layout(), (Layout{D, true, true}));
  small->advance(2000);
  large->advance(2000);
  EXPECT_EQ(largest_difference<D>(small->snapshot().velocity, large->snapshot().velocity), 0);
  for (int i = 0; i < sample.count(); ++i) EXPECT_EQ(small->snapshot().spin[i], large->snapshot().spin[i]);
}

TEST(Layout, RollingLayoutWithoutRollingIsTheSame) {
  check_rolling<2>();
  check_rolling<3>();
}

/// A general kernel on a plain scene (the energy account asks for it): the same motion as the plain kernel's.
template <int D>
void check_kernels(NormalLaw normal_law) {
  Scene scene = sheared_scene<D>(0.5, 1);
  if (normal_law == NormalLaw::hertz) {
    scene.material.normal_law = normal_law;
    scene.material.normal_stiffness.reset();
    scene.material.young_modulus = 1e4;
    scene.material.poisson_ratio = 0.3;
  }
  const Sample<D> sample = sheared_sample<D>(D == 2 ? 5 : 3);
  const auto plain = make_engine<D>(EngineKind::md, scene, sample);
  scene.md.energy_budget = true;
  const auto general = make_engine<D>(EngineKind::md, scene, sample);
  plain->advance(2000);
  general->advance(2000);
  EXPECT_EQ(largest_difference<D>(plain->snapshot().position, general->snapshot().position), 0);
  EXPECT_EQ(largest_difference<D>(plain->snapshot().velocity, general->snapshot().velocity), 0);
}

TEST(Layout, PlainAndGeneralKernelsAgreeToTheLastBit) {
  for (NormalLaw law : {NormalLaw::linear, NormalLaw::hertz}) {
    check_kernels<2>(law);
    check_kernels<3>(law);
  }
}

TEST(Layout, SmallestLayoutIsDeduced) {
  Scene scene = periodic_scene(3, 0, 0.5, 1e3);
  const Sample<3> sample = gas_sample<3>(3, 0.2, 0.1, 1);
  EXPECT_FALSE(derive_for<3>(scene, sample).layout.friction);
  scene.material.friction = 0.01;
  EXPECT_TRUE(derive_for<3>(scene, sample).layout.friction);
  EXPECT_EQ(derive_for<3>(scene, sample).layout.dim, 3);
  EXPECT_FALSE(derive_for<3>(scene, sample).layout.rolling);
  scene.material.friction = 0;
  scene.material.pivoting_friction = 0.01;
  EXPECT_EQ(derive_for<3>(scene, sample).layout, (Layout{3, true, true}));
}

}  // namespace
}  // namespace galet::test::layout_test
