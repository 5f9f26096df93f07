// Order of convergence of the rigid engine in dt: global errors against closed forms at a fixed time, and what sets
// them.
// Velocities under dry laws on straight paths are exact: theta = 1/2 then sums positions exactly but for the steps in
// which a force changes (order 2), theta = 1 with order 1. On curved paths normals are those of the step's start, which
// is order 1 with every theta; so are free flight in a sheared cell and impacts, which happen at the end of their step.
// Where an event falls into a step, `phase` is where: errors are root mean squares over phases, spaced evenly, so that
// the fitted order is not that of a lucky one.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/support/scenes.hpp"

namespace galet::test::cd_order_test {
namespace {

constexpr std::array steps{0.02, 0.01, 0.005, 0.0025};
constexpr std::array thetas{1.0, 0.5};
constexpr int phases = 8;

double phase(int index) { return (index + 0.5) / phases; }

/// The fitted order of the errors that `error(dt)` gives, and the errors.
struct Convergence {
  double order = 0;
  std::vector<double> errors;
};

template <class Error>
Convergence converge(const Error& error) {
  Convergence found;
  for (const double dt : steps) found.errors.push_back(error(dt));
  found.order = observed_order(steps, found.errors);
  return found;
}

/// Root mean square of `error(phase)`.
template <class Error>
double over_phases(const Error& error) {
  double sum = 0;
  for (int k = 0; k < phases; ++k) sum += std::pow(error(phase(k)), 2) / phases;
  return std::sqrt(sum);
}

template <int D>
Scene weighty_scene(double friction, double restitution, double dt, double theta) {
  Scene scene = free_scene(D, friction, restitution, 1e4);
  scene.loading.gravity.assign(D, 0.0);
  scene.loading.gravity[D - 1] = -1;
  scene.cd.dt = dt;
  scene.cd.theta = theta;
  scene.cd.tolerance = 1e-13;
  return scene;
}

// ---- dry laws on a plane ----

/// A ball (R = 1/2) set down sliding and spinning askew, with |slip| = `slip`: slides for tau = slip / (mu g (1 + 1/k))
/// with the deceleration mu g against the slip, whose direction stays, then rolls. Returns the distance of the position
/// at time 1 from x = v0 t - mu g s (tau t - tau^2 / 2), s the direction of slip.
template <int D>
double sliding_error(double dt, double theta, double at_phase) {
  constexpr double friction = 0.2, k = inertia_ratio<D>, deceleration = friction * (1 + 1 / k);
  const double tau = (std::round(0.5 / dt) + at_phase) * dt, slip = tau * deceleration;
  Sample<D> sample = ball_on_plane<D>(up<D>(), 0.0);
  const Vec<D> s = generic_tangent<D>(up<D>());
  Vec<D> rolls = 0.3 * s;  // the part of the velocity that rolls: across the slip in 3D
  if constexpr (D == 3) rolls = 0.3 * up<3>().cross(s);
  sample.velocity[0] = rolls + 0.6 * slip * s;
  sample.spin[0] = 2 * cross(up<D>(), Vec<D>(rolls - 0.4 * slip * s));
  const auto engine = make_engine<D>(EngineKind::cd, weighty_scene<D>(friction, 0, dt, theta), sample);
  engine->advance(std::lround(1 / dt));
  const Vec<D> expected = sample.position[0] + sample.velocity[0] - friction * (tau - tau * tau / 2) * s;
  const Vec<D> velocity = sample.velocity[0] - friction * tau * s;
  // Rounding of 400 steps, whatever dt and theta.
  EXPECT_LT((engine->snapshot().velocity[0] - velocity).norm(), 1e-12);
  return (engine->snapshot().position[0] - expected).norm();
}

template <int D>
void check_sliding_to_rolling() {
  constexpr double friction = 0.2;
  const auto with = [](double theta) {
    return converge([&](double dt) { return over_phases([&](double p) { return sliding_error<D>(dt, theta, p); }); });
  };
  // theta = 1/2: the step in which sliding ends has the mean velocity of its ends, and the end of its friction at p
  // makes that wrong by mu g dt p (1 - p) / 2. The mean of p^2 (1 - p)^2 over the phases is 1/30 to 1e-5.
  const Convergence second = with(0.5);
  EXPECT_NEAR(second.order, 2, 1e-4);
  for (std::size_t n = 0; n < steps.size(); ++n)
    EXPECT_NEAR(second.errors[n] / (steps[n] * steps[n]), friction / 2 * std::sqrt(1 / 30.0), 1e-4 * friction);
  // theta = 1: dt / 2 times the change of velocity, mu g tau, plus that.
  const Convergence first = with(1.0);
  EXPECT_NEAR(first.order, 1, 0.02);
  EXPECT_NEAR(first.errors.back() / steps.back(), friction * 0.5 / 2, 0.01 * friction);
}

TEST(OrderCd, SlidingToRolling) {
  check_sliding_to_rolling<2>();
  check_sliding_to_rolling<3>();
}

/// A ball that rolling resistance stops at tau: distance from v0 tau / 2 at time 1.
template <int D>
double rolling_error(double dt, double theta, double at_phase, double time) {
  constexpr double resistance = 0.1, a = 2 * resistance / (1 + inertia_ratio<D>);
  const double tau = (std::round(0.5 / dt) + at_phase) * dt, v0 = a * tau, end = std::min(time, tau);
  Scene scene = weighty_scene<D>(0.5, 0, dt, theta);
  scene.material.rolling_friction = resistance;
  Sample<D> sample = ball_on_plane<D>(up<D>(), 0.0);
  const Vec<D> along = generic_tangent<D>(up<D>());
  sample.velocity[0] = v0 * along;
  sample.spin[0] = 2 * v0 * cross(up<D>(), along);
  const auto engine = make_engine<D>(EngineKind::cd, scene, sample);
  engine->advance(std::lround(time / dt));
  const double expected = v0 * end - a * end * end / 2;
  return (engine->snapshot().position[0] - sample.position[0] - expected * along).norm();
}

template <int D>
void check_rolling() {
  const auto with = [](double theta, double time) {
    return converge(
        [&](double dt) { return over_phases([&](double p) { return rolling_error<D>(dt, theta, p, time); }); });
  };
  EXPECT_NEAR(with(0.5, 1).order, 2, 1e-4);  // through the stop
  EXPECT_NEAR(with(1.0, 1).order, 1, 0.02);
  // Before the stop the velocity is linear in time, which theta = 1/2 sums exactly.
  for (const double error : with(0.5, 0.4).errors) EXPECT_LT(error, 1e-12);
  EXPECT_NEAR(with(1.0, 0.4).order, 1, 1e-4);
}

TEST(OrderCd, RollingToRest) {
  check_rolling<2>();
  check_rolling<3>();
}

// ---- curved paths ----

/// Angle to the vertical at time 1 of a ball of radius r that starts from rest at angle 0.2 and rolls on a fixed one:
/// (1 + k) (R + r) a'' = g sin(a), by the classical Runge-Kutta scheme (error below 1e-14).
double rolled_angle(double radius_sum, double k) {
  double angle = 0.2, rate = 0;
  constexpr int count = 2000;
  constexpr double dt = 1.0 / count;
  const auto acceleration = [&](double a) { return std::sin(a) / ((1 + k) * radius_sum); };
  for (int n = 0; n < count; ++n) {
    const double k1 = acceleration(angle), k2 = acceleration(angle + dt / 2 * rate),
                 k3 = acceleration(angle + dt / 2 * rate + dt * dt / 4 * k1),
                 k4 = acceleration(angle + dt * rate + dt * dt / 2 * k2);
    angle += dt * rate + dt * dt / 6 * (k1 + k2 + k3);
    rate += dt / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
  }
  return angle;
}

/// Error of the position of that ball on a ball that is glued to the floor.
template <int D>
double rolling_off_error(double dt, double theta) {
  constexpr double below = 0.5, above = 0.3;
  Scene scene = weighty_scene<D>(1, 0, dt, theta);
  scene.bodies = {{.name = "floor"}};
  const auto direction = [](double angle) {
    return Vec<D>(std::cos(angle) * up<D>() + std::sin(angle) * generic_tangent<D>(up<D>()));
  };
  Sample<D> sample = pair_sample<D>(direction(0.2), 0, {below, above});
  sample.body = {0, -1};
  const auto engine = make_engine<D>(EngineKind::cd, scene, sample);
  engine->advance(std::lround(1 / dt));
  const Vec<D> expected =
      sample.position[0] + (below + above) * direction(rolled_angle(below + above, inertia_ratio<D>));
  return (engine->snapshot().position[1] - expected).norm();
}

TEST(OrderCd, RollingOffABall) {
  // The force of a step has the direction of its start: order 1 whatever theta.
  for (const double theta : thetas) {
    SCOPED_TRACE(theta);
    const Convergence disk = converge([&](double dt) { return rolling_off_error<2>(dt, theta); });
    const Convergence sphere = converge([&](double dt) { return rolling_off_error<3>(dt, theta); });
    EXPECT_NEAR(disk.order, 1, 0.05);
    EXPECT_NEAR(sphere.order, 1, 0.05);
  }
}

/// A disk that slides over its own periodic images: L_xy = 1 given, sigma_yy = P. Its branch (sin a, cos a) turns with
/// a = a0 + t, since d(sin a)/dt = L_xy cos a; so L_yy = -tan a, and with J the inertia of that mode and V = 3 cos a
///   N = (V P - J / cos^2 a) / (cos a (cos a + mu sin a)),   I dw/dt = -mu N
/// until w = -1, when the disk rolls and needs no friction (mu = 0 in N). The cell starts at L_yy = 0, so that the
/// first step has an impulse J tan(-a0) / (cos a0 (cos a0 + mu sin a0)) besides.
struct SlidingCell {
  static constexpr double start = -0.4, pressure = 2, inertia_of_disk = 1.0 / 8;
  double friction;
  double mode_inertia = 3 * std::cos(start) / 12;
  double lever(double a, double mu) const { return std::cos(a) * (std::cos(a) + mu * std::sin(a)); }
  double force(double t, double mu) const {
    const double c = std::cos(start + t);
    return (3 * c * pressure - mode_inertia / (c * c)) / lever(start + t, mu);
  }
  double spin(double t) const {  // Simpson's rule
    constexpr int halves = 500;
    const double h = t / (2 * halves);
    double impulse = mode_inertia * std::tan(-start) / lever(start, friction);
    for (int n = 0; n < halves; ++n)
      for (const auto& [k, weight] : {std::pair{0, 1}, {1, 4}, {2, 1}})
        impulse += weight * h / 3 * force((2 * n + k) * h, friction);
    return std::max(-friction * impulse / inertia_of_disk, -1.0);
  }
};

struct CellErrors {
  std::vector<double> angle, gap, force, spin;
};

void add_cell_errors(double friction, double dt, double theta, double time, CellErrors& errors) {
  Scene scene = periodic_scene(2, friction, 0, 1e4);
  scene.loading.kind = LoadingKind::plane_shear;
  scene.loading.shear_rate = 1;
  scene.loading.pressure = SlidingCell::pressure;
  scene.cd.dt = dt;
  scene.cd.theta = theta;
  scene.cd.tolerance = 1e-13;
  scene.cd.penetration = 1e-2;  // out of the way
  Sample<2> sample;
  sample.resize(1);
  sample.cell = cube<2>(1, true);
  sample.cell.box << 3, std::sin(SlidingCell::start), 0, std::cos(SlidingCell::start);
  sample.position[0] = Vec<2>(1, 0.3);
  const auto engine = make_engine<2>(EngineKind::cd, scene, sample);
  engine->advance(std::lround(time / dt));
  const Snapshot<2> state = engine->snapshot();
  ASSERT_EQ(state.contacts->size(), 1u);
  const SlidingCell exact{friction};
  const Vec<2>& n = state.contacts->normal[0];
  const double spin = exact.spin(time);
  errors.angle.push_back(std::abs(std::atan(n.x() / n.y()) - (SlidingCell::start + time)));
  errors.gap.push_back(std::abs(state.contacts->gap[0]));
  errors.force.push_back(
      std::abs(std::abs(state.contacts->force[0].dot(n)) - exact.force(time, spin == -1 ? 0 : friction)));
  errors.spin.push_back(std::abs(state.spin[0] - spin));
}

TEST(OrderCd, DiskSlidingOverItsImagesInAShearedCell) {
  int rolling = 0;
  for (const double theta : thetas)
    for (const double friction : {0.05, 0.2})
      for (const double time : {0.2, 0.9}) {
        SCOPED_TRACE(fmt::format("theta = {} mu = {} time {}", theta, friction, time));
        CellErrors errors;
        for (const double dt : steps) add_cell_errors(friction, dt, theta, time, errors);
        ASSERT_EQ(errors.angle.size(), steps.size());
        // The tangent of the start leaves the circle by dt^2 / 2, which the next step takes back: no sum of these.
        EXPECT_NEAR(errors.gap.back() / (steps.back() * steps.back()), 0.5, 0.01);
        EXPECT_NEAR(observed_order(steps, errors.gap), 2, 0.05);
        // Second-order parts of the errors at dt = 0.02 bend the lines by some hundredths.
        EXPECT_NEAR(observed_order(steps, errors.angle), 1, 0.08);
        // With theta = 1/2 the force alternates from step to step about its mean, by some 10 % here, and does not
        // converge: closing a gap g takes the velocity 2 g / dt, which the next step takes back.
        if (theta < 1) continue;
        EXPECT_NEAR(observed_order(steps, errors.force), 1, 0.08);
        EXPECT_NEAR(observed_order(steps, errors.spin), 1, 0.08);
        rolling += SlidingCell{friction}.spin(time) == -1;
      }
  EXPECT_EQ(rolling, 3) << "of four: one still slides";
}

/// Height of a cell of 8 unlike disks sheared under pressure from a loosened crystal, at strain 0.1: contacts that
/// open, close, stick and slide.
double sheared_height(double dt) {
  Scene scene = periodic_scene(2, 0.3, 0, 1e4);
  scene.loading.kind = LoadingKind::plane_shear;
  scene.loading.shear_rate = 0.1;
  scene.loading.pressure = 1;
  scene.cd.dt = dt;
  scene.cd.tolerance = 1e-9;
  scene.cd.max_sweeps = 1000;
  scene.cd.penetration = 1e-2;
  Sample<2> sample = crystal_sample<2>(2, 1.02);
  vary_sizes<2>(sample, 0.02, 5);
  const auto engine = make_engine<2>(EngineKind::cd, scene, sample);
  engine->advance(std::lround(1 / dt));
  return engine->snapshot().cell->box(1, 1);
}

TEST(OrderCd, ShearedSample) {
  // The reference, at 1/16 of the finest step, lacks 1/16 of the last error: 0.03 of the order. Events fall anywhere
  // into their steps, which scatters errors by some 10 %, 0.05 of the order over a factor 8.
  const double reference = sheared_height(steps.back() / 16);
  const Convergence found = converge([&](double dt) { return std::abs(sheared_height(dt) - reference); });
  EXPECT_NEAR(found.order, 1, 0.15);
}

// ---- flight and impacts ----

/// A ball dropped from height 1 + a share of what it falls through in a step, e = 0.7: error of its height at time 4.5,
/// after the third of its bounces.
double bouncing_error(double dt, double theta, double at_phase) {
  constexpr double e = 0.7, end = 4.5;
  const double height = 0.5 * std::pow((std::round(1.2 / dt) + at_phase) * dt, 2);
  double fallen = std::sqrt(2 * height), speed = e * fallen, bounce = fallen;
  int bounces = 1;
  for (; bounce + 2 * speed < end; speed *= e, ++bounces) bounce += 2 * speed;
  EXPECT_EQ(bounces, 3);
  const double left = end - bounce, expected = speed * left - left * left / 2;
  const Sample<2> sample = ball_on_plane<2>(up<2>(), height);
  const auto engine = make_engine<2>(EngineKind::cd, weighty_scene<2>(0, e, dt, theta), sample);
  engine->advance(std::lround(end / dt));
  return engine->snapshot().position[0].y() - sample.position[0].y() + height - expected;
}

TEST(OrderCd, FreeFall) {
  // theta = 1 falls with the velocity of the step's end, g t dt / 2 too far; theta = 1/2 has the parabola.
  for (const double dt : steps) {
    const Sample<2> sample = ball_on_plane<2>(up<2>(), 2);
    for (const double theta : thetas) {
      const auto engine = make_engine<2>(EngineKind::cd, weighty_scene<2>(0, 0, dt, theta), sample);
      engine->advance(std::lround(1 / dt));
      const double fallen = (sample.position[0] - engine->snapshot().position[0]).y();
      EXPECT_NEAR(fallen, 0.5 + (theta == 1 ? dt / 2 : 0), 1e-12);  // rounding of 400 steps
    }
  }
}

TEST(OrderCd, BouncingBall) {
  // An impact happens at the end of its step: each shifts what follows by up to dt. (Height is quadratic in the times,
  // hence the last digits of the order.)
  for (const double theta : thetas) {
    const Convergence found =
        converge([&](double dt) { return over_phases([&](double p) { return bouncing_error(dt, theta, p); }); });
    EXPECT_NEAR(found.order, 1, 0.08) << theta;
  }
}

/// Two balls that meet obliquely with spins, against Walton's law at the direction in which they really touch.
template <int D>
double oblique_error(double friction, double dt, double theta, double at_phase) {
  constexpr double e = 0.6, e_t = 0.3, k = inertia_ratio<D>;
  const Vec<D> along = generic_direction<D>(), aside = generic_tangent<D>(along);
  // Centres pass each other at a distance of 1/2: they touch when |b| = 1, with b = aside / 2 - sqrt(3)/2 along.
  const double meets = (std::round(0.5 / dt) + at_phase) * dt;
  const Vec<D> normal = 0.5 * aside + std::sqrt(0.75) * along, u(-along);
  Sample<D> sample = pair_sample<D>(normal, 0);
  sample.position[1] -= meets * u;
  set_relative_velocity<D>(sample, u);
  sample.spin[0] = sample.spin[1] = -0.4 * cross(along, aside);
  if constexpr (D == 3) sample.spin[0] += Vec<3>(0.2, -0.1, 0.3), sample.spin[1] -= Vec<3>(0.1, 0.3, -0.2);
  Scene scene = free_scene(D, friction, e, 1e4);
  scene.material.tangential_restitution = e_t;
  scene.cd.dt = dt;
  scene.cd.theta = theta;
  scene.cd.tolerance = 1e-13;
  const auto engine = make_engine<D>(EngineKind::cd, scene, sample);
  engine->advance(std::lround(1 / dt));

  Vec<D> slip = u - cross(Spin<D>(0.5 * (sample.spin[0] + sample.spin[1])), normal);
  slip -= slip.dot(normal) * normal;
  const double impulse = 0.5 * (1 + e) * std::abs(u.dot(normal)), tangential_mass = 0.5 / (1 + 1 / k);
  const double stopping = (1 + e_t) * tangential_mass * slip.norm();
  const Vec<D> p = impulse * normal - std::min(stopping, friction * impulse) * slip.normalized();
  const Vec<D> expected = sample.position[1] + meets * sample.velocity[1] + (1 - meets) * (sample.velocity[1] + p);
  const Spin<D> spin = sample.spin[1] - 0.5 / (k * 0.25) * cross(normal, p);
  const Snapshot<D> state = engine->snapshot();
  return std::max((state.position[1] - expected).norm(), spin_norm(Spin<D>(state.spin[1] - spin)));
}

TEST(OrderCd, ObliqueImpacts) {
  for (const double theta : thetas)
    for (const double friction : {0.1, 1.0}) {
      SCOPED_TRACE(fmt::format("theta = {} mu = {}", theta, friction));
      const Convergence disks = converge(
          [&](double dt) { return over_phases([&](double p) { return oblique_error<2>(friction, dt, theta, p); }); });
      const Convergence spheres = converge(
          [&](double dt) { return over_phases([&](double p) { return oblique_error<3>(friction, dt, theta, p); }); });
      // The pair is up to dt from where it touches when the impact takes its normal.
      EXPECT_NEAR(disks.order, 1, 0.02);
      EXPECT_NEAR(spheres.order, 1, 0.02);
    }
}

}  // namespace
}  // namespace galet::test::cd_order_test
