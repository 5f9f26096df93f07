// A grain that slides on a plane under gravity until it rolls, and a grain on a slope (k = I / (m R^2): disk 1/2,
// sphere 2/5).
//   From sliding speed v0: rolls from t = v0 k / ((1 + k) mu g) on, at v0 / (1 + k) (2/3 disk, 5/7 sphere).
//   Slope of angle theta: rolls iff tan(theta) <= mu (1 + 1/k), with a = g sin(theta) / (1 + k); else it slides with
//   a = g (sin(theta) - mu cos(theta)) and dw/dt = mu g cos(theta) / (k R).
// md: the tangential spring rings undamped once it sticks, with the frequency w_T = sqrt(K_T / m (1 + 1/k)).
#include <gtest/gtest.h>

#include "tests/support/scenes.hpp"

namespace galet::test::rolling_test {
namespace {

constexpr double gravity = 1;
constexpr double friction = 0.3;
constexpr double stiffness = 1e5;  // static deflection m g / K = 1e-5, i.e. levers change by 2e-5 of R
constexpr double radius = 0.5;

template <int D>
double spring_frequency() {
  return std::sqrt(0.5 * stiffness * (1 + 1 / inertia_ratio<D>));
}

template <int D>
Scene gravity_scene(const Vec<D>& direction) {
  Scene scene = free_scene(D, friction, 0.3, stiffness);
  const Vec<D> g = gravity * direction;
  scene.loading.gravity.assign(g.data(), g.data() + D);
  scene.cd.tolerance = 1e-12;
  scene.cd.dt = 1e-3;
  return scene;
}

/// A ball on the plane, in md at its static deflection under the normal force m g `share`.
template <int D>
Sample<D> resting_ball(EngineKind kind, double share) {
  return ball_on_plane<D>(up<D>(), kind == EngineKind::md ? -gravity * share / stiffness : 0.0);
}

template <int D>
Vec<D> along() {
  return generic_tangent<D>(up<D>());
}

/// Velocity of the grain's contact point over the plane, along the direction of motion.
template <int D>
double slip(const Snapshot<D>& snapshot) {
  return (snapshot.velocity[0] + cross(snapshot.spin[0], Vec<D>(-radius * up<D>()))).dot(along<D>());
}

template <int D>
double speed_of(const Snapshot<D>& snapshot) {
  return snapshot.velocity[0].dot(along<D>());
}

/// Mean of a quantity over `duration` of time from now on.
template <int D, class Quantity>
double mean_over(Engine<D>& engine, double duration, Quantity quantity) {
  const long steps = std::lround(duration / engine.dt());
  double sum = 0;
  for (long k = 0; k < steps; ++k) {
    engine.advance(1);
    sum += quantity(engine.snapshot());
  }
  return sum / static_cast<double>(steps);
}

constexpr double start_speed = 0.1;

template <int D>
double roll_start() {
  constexpr double k = inertia_ratio<D>;
  return start_speed * k / ((1 + k) * friction * gravity);
}

template <int D>
std::unique_ptr<Engine<D>> sliding_ball(EngineKind kind, double dt) {
  Scene scene = gravity_scene<D>(-up<D>());
  if (dt > 0) set_dt(scene, dt);
  Sample<D> sample = resting_ball<D>(kind, 1);
  sample.velocity[0] = start_speed * along<D>();
  return make_engine<D>(kind, scene, sample);
}

template <int D>
void check_rolling_speed(EngineKind kind, double dt) {
  SCOPED_TRACE(to_string(kind) + " dt = " + std::to_string(dt));
  const auto engine = sliding_ball<D>(kind, dt);
  engine->advance(std::lround(1.5 * roll_start<D>() / engine->dt()));
  const double rolling = start_speed / (1 + inertia_ratio<D>);
  if (kind == EngineKind::cd) {
    // Independent of dt: the impulse that stops the slip does not care how it is cut into steps. The lever arm is
    // R + g with a gap at rounding level.
    EXPECT_NEAR(speed_of<D>(engine->snapshot()), rolling, 1e-10);
    EXPECT_NEAR(slip<D>(engine->snapshot()), 0, 1e-10);
    return;
  }
  // The spring, let go at F_T = mu m g, rings with speed amplitude mu g / w_T = 7e-4. Its mean over a time T errs by
  // 2 / (w_T T) of that; the deflection changes the lever by 2e-5.
  const double window = 0.1;
  const double tolerance = 2 * friction * gravity / std::pow(spring_frequency<D>(), 2) / window + 3e-5 * rolling;
  EXPECT_NEAR(mean_over<D>(*engine, window, speed_of<D>), rolling, tolerance);
  EXPECT_NEAR(mean_over<D>(*engine, window, slip<D>), 0, 4 * tolerance);  // the slip rings 1 + 1/k <= 3.5 times as much
}

TEST(Rolling, SpeedAfterSlidingDisk) {
  for (double dt : {1.3e-3, 2e-4}) check_rolling_speed<2>(EngineKind::cd, dt);
  for (double dt : {0.0, 2e-5}) check_rolling_speed<2>(EngineKind::md, dt);
}
TEST(Rolling, SpeedAfterSlidingSphere) {
  for (double dt : {1.3e-3, 2e-4}) check_rolling_speed<3>(EngineKind::cd, dt);
  for (double dt : {0.0, 2e-5}) check_rolling_speed<3>(EngineKind::md, dt);
}

template <int D>
void check_roll_start(EngineKind kind) {
  SCOPED_TRACE(to_string(kind));
  const auto engine = sliding_ball<D>(kind, kind == EngineKind::md ? 0.0 : 1.7e-4);
  while (slip<D>(engine->snapshot()) > 1e-9 && engine->time() < 2 * roll_start<D>()) engine->advance(1);
  // cd: the slip ends within the step in which rolling starts. md: the spring takes mu m g / (K_T v0) = 6e-5 to load,
  // half of which friction loses; the deflection changes the lever and with it the time by a factor 1 +- 2e-5.
  const double late = kind == EngineKind::md ? 6e-5 : 1e-9;
  const double early = kind == EngineKind::md ? 2e-5 * roll_start<D>() : 1e-9;
  EXPECT_GT(engine->time(), roll_start<D>() - early);
  EXPECT_LT(engine->time(), roll_start<D>() + engine->dt() + late);
}

TEST(Rolling, StartsWhenTheSlipIsUsedUp) {
  for (EngineKind kind : both_engines) {
    check_roll_start<2>(kind);
    check_roll_start<3>(kind);
  }
}

TEST(Rolling, DistanceConvergesInCdAtOrderOne) {
  // At t = 2 roll_start the ball has slid (v0^2 / mu g)(a - a^2/2), a = k/(1+k), and rolled. One constant bounds
  // error / dt for all steps: half a step of the sliding deceleration, mu g t dt / 2, times a margin of 2.
  constexpr double a = inertia_ratio<3> / (1 + inertia_ratio<3>);
  const double slid = start_speed * start_speed / (friction * gravity) * (a - a * a / 2);
  for (double dt : {roll_start<3>() / 10.3, roll_start<3>() / 40.7, roll_start<3>() / 161.9}) {
    SCOPED_TRACE(dt);
    const auto engine = sliding_ball<3>(EngineKind::cd, dt);
    const Vec<3> origin = resting_ball<3>(EngineKind::cd, 1).position[0];
    engine->advance(std::lround(2 * roll_start<3>() / dt));
    const double distance = (engine->snapshot().position[0] - origin).dot(along<3>());
    const double expected = slid + start_speed * (1 - a) * (engine->time() - roll_start<3>());
    EXPECT_NEAR(distance, expected, friction * gravity * roll_start<3>() * dt);
  }
}

template <int D>
void check_slope(EngineKind kind, double tangent_angle) {
  SCOPED_TRACE(to_string(kind) + " D = " + std::to_string(D) + " tan = " + std::to_string(tangent_angle));
  constexpr double k = inertia_ratio<D>;
  const double cosine = 1 / std::hypot(1.0, tangent_angle), sine = tangent_angle * cosine;
  const Scene scene = gravity_scene<D>(sine * along<D>() - cosine * up<D>());
  const auto engine = make_engine<D>(kind, scene, resting_ball<D>(kind, cosine));
  engine->advance(std::lround(1 / engine->dt()));
  const Snapshot<D> state = engine->snapshot();
  const double t = engine->time();
  const bool rolls = tangent_angle <= friction * (1 + 1 / k);
  const double acceleration = rolls ? gravity * sine / (1 + k) : gravity * (sine - friction * cosine);
  const double spin = rolls ? acceleration * t / radius : friction * gravity * cosine / (k * radius) * t;
  // cd: constant forces, so every step is exact up to the solver's tolerance. md: the spring starts unloaded, and the
  // missing load g sin(theta) makes the velocity of the contact point ring with amplitude g sin(theta) / w_T; the
  // spin takes 1/k = 2.5 of that, over R. The lever arm differs by 2e-5.
  const double ringing = gravity * sine / spring_frequency<D>() + 4e-5 * acceleration * t;
  EXPECT_NEAR(speed_of<D>(state), acceleration * t, kind == EngineKind::cd ? 1e-9 : ringing);
  EXPECT_NEAR(spin_norm(state.spin[0]), spin, kind == EngineKind::cd ? 1e-9 : 2.5 * ringing / radius);
  EXPECT_EQ(state.contacts->size(), 1u);
}

TEST(Rolling, OnASlopeDisk) {
  // The switch is at tan(theta) = 3 mu = 0.9.
  for (EngineKind kind : both_engines)
    for (double tangent_angle : {0.2, 0.87, 0.93, 2.0}) check_slope<2>(kind, tangent_angle);
}
TEST(Rolling, OnASlopeSphere) {
  // The switch is at tan(theta) = 7 mu / 2 = 1.05.
  for (EngineKind kind : both_engines)
    for (double tangent_angle : {0.2, 1.02, 1.08, 2.0}) check_slope<3>(kind, tangent_angle);
}

}  // namespace
}  // namespace galet::test::rolling_test
