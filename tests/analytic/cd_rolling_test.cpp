// Rolling and pivoting resistance of rigid grains on a plane under gravity (k = I / (m R^2)).
//   level:  a rolling ball is slowed by a = (mu_R / R) g / (1 + k) without slipping, and stops after v^2 / (2a)
//   slope:  rests iff tan(theta) <= mu_R / R and <= mu; else rolls with a = (g sin(theta) - (mu_R/R) g cos(theta)) / (1
//   + k)
//           as long as friction holds (|F_T| <= mu N)
//   pivoting (sphere): dw/dt = -mu_P N / I about the normal; the time to rest is w_0 I / (mu_P N)
// Resistances are dry, so that all of this holds to rounding as long as nothing changes its sign within a step.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/support/scenes.hpp"

namespace galet::test::cd_rolling_test {
namespace {

constexpr double radius = 0.5;

template <int D>
Scene slope_scene(double tangent, double friction, double rolling, double pivoting = 0) {
  Scene scene = free_scene(D, friction, 0, 1e4);
  scene.material.rolling_friction = rolling;
  scene.material.pivoting_friction = D == 3 ? pivoting : 0;
  const double theta = std::atan(tangent);
  const Vec<D> g = -std::cos(theta) * up<D>() + std::sin(theta) * generic_tangent<D>(up<D>());
  scene.loading.gravity.assign(g.data(), g.data() + D);
  scene.cd.dt = 1e-3;
  scene.cd.tolerance = 1e-12;
  return scene;
}

template <int D>
double speed(const Engine<D>& engine) {
  return const_cast<Engine<D>&>(engine).snapshot().velocity[0].dot(generic_tangent<D>(up<D>()));
}

template <int D>
void check_deceleration() {
  constexpr double k = inertia_ratio<D>, resistance = 0.02, v0 = 0.3;
  Sample<D> sample = ball_on_plane<D>(up<D>(), 0.0);
  const Vec<D> along = generic_tangent<D>(up<D>());
  sample.velocity[0] = v0 * along;
  sample.spin[0] = v0 / radius * cross(up<D>(), along);
  const auto engine = make_engine<D>(EngineKind::cd, slope_scene<D>(0, 0.5, resistance), sample);
  const double a = resistance / radius / (1 + k);
  engine->advance(1000);  // time 1
  // Rounding of 1000 steps.
  EXPECT_NEAR(speed<D>(*engine), v0 - a, 1e-12);
  engine->advance(std::lround(1000 * (v0 / a - 1)) + 2);
  EXPECT_NEAR(speed<D>(*engine), 0, 1e-15);
  EXPECT_LT(spin_norm(engine->snapshot().spin[0]), 1e-14);
  // The end velocity moves the grain over each step: a dt v0 / (2 a) less than the parabola, and one step's rounding
  // up.
  const double stop = (engine->snapshot().position[0] - sample.position[0]).dot(along);
  EXPECT_NEAR(stop, v0 * v0 / (2 * a) - 0.5e-3 * v0, 1e-3 * a * 1e-3 * 2);
}

TEST(RollingCd, SlowsDownAndStops) {
  check_deceleration<2>();
  check_deceleration<3>();
}

template <int D>
void check_slope(double friction, double rolling) {
  SCOPED_TRACE(fmt::format("D = {} mu = {} mu_R = {}", D, friction, rolling));
  const double limit = std::min(friction, rolling / radius);
  for (double share : {0.99, 1.01, 1.5}) {
    const double tangent = share * limit, theta = std::atan(tangent);
    const auto engine =
        make_engine<D>(EngineKind::cd, slope_scene<D>(tangent, friction, rolling), ball_on_plane<D>(up<D>(), 0.0));
    engine->advance(2000);  // time 2
    if (share < 1) {
      EXPECT_LT(engine->snapshot().velocity[0].norm(), 1e-14);
      continue;
    }
    constexpr double k = inertia_ratio<D>;
    const double rolls = (std::sin(theta) - rolling / radius * std::cos(theta)) / (1 + k);
    const double held = std::sin(theta) - rolls;  // friction per mass that rolling takes
    const double slides = std::sin(theta) - friction * std::cos(theta);
    const bool sticks = rolls >= 0 && held <= friction * std::cos(theta);
    // Sliding without rolling where the resistance is the stronger of the two.
    EXPECT_NEAR(speed<D>(*engine), 2 * (sticks ? rolls : slides), 1e-12) << share;
  }
}

TEST(RollingCd, OnASlope) {
  for (const auto& [friction, rolling] : {std::pair{0.6, 0.1}, {0.3, 0.2}, {0.1, 0.3}}) {
    check_slope<2>(friction, rolling);
    check_slope<3>(friction, rolling);
  }
}

TEST(RollingCd, PivotingStopsASpinningBall) {
  constexpr double resistance = 0.03, w0 = 4, inertia = 0.4 * radius * radius;
  Sample<3> sample = ball_on_plane<3>(up<3>(), 0.0);
  sample.spin[0] = w0 * up<3>();
  const auto engine = make_engine<3>(EngineKind::cd, slope_scene<3>(0, 0.5, 0, resistance), sample);
  engine->advance(1000);
  EXPECT_NEAR(engine->snapshot().spin[0].z(), w0 - resistance / inertia, 1e-12);
  // Columns of a contact: the torque is on the plane, against the ball's rotation seen from it.
  ASSERT_EQ(engine->snapshot().contacts->torque.size(), 1u);
  EXPECT_NEAR(engine->snapshot().contacts->torque[0].z(), resistance, 1e-10);
  engine->advance(std::lround(1000 * w0 * inertia / resistance) - 999);
  EXPECT_LT(engine->snapshot().spin[0].norm(), 1e-14);
  EXPECT_LT(engine->snapshot().velocity[0].norm(), 1e-14);
}

TEST(RollingCd, SlidingBecomesRollingWithResistance) {
  // Sliding until the slip is used up: dv/dt = -mu g, R dw/dt = (mu g - mu_R g / R) / k, then rolling as above. With
  // tau the time of the slip, v0 - mu g tau = R w(tau).
  constexpr double friction = 0.3, resistance = 0.05, v0 = 0.4, k = 0.4;
  const double spin_up = (friction - resistance / radius) / k;
  const double tau = v0 / (friction + spin_up), end = 1.0;
  const double expected = spin_up * tau - resistance / radius / (1 + k) * (end - tau);
  Sample<3> sample = ball_on_plane<3>(up<3>(), 0.0);
  sample.velocity[0] = v0 * generic_tangent<3>(up<3>());
  std::vector<double> error;
  for (double dt : {2e-3, 1e-3}) {
    Scene scene = slope_scene<3>(0, friction, resistance);
    scene.cd.dt = dt;
    const auto engine = make_engine<3>(EngineKind::cd, scene, sample);
    engine->advance(std::lround(end / dt));
    error.push_back(std::abs(speed<3>(*engine) - expected));
  }
  // Impulses add up the same whatever the steps, but for the one in which sliding ends: rolling starts within it, and
  // rolling resistance acts as before and after.
  EXPECT_LT(error[0], 1e-12);
  EXPECT_LT(error[1], 1e-12);
}

}  // namespace
}  // namespace galet::test::cd_rolling_test
