// The closed forms of restitution and duration against a direct integration of h'' = -h - 2 zeta h'
// (units m* = K_N = 1), from h = 0, h' = 1 until the contact ends: at h = 0 again (`elastic`) or when the force
// h + 2 zeta h' has fallen to zero (`total`).
#include <gtest/gtest.h>

#include "tests/support/scenes.hpp"

namespace galet::test::restitution_test {
namespace {

struct Motion {
  double deflection;
  double rate;
};

struct Outcome {
  double restitution;
  double duration;
};

/// One step of the classical Runge-Kutta method of order 4.
Motion runge_kutta(Motion y, double zeta, double dt) {
  const auto slope = [zeta](Motion at) { return Motion{at.rate, -at.deflection - 2 * zeta * at.rate}; };
  const auto moved = [](Motion from, Motion by, double step) {
    return Motion{from.deflection + step * by.deflection, from.rate + step * by.rate};
  };
  const Motion a = slope(y);
  const Motion b = slope(moved(y, a, dt / 2));
  const Motion c = slope(moved(y, b, dt / 2));
  const Motion d = slope(moved(y, c, dt));
  return {y.deflection + dt / 6 * (a.deflection + 2 * b.deflection + 2 * c.deflection + d.deflection),
          y.rate + dt / 6 * (a.rate + 2 * b.rate + 2 * c.rate + d.rate)};
}

Outcome integrate_contact(double zeta, DampingConvention convention) {
  const auto lasts = [&](Motion y) {
    if (convention == DampingConvention::elastic) return y.deflection > 0;
    return y.deflection + 2 * zeta * y.rate > 0;
  };
  const double dt = 1e-3;  // error of order dt^4 = 1e-12
  double time = dt;
  Motion y = runge_kutta({0, 1}, zeta, dt);
  for (Motion next = runge_kutta(y, zeta, dt); lasts(next); next = runge_kutta(y, zeta, dt)) {
    y = next;
    time += dt;
  }
  double low = 0, high = dt;  // the end of the contact lies in this part of the next step
  for (int k = 0; k < 60; ++k) {
    const double middle = (low + high) / 2;
    (lasts(runge_kutta(y, zeta, middle)) ? low : high) = middle;
  }
  return {-runge_kutta(y, zeta, low).rate, time + low};
}

// Tolerance of this file: the integration's own error, 1e-12 per unit of time, times 10.
constexpr double tolerance = 1e-11;

TEST(Restitution, ElasticConventionAgreesWithIntegration) {
  for (double zeta : {0.0, 0.01, 0.0335, 0.2, 0.5, 0.59, 0.9}) {
    SCOPED_TRACE(zeta);
    const Outcome expected = integrate_contact(zeta, DampingConvention::elastic);
    EXPECT_NEAR(restitution_of_damping(zeta, DampingConvention::elastic), expected.restitution, tolerance);
    EXPECT_NEAR(collision_duration(zeta, DampingConvention::elastic, 1, 1), expected.duration,
                tolerance * expected.duration / std::max(expected.restitution, 1e-3));
  }
}

TEST(Restitution, TotalConventionAgreesWithIntegrationAlsoBeyondCriticalDamping) {
  for (double zeta : {0.0, 0.01, 0.3, 0.7, 0.999, 1.001, 1.5, 3.0, 6.0}) {
    SCOPED_TRACE(zeta);
    const Outcome expected = integrate_contact(zeta, DampingConvention::total);
    EXPECT_NEAR(restitution_of_damping(zeta, DampingConvention::total), expected.restitution, tolerance);
    EXPECT_NEAR(collision_duration(zeta, DampingConvention::total, 1, 1), expected.duration, 100 * tolerance);
  }
}

TEST(Restitution, CriticalDampingIsNoSpecialCase) {
  // zeta -> 1 in the `total` convention: e -> exp(-2), duration -> 2 / w0. Rounding in 1 - zeta^2 must not show:
  // e and the duration are smooth in zeta, so values 1e-9 apart differ by 1e-8 at most.
  for (double zeta : {1 - 1e-9, 1 - 1e-14, 1.0, 1 + 1e-14, 1 + 1e-9}) {
    SCOPED_TRACE(zeta);
    EXPECT_NEAR(restitution_of_damping(zeta, DampingConvention::total), std::exp(-2.0), 1e-8);
    EXPECT_NEAR(collision_duration(zeta, DampingConvention::total, 1, 1), 2.0, 1e-7);
  }
  // `elastic`: an overdamped contact never opens again.
  EXPECT_EQ(restitution_of_damping(1.0, DampingConvention::elastic), 0);
  EXPECT_EQ(restitution_of_damping(1.3, DampingConvention::elastic), 0);
}

TEST(Restitution, DampingIsTheInverse) {
  for (DampingConvention convention : both_conventions)
    for (double e : {0.01, 0.1, 0.135, 0.136, 0.5, 0.9, 0.99, 1.0}) {
      SCOPED_TRACE(to_string(convention) + " e = " + std::to_string(e));
      const double zeta = damping_of_restitution(e, convention);
      EXPECT_GE(zeta, 0);
      // Found by a root search or in closed form: either way good to a few units in the last places.
      EXPECT_NEAR(restitution_of_damping(zeta, convention), e, 1e-12);
      EXPECT_NEAR(integrate_contact(zeta, convention).restitution, e, tolerance);
    }
}

TEST(Restitution, KnownDampingRatios) {
  // The literature's digits for the `elastic` convention (exp(-pi zeta / sqrt(1 - zeta^2)) solved for zeta).
  EXPECT_NEAR(damping_of_restitution(0.1, DampingConvention::elastic), 0.59116, 5e-6);
  EXPECT_NEAR(damping_of_restitution(0.5, DampingConvention::elastic), 0.21545, 5e-6);
  EXPECT_NEAR(damping_of_restitution(0.9, DampingConvention::elastic), 0.033518, 5e-7);
}

TEST(Restitution, DurationScalesWithMassAndStiffness) {
  for (DampingConvention convention : both_conventions)
    EXPECT_NEAR(collision_duration(0.3, convention, 3.0, 7.0),
                collision_duration(0.3, convention, 1, 1) * std::sqrt(3.0 / 7.0), 1e-14);
}

}  // namespace
}  // namespace galet::test::restitution_test
