// The restitution that a scene asks for is the one that md delivers: either law of normal force, either convention,
// any masses and radii, any speed. And, for a damping ratio that a scene gives, against a direct integration of
//   m* h'' = -F(h, h'),   F = K h + alpha h' (linear) or k h^(3/2) + alpha h' (hertz), alpha = zeta 2 sqrt(m* dF/dh),
// in which `total` cuts F off at 0.
#include <gtest/gtest.h>

#include "tests/support/impact.hpp"

namespace galet::test::restitution_law_test {
namespace {

/// Steps per (elastic) contact where the restitution is asked for within 1e-4. A damping force that jumps at the
/// start or the end of the contact may count for half a step too much or too little, zeta (w0 dt) e in the rebound at
/// each end: at most 0.33 pi / steps = 5e-5 over all e (largest near e = 0.4). Second-order terms are 1e-8.
constexpr double steps_per_contact = 20000;
constexpr double phase = 0.37;

struct Partners {
  std::string name;
  std::array<double, 2> radius, mass;
};
const std::array all_partners{Partners{"equal", {0.5, 0.5}, {1, 1}}, Partners{"unequal", {0.3, 0.6}, {0.25, 2.0}}};

constexpr Elastic matter{2e4, 0.3};
constexpr double stiffness = 1e4;

Scene law_scene(NormalLaw law, DampingConvention convention) {
  Scene scene =
      law == NormalLaw::linear ? linear_scene(2, 0, stiffness) : hertz_scene(2, 0, matter.young, matter.poisson);
  scene.material.convention = convention;
  return scene;
}

/// Duration of the undamped contact.
double elastic_duration(NormalLaw law, const Partners& partners, double speed) {
  const double mass = reduced(partners.mass[0], partners.mass[1]);
  if (law == NormalLaw::linear) return pi * std::sqrt(mass / stiffness);
  const double radius = reduced(partners.radius[0], partners.radius[1]);
  return hertz_impact(hertz_coefficient(contact_modulus(matter, matter), radius), mass, speed).duration;
}

HeadOn run(const Scene& scene, const Partners& partners, double speed) {
  const Sample<2> sample = pair_apart<2>(generic_direction<2>(), 0, partners.radius, partners.mass);
  const double duration = elastic_duration(scene.material.normal_law, partners, speed);
  return head_on<2>(scene, sample, speed, duration / steps_per_contact, phase, 50 * duration);
}

void check_restitution(NormalLaw law, DampingConvention convention) {
  for (const Partners& partners : all_partners)
    for (double e : {0.05, 0.1, 0.3, 0.5, 0.7, 0.9, 0.99})
      for (double speed : {0.01, 0.1, 1.0}) {  // overlaps of 1e-4 to 1e-2 (linear), 5e-4 to 0.03 (hertz)
        SCOPED_TRACE(to_string(law) + ", " + to_string(convention) + ", " + partners.name +
                     ", e = " + std::to_string(e) + ", V = " + std::to_string(speed));
        Scene scene = law_scene(law, convention);
        scene.material.restitution = e;
        const HeadOn impact = run(scene, partners, speed);
        EXPECT_NEAR(impact.restitution, e, 1e-4);
        EXPECT_LT(impact.momentum_error, 1e-14);
      }
}

TEST(RestitutionLaw, LinearElastic) { check_restitution(NormalLaw::linear, DampingConvention::elastic); }
TEST(RestitutionLaw, LinearTotal) { check_restitution(NormalLaw::linear, DampingConvention::total); }
TEST(RestitutionLaw, HertzElastic) { check_restitution(NormalLaw::hertz, DampingConvention::elastic); }
TEST(RestitutionLaw, HertzTotal) { check_restitution(NormalLaw::hertz, DampingConvention::total); }

/// A plane has infinite mass: m* = m.
TEST(RestitutionLaw, Plane) {
  for (NormalLaw law : both_laws)
    for (DampingConvention convention : both_conventions)
      for (double e : {0.1, 0.5, 0.9}) {
        SCOPED_TRACE(to_string(law) + ", " + to_string(convention) + ", e = " + std::to_string(e));
        Scene scene = law_scene(law, convention);
        scene.material.restitution = e;
        const double mass = 0.7;
        const double duration =
            law == NormalLaw::linear
                ? pi * std::sqrt(mass / stiffness)
                : hertz_impact(hertz_coefficient(contact_modulus(matter, matter), 0.4), mass, 0.1).duration;
        const Sample<2> ball = ball_apart<2>(generic_direction<2>(), 0, 0.4, mass);
        const HeadOn impact = head_on<2>(scene, ball, 0.1, duration / steps_per_contact, phase, 50 * duration);
        EXPECT_NEAR(impact.restitution, e, 1e-4);
      }
}

// ---- the integration ----

/// h and h' in units in which m*, the coefficient of the law and the impact speed are 1.
struct Motion {
  double deflection, rate;
};

struct Contact {
  NormalLaw law;
  DampingConvention convention;
  double zeta;

