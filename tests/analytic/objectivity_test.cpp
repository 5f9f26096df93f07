// The tangential force of md turns with its contact: with the normal, and about it with the grains' mean spin.
//
// Three looks at it through the engine alone:
//   1. grains so heavy that they keep their spins: a part W about the normal, and a small part across it that makes
//      them slip at a constant speed u: dF_T/dt = -K_T u + W n x F_T has |F_T| = (2 K_T u / W) |sin(W t / 2)|, and
//      after each turn it is back at 0;
//   2. an oblique impact with large rotations against an independent integration of the continuous law;
//   3. the same impact turned as a whole, and with its grains exchanged.
#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "tests/support/scenes.hpp"

namespace galet::test::objectivity_test {
namespace {

Vec<3> tangential_force(const Snapshot<3>& state) {
  const Vec<3> n = state.contacts->normal.at(0), force = state.contacts->force.at(0);
  return force - force.dot(n) * n;
}

constexpr double heavy_stiffness = 1;
constexpr double slip_speed = 1e-3;  // forces up to 1e-3, far below mu F_N = 0.025

/// Two heavy overlapping spheres along z with centres at rest. Spins about z as given, and about y such that grain 1
/// slips along x over grain 0: u_T = -(l_0 w_0 + l_1 w_1) x n.
std::unique_ptr<Engine<3>> heavy_pair(double spin_0, double spin_1, double dt) {
  // Mass 1e14: in a time of 6000 the contact force of 0.05 moves the grains by less than 1e-8.
  Sample<3> sample = pair_sample<3>(Vec<3>::UnitZ(), -0.05, {0.5, 0.5}, {1e14, 1e14});
  sample.spin[0] = Vec<3>(0, -slip_speed / 0.95, spin_0);
  sample.spin[1] = Vec<3>(0, -slip_speed / 0.95, spin_1);
  Scene scene = free_scene(3, 0.5, 1, heavy_stiffness);
  set_dt(scene, dt);
  return make_engine<3>(EngineKind::md, scene, sample);
}

constexpr double tangential_stiffness = 0.5 * heavy_stiffness;

TEST(Objectivity, ForceTurnsAboutTheNormalWithTheMeanSpin) {
  const int steps_per_turn = 500;
  for (const std::array<double, 2> spins : {std::array{1.0, 1.0}, std::array{2.0, 0.0}, std::array{-3.0, 1.0}}) {
    SCOPED_TRACE(spins[0]);
    const double mean = (spins[0] + spins[1]) / 2;
    const double dt = 2 * pi / steps_per_turn;
    const auto engine = heavy_pair(spins[0], spins[1], dt);
    const double largest = 2 * tangential_stiffness * slip_speed;
    for (int look = 1; look <= 10; ++look) {
      engine->advance(steps_per_turn / 10);
      // Half a step of loading may be counted or not at the start, and so may half a step of turning.
      EXPECT_NEAR(tangential_force(engine->snapshot()).norm(), largest * std::abs(std::sin(mean * engine->time() / 2)),
                  largest * dt)
          << look;
    }
    // The direction, too: at mean spin W > 0, F_T starts along -x and turns towards -y.
    const auto early = heavy_pair(spins[0], spins[1], dt);
    early->advance(steps_per_turn / 8);
    const double turned = mean * early->time() / 2;
    const Vec<3> expected = -largest * std::sin(turned) / mean * Vec<3>(std::cos(turned), std::sin(turned), 0);
    EXPECT_LT((tangential_force(early->snapshot()) - expected).norm(), largest * dt);
  }
}

TEST(Objectivity, NoMeanSpinNoTurning) {
  const double dt = 0.01;
  const auto engine = heavy_pair(2, -2, dt);
  engine->advance(1000);
  const Vec<3> expected = -tangential_stiffness * slip_speed * engine->time() * Vec<3>::UnitX();
  EXPECT_LT((tangential_force(engine->snapshot()) - expected).norm(), tangential_stiffness * slip_speed * dt);
}

TEST(Objectivity, ManyTurnsLeaveTheNormUnchanged) {
  // A rotation that is only right to first order lets the norm grow by (W dt)^2 / 2 per step: here by a factor
  // exp(2 pi W dt * 1000 / 2), i.e. without bound. One that keeps the norm leaves F_T on its circle, from 0 to the peak
  // 2 K_T u / W and back in every turn, up to half a step's loading at the start. (Its angle may err by some
  // (W dt)^3 per step: a turn is not expected to end after a given number of steps.)
  const int steps_per_turn = 100;
  const double dt = 2 * pi / steps_per_turn;
  const auto engine = heavy_pair(1, 1, dt);
  engine->advance(1000L * steps_per_turn);
  double least = INFINITY, largest = 0;
  for (int step = 0; step < steps_per_turn + 1; ++step) {
    engine->advance(1);
    const double norm = tangential_force(engine->snapshot()).norm();
    least = std::min(least, norm), largest = std::max(largest, norm);
  }
  EXPECT_NEAR(largest, 2 * tangential_stiffness * slip_speed, tangential_stiffness * slip_speed * dt);
  EXPECT_LT(least, tangential_stiffness * slip_speed * dt);
}

/// Heavy grain 1 passes grain 0 on a straight line, without spins: from x = -0.6 to 0.5 at a height H = 0.78, so that
/// the normal turns by 1.2 rad. The slip speed is v cos(theta), and F_T turns with the normal without loss:
/// |F_T| = K_T (H asinh(x1 / H) - H asinh(x0 / H)). Returns the relative error of the engine's norm.
double passing_error(int steps) {
  const double height = 0.78, start = -0.6, end = 0.5;
  Sample<3> sample = pair_sample<3>(Vec<3>::UnitZ(), height - 1, {0.5, 0.5}, {1e14, 1e14});
  sample.position[1].x() += start;
  sample.velocity[1] = Vec<3>::UnitX();
  Scene scene = free_scene(3, 50, 1, heavy_stiffness);  // mu so large that nothing slides
  set_dt(scene, (end - start) / steps);
  const auto engine = make_engine<3>(EngineKind::md, scene, sample);
  engine->advance(steps);
  const double elongation = height * (std::asinh(end / height) - std::asinh(start / height));
  return std::abs(tangential_force(engine->snapshot()).norm() / (tangential_stiffness * elongation) - 1);
}

TEST(Objectivity, ForceTurnsWithTheNormalWithoutLoss) {
  // The trapezoidal rule for the slip is of second order. A force that is only projected on the new tangent plane
  // loses a part (turning per step)^2 / 2 in each step, which is of first order in all: 1.2^2 / 2 / 800 = 9e-4.
  const std::array steps{100, 200, 400, 800};
  std::array<double, 4> dt, error;
  for (int level = 0; level < 4; ++level) {
    dt[level] = 1.0 / steps[level];
    error[level] = passing_error(steps[level]);
  }
  EXPECT_GT(observed_order(dt, error), 1.8);
  EXPECT_LT(error[3], 1e-5);  // (1.2 / 800)^2 times a factor of order 1
}

/// The state of an impact of two unequal spheres in an independent integration.
struct Impact {
  Vec<3> x = Vec<3>::Zero();  ///< from grain 0 to grain 1
  Vec<3> u = Vec<3>::Zero();  ///< velocity of grain 1 less that of grain 0
  Vec<3> w0 = Vec<3>::Zero(), w1 = Vec<3>::Zero();
  Vec<3> force = Vec<3>::Zero();  ///< tangential, on grain 1
};

constexpr std::array radii{0.4, 0.6};
constexpr std::array masses{0.7, 1.5};
constexpr double soft_stiffness = 20;  // deflections of 0.2 d and rotations of half a radian during the contact

Impact operator+(const Impact& a, const Impact& b) {
  return {a.x + b.x, a.u + b.u, a.w0 + b.w0, a.w1 + b.w1, a.force + b.force};
}
Impact operator*(double factor, const Impact& a) {
  return {factor * a.x, factor * a.u, factor * a.w0, factor * a.w1, factor * a.force};
}

/// Newton's equations for the pair; no damping, no sliding. dF_T/dt = -K_T u_T + W x F_T, with W the turning of the
/// normal plus the mean spin about it.
Impact time_derivative(const Impact& state) {
  const double distance = state.x.norm(), sum = radii[0] + radii[1];
  const Vec<3> n = state.x / distance;
  const double l0 = radii[0] * distance / sum, l1 = radii[1] * distance / sum;
  const Vec<3> relative = state.u - (l0 * state.w0 + l1 * state.w1).cross(n);
  const Vec<3> slip = relative - relative.dot(n) * n;
  const Vec<3> turning = state.x.cross(state.u) / (distance * distance) + (state.w0 + state.w1).dot(n) / 2 * n;
  const Vec<3> force = soft_stiffness * (sum - distance) * n + state.force;
  const Vec<3> moment = -n.cross(force);
  Impact rate;
  rate.x = state.u;
  rate.u = force * (1 / masses[0] + 1 / masses[1]);
  rate.w0 = l0 * moment / (0.4 * masses[0] * radii[0] * radii[0]);
  rate.w1 = l1 * moment / (0.4 * masses[1] * radii[1] * radii[1]);
  rate.force = -0.5 * soft_stiffness * slip + turning.cross(state.force);
  return rate;
}

Impact integrate(Impact state, double duration) {
  const int steps = 2000;  // error of order (1/2000)^4
  const double dt = duration / steps;
  for (int k = 0; k < steps; ++k) {
    const Impact a = time_derivative(state);
    const Impact b = time_derivative(state + dt / 2 * a);
    const Impact c = time_derivative(state + dt / 2 * b);
    const Impact d = time_derivative(state + dt * c);
    state = state + dt / 6 * (a + 2 * b + 2 * c + d);
  }
  return state;
}

Sample<3> oblique_pair(double gap) {
  const Vec<3> n = generic_direction<3>();
  Sample<3> sample = pair_sample<3>(n, gap, radii, masses);
  set_relative_velocity<3>(sample, -n + 0.8 * generic_tangent<3>(n));
  sample.spin[0] = Vec<3>(0.9, -1.1, 1.4) + 2 * n;
  sample.spin[1] = Vec<3>(-0.5, 1.3, 0.2) + 2 * n;
  return sample;
}

TEST(Objectivity, ObliqueImpactFollowsTheContinuousLaw) {
  const Sample<3> sample = oblique_pair(0);
  const double reduced_mass = 1 / (1 / masses[0] + 1 / masses[1]);
  // 0.6 of the contact's duration: the grains have turned, are still pressed, and mu = 5 has let nothing slide.
  const double duration = 0.6 * pi * std::sqrt(reduced_mass / soft_stiffness);
  Impact start;
  start.x = sample.position[1] - sample.position[0];
  start.u = sample.velocity[1] - sample.velocity[0];
  start.w0 = sample.spin[0], start.w1 = sample.spin[1];
  const Impact expected = integrate(start, duration);
  std::array<double, 4> dt, error;
  for (int level = 0; level < 4; ++level) {
    const long steps = 40L << level;
    dt[level] = duration / static_cast<double>(steps);
    Scene scene = free_scene(3, 5, 1, soft_stiffness);
    scene.md.allow_unsafe_dt = true;
    set_dt(scene, dt[level]);
    const auto engine = make_engine<3>(EngineKind::md, scene, sample);
    engine->advance(steps);
    const Snapshot<3> state = engine->snapshot();
    ASSERT_EQ(state.contacts->size(), 1u);
    error[level] = (relative_velocity<3>(state) - expected.u).norm() + (state.spin[0] - expected.w0).norm() +
                   (state.spin[1] - expected.w1).norm() +
                   (tangential_force(state) - expected.force).norm() / expected.force.norm();
  }
  // Order 1 at least (the first step of a contact); wrong physics would stop converging at the size of what it
  // leaves out. The sum of the four errors at 320 steps: 4 times the relative size of a step.
  EXPECT_GT(observed_order(dt, error), 0.9);
  EXPECT_LT(error[3], 4.0 / 320);
}

struct Outcome {
  std::vector<Vec<3>> velocity, spin;
};

Outcome outcome(EngineKind kind, const Sample<3>& sample) {
  Scene scene = free_scene(3, 0.35, 0.6, soft_stiffness);
  scene.cd.tolerance = 1e-13;
  set_dt(scene, 2e-3);
  const auto engine = make_engine<3>(kind, scene, sample);
  engine->advance(500);
  const Snapshot<3> state = engine->snapshot();
  EXPECT_FALSE(in_contact<3>(state));
  EXPECT_GT((state.velocity[0] - sample.velocity[0]).norm(), 0.1);
  return {{state.velocity.begin(), state.velocity.end()}, {state.spin.begin(), state.spin.end()}};
}

// No feedback amplifies rounding in a single impact: 500 steps of rounding 1e-15 each.
constexpr double rounding = 1e-12;
constexpr double some_gap = 1.3e-3;  // 0.65 steps: no rounding decides in which step the grains touch

TEST(Objectivity, TurningTheWholeImpactTurnsItsOutcome) {
  for (EngineKind kind : both_engines) {
    SCOPED_TRACE(to_string(kind));
    Sample<3> sample = oblique_pair(some_gap);
    const Outcome plain = outcome(kind, sample);
    const Mat<3> turn = Eigen::AngleAxisd(2.1, Vec<3>(1, -2, 0.5).normalized()).toRotationMatrix();
    const Vec<3> centre = Vec<3>::Constant(10);
    for (int i = 0; i < 2; ++i) {
      sample.position[i] = centre + turn * (sample.position[i] - centre);
      sample.velocity[i] = turn * sample.velocity[i];
      sample.spin[i] = turn * sample.spin[i];
    }
    const Outcome turned = outcome(kind, sample);
    for (int i = 0; i < 2; ++i) {
      EXPECT_LT((turned.velocity[i] - turn * plain.velocity[i]).norm(), rounding);
      EXPECT_LT((turned.spin[i] - turn * plain.spin[i]).norm(), rounding);
    }
  }
}

TEST(Objectivity, ExchangingTheGrainsExchangesTheirOutcome) {
  for (EngineKind kind : both_engines) {
    SCOPED_TRACE(to_string(kind));
    Sample<3> sample = oblique_pair(some_gap);
    const Outcome plain = outcome(kind, sample);
    std::swap(sample.position[0], sample.position[1]);
    std::swap(sample.velocity[0], sample.velocity[1]);
    std::swap(sample.spin[0], sample.spin[1]);
    std::swap(sample.radius[0], sample.radius[1]);
    std::swap(sample.mass[0], sample.mass[1]);
    const Outcome swapped = outcome(kind, sample);
    for (int i = 0; i < 2; ++i) {
      EXPECT_LT((swapped.velocity[i] - plain.velocity[1 - i]).norm(), rounding);
      EXPECT_LT((swapped.spin[i] - plain.spin[1 - i]).norm(), rounding);
    }
  }
}

}  // namespace
}  // namespace galet::test::objectivity_test
