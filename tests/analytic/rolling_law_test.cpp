// Rolling and pivoting resistance of md, and rolling with the Hertz law (references.md, T2, T4, T5). A ball of radius R
// on a plane, N = m g cos(theta), k = I / (m R^2), lever l = R - h, k' = k R^2 / l^2:
//   T2  from sliding speed v0: rolls after t = v0 k' / ((1 + k') mu g), at v0 / (1 + k').
//   T4  slope: rolls iff tan(theta) <= mu (1 + 1/k'), a = g sin(theta) / (1 + k'); else a = g (sin - mu cos).
//   T5  with a resisting moment mu_R N at most: rests iff tan(theta) <= mu_R / l (and <= mu); else
//       a = g (sin(theta) - (mu_R / l) cos(theta)) / (1 + k').
//   Rolling on the level: dv/dt = -g (mu_R / l) / (1 + k'). Spinning about the vertical: dw/dt = -mu_P N / I.
// A small tangential viscosity lets the tangential spring come to rest; then these hold to rounding.
#include <gtest/gtest.h>

#include "tests/support/impact.hpp"

namespace galet::test::rolling_law_test {
namespace {

constexpr double gravity = 1, friction = 0.3, radius = 0.5;
constexpr double deflection = 1e-6;  // under the weight m g = 1

/// k' = I / (m l^2).
template <int D>
double inertia_over_lever() {
  const double lever = radius - deflection;
  return inertia_ratio<D> * radius * radius / (lever * lever);
}

/// dF_N/dh under the weight.
double tangent(NormalLaw law) { return (law == NormalLaw::linear ? 1 : 1.5) / deflection; }

constexpr double poisson = 0.3;

/// K_T / K_N.
double tangential_ratio(NormalLaw law) { return law == NormalLaw::linear ? 0.5 : (2 - 2 * poisson) / (2 - poisson); }

/// A scene whose ball rests at `deflection` under the normal force N = `load`.
template <int D>
Scene weight_scene(NormalLaw law, double load, double tangential_damping) {
  Scene scene;
  if (law == NormalLaw::linear) {
    scene = linear_scene(D, friction, load / deflection);
  } else {
    const double modulus = 0.75 * load / std::sqrt(radius) * std::pow(deflection, -1.5);
    scene = hertz_scene(D, friction, 2 * modulus * (1 - poisson * poisson), poisson);
  }
  scene.material.tangential_damping_ratio = tangential_damping;
  // The fastest motion is the tangential spring's, with w^2 = K_T / m (1 + 1/k): 33 steps per radian.
  set_dt(scene, 0.03 / std::sqrt(load * tangent(law) * tangential_ratio(law) * (1 + 1 / inertia_ratio<D>)));
  return scene;
}

/// The ball in its rest position. The plane is at height 1, so that deflections are rounded by 1e-16 only.
template <int D>
Sample<D> resting_ball() {
  Sample<D> sample = ball_apart<D>(-up<D>(), 0, radius, 1);
  sample.planes[0].point[D - 1] = 1;
  sample.position[0][D - 1] = 1 + radius - deflection;
  return sample;
}

/// Gravity that pulls with g cos(theta) onto the plane and g sin(theta) along it, tan(theta) given.
template <int D>
void tilt(Scene& scene, const Vec<D>& direction, double tangent_angle) {
  const double cosine = 1 / std::hypot(1.0, tangent_angle);
  const Vec<D> g = gravity * cosine * (tangent_angle * direction - up<D>());
  scene.loading.gravity.assign(g.data(), g.data() + D);
}

template <int D>
Vec<D> along() {
  return generic_tangent<D>(up<D>());
}

/// The spin of rolling along `along`, per unit of w: R w x (-up) + v = 0 for v = R w.
template <int D>
Spin<D> rolling_axis() {
  return cross(up<D>(), along<D>());
}
inline double along_axis(double spin, double axis) { return spin * axis; }
inline double along_axis(const Vec<3>& spin, const Vec<3>& axis) { return spin.dot(axis); }

template <int D>
double speed_of(const Snapshot<D>& state) {
  return state.velocity[0].dot(along<D>());
}
template <int D>
double spin_of(const Snapshot<D>& state) {
  return along_axis(state.spin[0], rolling_axis<D>());
}
template <int D>
double slip_of(const Snapshot<D>& state) {
  return speed_of<D>(state) - (radius - deflection) * spin_of<D>(state);
}

constexpr double start_speed = 0.1;

template <int D>
void check_speed_after_sliding(NormalLaw law, DampingConvention convention) {
  SCOPED_TRACE(to_string(law) + ", " + to_string(convention) + ", D = " + std::to_string(D));
  Scene scene = weight_scene<D>(law, 1, 0.2);
  scene.material.convention = convention;
  tilt<D>(scene, along<D>(), 0);
  Sample<D> sample = resting_ball<D>();
  sample.velocity[0] = start_speed * along<D>();
  const auto engine = make_engine<D>(EngineKind::md, scene, sample);
  engine->advance(std::lround(0.3 / engine->dt()));
  const Snapshot<D> state = engine->snapshot();
  // Friction has one and the same lever for v and w, so m l v + I w keeps its value however the slip came to an end.
  // What rings decays as exp(-0.2 w_T t), w_T > 1000, from t = 0.11 on: nothing is left. Heights are rounded by
  // 2e-16, i.e. 2e-10 of the deflection; forces and their impulses follow.
  const double rolling = start_speed / (1 + inertia_over_lever<D>());
  EXPECT_NEAR(speed_of<D>(state), rolling, 1e-9);
  EXPECT_NEAR(slip_of<D>(state), 0, 1e-9);
  EXPECT_LT((state.velocity[0] - speed_of<D>(state) * along<D>()).norm(), 1e-9);
}

TEST(RollingLaw, SpeedAfterSliding) {
  for (NormalLaw law : both_laws)
    for (DampingConvention convention : both_conventions) {
      check_speed_after_sliding<2>(law, convention);
      check_speed_after_sliding<3>(law, convention);
    }
}

template <int D>
void check_slide_to_roll(NormalLaw law) {
  SCOPED_TRACE(to_string(law) + ", D = " + std::to_string(D));
  Scene scene = weight_scene<D>(law, 1, 0);
  tilt<D>(scene, along<D>(), 0);
  Sample<D> sample = resting_ball<D>();
  sample.velocity[0] = start_speed * along<D>();
  const auto engine = make_engine<D>(EngineKind::md, scene, sample);
  const double k = inertia_over_lever<D>(), a = k / (1 + k);
  const double expected = start_speed * a / (friction * gravity);
  while (slip_of<D>(engine->snapshot()) > 0 && engine->time() < 2 * expected) engine->advance(1);
  // The spring loads during t = mu m g / (K_T v0), which costs half of that; as the force of t = 0 it counts as
  // unloaded for half a step at least, and the crossing is seen a step late at most.
  const double loading = friction / (tangential_ratio(law) * tangent(law) * start_speed);
  EXPECT_NEAR(engine->time(), expected, 1.5 * engine->dt() + loading);
  engine->advance(std::lround(expected / engine->dt()));
  // (v0^2 / mu g)(a - a^2 / 2) while sliding, then at v0 / (1 + k). The late start displaces it by less than v0 times
  // that delay, the ringing of the spring by mu g / w_T^2 < 3e-7.
  const double distance = (engine->snapshot().position[0] - sample.position[0]).dot(along<D>());
  const double slid = start_speed * start_speed / (friction * gravity) * (a - a * a / 2);
  EXPECT_NEAR(distance, slid + start_speed * (1 - a) * (engine->time() - expected),
              start_speed * (engine->dt() + loading) + 3e-7);
}

TEST(RollingLaw, TimeAndDistanceOfSliding) {
  for (NormalLaw law : both_laws) {
    check_slide_to_roll<2>(law);
    check_slide_to_roll<3>(law);
  }
}

/// Mean acceleration from time `from` to time `to`: of the centre and of R times the spin.
struct Acceleration {
  double centre, rim;
};

template <int D>
Acceleration acceleration(Engine<D>& engine, double from, double to) {
  engine.advance(std::lround((from - engine.time()) / engine.dt()));
  const double v = speed_of<D>(engine.snapshot()), w = spin_of<D>(engine.snapshot()), start = engine.time();
  engine.advance(std::lround((to - engine.time()) / engine.dt()));
  const double duration = engine.time() - start;
  return {(speed_of<D>(engine.snapshot()) - v) / duration, radius * (spin_of<D>(engine.snapshot()) - w) / duration};
}

template <int D>
void check_slope(NormalLaw law, double tangent_angle) {
  SCOPED_TRACE(to_string(law) + ", D = " + std::to_string(D) + ", tan = " + std::to_string(tangent_angle));
  const double cosine = 1 / std::hypot(1.0, tangent_angle), sine = tangent_angle * cosine;
  Scene scene = weight_scene<D>(law, cosine, 0.2);
  tilt<D>(scene, along<D>(), tangent_angle);
  const auto engine = make_engine<D>(EngineKind::md, scene, resting_ball<D>());
  const Acceleration seen = acceleration<D>(*engine, 0.3, 0.5);
  const double k = inertia_over_lever<D>();
  const bool rolls = tangent_angle <= friction * (1 + 1 / k);
  const double centre = rolls ? gravity * sine / (1 + k) : gravity * (sine - friction * cosine);
  const double lever = radius - deflection;
  const double rim = radius * (rolls ? centre / lever : friction * gravity * cosine / (k * lever));
  // Constant forces, once the spring has come to rest: exact but for rounding (2e-10 in F_N, see above).
  EXPECT_NEAR(seen.centre, centre, 1e-8);
  EXPECT_NEAR(seen.rim, rim, 1e-8);
}

TEST(RollingLaw, SlopeWithoutResistance) {
  // The switch is at tan(theta) = 3 mu = 0.9 (disk) and 3.5 mu = 1.05 (sphere).
  for (NormalLaw law : both_laws) {
    for (double tangent_angle : {0.2, 0.88, 0.92, 2.0}) check_slope<2>(law, tangent_angle);
    for (double tangent_angle : {0.2, 1.03, 1.07, 2.0}) check_slope<3>(law, tangent_angle);
  }
}

constexpr double rolling_friction = 0.02;

template <int D>
std::unique_ptr<Engine<D>> resisting_ball(NormalLaw law, double tangent_angle) {
  Scene scene = weight_scene<D>(law, 1 / std::hypot(1.0, tangent_angle), 0.2);
  scene.material.rolling_friction = rolling_friction;
  tilt<D>(scene, along<D>(), tangent_angle);
  return make_engine<D>(EngineKind::md, scene, resting_ball<D>());
}

/// Below the threshold: the load is the share s of the largest moment. Set loose on an unloaded spring, the ball goes
/// beyond the yield angle b = mu_R N / K_R = N / (K_N mu_R) when s > 1/2, by b (s - 1/2) / (1 - s), the length over
/// which the excess of the yield moment uses up the energy (s - 1/2) mu_R N b; then it swings back and forth, without
/// damping, with the amplitude (1 - s) b about a place (1 - s) b behind the furthest.
template <int D>
void check_rest(NormalLaw law, double share) {
  SCOPED_TRACE(to_string(law) + ", D = " + std::to_string(D) + ", share = " + std::to_string(share));
  const double lever = radius - deflection;
  const double tangent_angle = share * rolling_friction / lever;
  const auto engine = resisting_ball<D>(law, tangent_angle);
  const Vec<D> start = engine->snapshot().position[0];
  const double yield = deflection / (law == NormalLaw::linear ? 1 : 1.5) / rolling_friction;
  const double furthest = share > 0.5 ? yield * (1 + (share - 0.5) / (1 - share)) : 2 * share * yield;
  const double amplitude = share > 0.5 ? (1 - share) * yield : share * yield;
  double low = INFINITY, high = 0;
  const int looks = 2000;
  for (int look = 0; look < looks; ++look) {
    engine->advance(std::lround(3 / engine->dt() / looks));
    const double angle = (engine->snapshot().position[0] - start).dot(along<D>()) / lever;
    high = std::max(high, angle);
    if (look > looks / 2) low = std::min(low, angle);
  }
  // The tangential spring gives way by g sin(theta) / K_T (1 % of the yield angle's arc) and takes part in the swing;
  // its dashpot slowly damps that. 3 % of the yield angle for both.
  EXPECT_NEAR(high / yield, furthest / yield, 0.03);
  EXPECT_GT(low / yield, (furthest - 2 * amplitude) / yield - 0.03);
  EXPECT_LT(low / yield, furthest / yield);
}

TEST(RollingLaw, RestsOnASlopeBelowTheThreshold) {
  for (NormalLaw law : both_laws)
    for (double share : {0.3, 0.6, 0.9}) {
      check_rest<2>(law, share);
      check_rest<3>(law, share);
    }
}

template <int D>
void check_resisted_slope(NormalLaw law, double share) {
  SCOPED_TRACE(to_string(law) + ", D = " + std::to_string(D) + ", share = " + std::to_string(share));
  const double lever = radius - deflection, k = inertia_over_lever<D>();
  const double tangent_angle = share * rolling_friction / lever;
  const auto engine = resisting_ball<D>(law, tangent_angle);
  const Acceleration seen = acceleration<D>(*engine, 0.4, 0.6);
  const double cosine = 1 / std::hypot(1.0, tangent_angle);
  const double expected = gravity * cosine * (tangent_angle - rolling_friction / lever) / (1 + k);
  EXPECT_NEAR(seen.centre, expected, 1e-8);  // as above: constant forces
  EXPECT_NEAR(seen.rim, expected * radius / lever, 1e-8);
  const Snapshot<D> state = engine->snapshot();
  ASSERT_EQ(state.contacts->size(), 1u);
  ASSERT_EQ(state.contacts->torque.size(), 1u);
  // On the plane (j), so along the ball's spin; at its bound. 1e-9: rounding of h.
  EXPECT_NEAR(along_axis(state.contacts->torque[0], rolling_axis<D>()), rolling_friction * cosine, 1e-9);
}

TEST(RollingLaw, RollsDownASlopeAboveTheThreshold) {
  for (NormalLaw law : both_laws)
    for (double share : {1.1, 2.0, 5.0}) {
      check_resisted_slope<2>(law, share);
      check_resisted_slope<3>(law, share);
    }
}

template <int D>
void check_level(NormalLaw law) {
  SCOPED_TRACE(to_string(law) + ", D = " + std::to_string(D));
  Scene scene = weight_scene<D>(law, 1, 0.2);
  scene.material.rolling_friction = rolling_friction;
  tilt<D>(scene, along<D>(), 0);
  Sample<D> sample = resting_ball<D>();
  const double lever = radius - deflection, speed = 0.02;
  sample.velocity[0] = speed * along<D>();
  sample.spin[0] = speed / lever * rolling_axis<D>();
  const auto engine = make_engine<D>(EngineKind::md, scene, sample);
  const double braking = gravity * rolling_friction / lever / (1 + inertia_over_lever<D>());
  const Acceleration seen = acceleration<D>(*engine, 0.3, 0.5);
  EXPECT_NEAR(seen.centre, -braking, 1e-8);  // constant forces
  EXPECT_NEAR(seen.rim, -braking * radius / lever, 1e-8);
  engine->advance(std::lround((1.5 * speed / braking - engine->time()) / engine->dt()));
  // The rolling spring, let go at the bound, swings with the energy (mu_R N)^2 / (2 K_R) = 1 / (2 K_N).
  const double swing = 1 / std::sqrt(tangent(law));
  EXPECT_LT(std::abs(speed_of<D>(engine->snapshot())), swing);
  // With b = N / (K_N mu_R), the angle that loads the spring to its bound, the energy is used up at the angle
  // E / (mu_R N) + b / 2; then the spring swings with amplitude b about its unloaded place, b behind that.
  const double distance = (engine->snapshot().position[0] - sample.position[0]).dot(along<D>());
  const double loading = lever / (tangent(law) * rolling_friction);
  EXPECT_NEAR(distance, speed * speed / (2 * braking) - loading / 2, 1.02 * loading);  // 2 %: the tangential spring
}

TEST(RollingLaw, PlasticRollingSlowsABallDown) {
  for (NormalLaw law : both_laws) {
    check_level<2>(law);
    check_level<3>(law);
  }
}

void check_pivoting(NormalLaw law, double coulomb) {
  SCOPED_TRACE(to_string(law) + ", mu = " + std::to_string(coulomb));
  const double pivoting_friction = 0.1, inertia = 0.4 * radius * radius;
  Scene scene = weight_scene<3>(law, 1, 0.2);
  scene.material.friction = coulomb;
  scene.material.pivoting_friction = pivoting_friction;
  tilt<3>(scene, along<3>(), 0);
  Sample<3> sample = resting_ball<3>();
  sample.spin[0] = Vec<3>(0, 0, -0.5);
  const auto engine = make_engine<3>(EngineKind::md, scene, sample);
  engine->advance(std::lround(0.1 / engine->dt()));
  const double before = engine->snapshot().spin[0].z(), start = engine->time();
  engine->advance(std::lround(0.2 / engine->dt()));
  const double braking = pivoting_friction / inertia;
  EXPECT_NEAR((engine->snapshot().spin[0].z() - before) / (engine->time() - start), braking, 1e-8);  // constant torque
  // On the plane: along the ball's spin, which is downwards.
  EXPECT_LT((engine->snapshot().contacts->torque.at(0) + pivoting_friction * Vec<3>::UnitZ()).norm(), 1e-9);
  engine->advance(std::lround((0.6 - engine->time()) / engine->dt()));
  // Stopped at t = 0.5; the spring swings with the energy N^2 / (2 K_N).
  EXPECT_LT(std::abs(engine->snapshot().spin[0].z()), 1.01 / std::sqrt(tangent(law) * inertia));
  EXPECT_LT(engine->snapshot().velocity[0].norm(), 1e-9);
  EXPECT_LT(std::hypot(engine->snapshot().spin[0].x(), engine->snapshot().spin[0].y()), 1e-9);
}

TEST(RollingLaw, PivotingStopsASpinningBall) {
  for (NormalLaw law : both_laws)
    for (double coulomb : {0.0, friction}) check_pivoting(law, coulomb);
}

}  // namespace
}  // namespace galet::test::rolling_law_test