  double acceleration(Motion at) const {
    const double h = std::max(at.deflection, 0.0);
    const double elastic = law == NormalLaw::linear ? h : h * std::sqrt(h);
    const double tangent = law == NormalLaw::linear ? 1 : 1.5 * std::sqrt(h);
    const double force = elastic + 2 * zeta * std::sqrt(tangent) * at.rate;
    return convention == DampingConvention::total ? -std::max(force, 0.0) : -force;
  }
};

Motion runge_kutta(const Contact& contact, Motion y, double dt) {
  const auto slope = [&](Motion at) { return Motion{at.rate, contact.acceleration(at)}; };
  const auto moved = [&](Motion by, double step) {
    return Motion{y.deflection + step * by.deflection, y.rate + step * by.rate};
  };
  const Motion a = slope(y);
  const Motion b = slope(moved(a, dt / 2));
  const Motion c = slope(moved(b, dt / 2));
  const Motion d = slope(moved(c, dt));
  return {y.deflection + dt / 6 * (a.deflection + 2 * b.deflection + 2 * c.deflection + d.deflection),
          y.rate + dt / 6 * (a.rate + 2 * b.rate + 2 * c.rate + d.rate)};
}

struct Outcome {
  double restitution, duration;
};

/// From h = 0, h' = 1 until h = 0 again. The cut-off of `total` costs an error of order dt^2 where it sets in, the
/// fourth root of h in Hertz's damping one of order dt^(5/4) at both ends: 1e-6 at dt = 1e-5.
Outcome integrate(const Contact& contact) {
  const double dt = 1e-5;
  Motion y{0, 1};
  double time = 0;
  for (Motion next = runge_kutta(contact, y, dt); next.deflection > 0 || time == 0;
       next = runge_kutta(contact, y, dt)) {
    y = next;
    time += dt;
  }
  double low = 0, high = dt;
  for (int k = 0; k < 50; ++k) {
    const double middle = (low + high) / 2;
    (runge_kutta(contact, y, middle).deflection > 0 ? low : high) = middle;
  }
  return {-runge_kutta(contact, y, low).rate, time + low};
}

/// Time in units of that integration: sqrt(m*/K), or (m*^2 / (k^2 V))^(1/5) for Hertz.
double time_unit(NormalLaw law, const Partners& partners, double speed) {
  const double mass = reduced(partners.mass[0], partners.mass[1]);
  if (law == NormalLaw::linear) return std::sqrt(mass / stiffness);
  const double k = hertz_coefficient(contact_modulus(matter, matter), reduced(partners.radius[0], partners.radius[1]));
  return std::pow(mass * mass / (k * k * speed), 0.2);
}

void check_damping_ratio(NormalLaw law, DampingConvention convention, std::span<const double> ratios) {
  for (double zeta : ratios)
    for (const Partners& partners : all_partners) {
      SCOPED_TRACE(to_string(law) + ", " + to_string(convention) + ", " + partners.name +
                   ", zeta = " + std::to_string(zeta));
      Scene scene = law_scene(law, convention);
      scene.material.restitution.reset();
      scene.material.damping_ratio = zeta;
      const double speed = 0.1;
      const HeadOn impact = run(scene, partners, speed);
      const Outcome expected = integrate({law, convention, zeta});
      EXPECT_NEAR(impact.restitution, expected.restitution, 1e-4);
      // An error of e dt / 2 in the velocity after the contact is what half a step of damping makes of the duration.
      EXPECT_NEAR(impact.contact_time / time_unit(law, partners, speed) / expected.duration, 1,
                  1e-4 / expected.restitution);
    }
}

TEST(RestitutionLaw, DampingRatioLinear) {
  check_damping_ratio(NormalLaw::linear, DampingConvention::elastic, std::array{0.0, 0.05, 0.3, 0.7});
  check_damping_ratio(NormalLaw::linear, DampingConvention::total, std::array{0.05, 0.3, 0.7, 1.5});
}
TEST(RestitutionLaw, DampingRatioHertz) {
  check_damping_ratio(NormalLaw::hertz, DampingConvention::elastic, std::array{0.0, 0.05, 0.3, 0.6});
  check_damping_ratio(NormalLaw::hertz, DampingConvention::total, std::array{0.05, 0.3, 0.7, 1.5});
}

TEST(RestitutionLaw, ConventionsDiffer) {
  // What the files above tell apart: at zeta = 0.3 the two conventions are 0.079 apart, and Hertz 0.04 from linear.
  const auto e = [](NormalLaw law, DampingConvention convention) {
    return integrate({law, convention, 0.3}).restitution;
  };
  EXPECT_NEAR(e(NormalLaw::linear, DampingConvention::elastic), std::exp(-0.3 * pi / std::sqrt(0.91)), 1e-6);
  EXPECT_GT(e(NormalLaw::linear, DampingConvention::total), 0.07 + e(NormalLaw::linear, DampingConvention::elastic));
  EXPECT_LT(e(NormalLaw::hertz, DampingConvention::elastic), e(NormalLaw::linear, DampingConvention::elastic) - 0.03);
}

}  // namespace
}  // namespace galet::test::restitution_law_test
