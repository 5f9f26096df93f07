// Rest stays rest, over a million steps: grains on slopes just below their limits do not move at all, just above them
// they speed up as they must, and what is held under weight or pressure keeps its penetration below the one that the
// scene allows.
#include <gtest/gtest.h>

#include "tests/support/scenes.hpp"

namespace galet::test::cd_rest_test {
namespace {

constexpr long million = 1000000;
constexpr double radius = 0.5;

/// A ball on a slope at `share` of its limit, tan(theta) = share * min(mu, mu_R / R).
template <int D>
void check_slope(double friction, double rolling) {
  SCOPED_TRACE("mu = " + std::to_string(friction) + ", mu_R = " + std::to_string(rolling));
  const double theta = std::atan(0.99 * std::min(friction, rolling / radius));
  Scene scene = free_scene(D, friction, 0.5, 1e4);
  scene.material.rolling_friction = rolling;
  const Vec<D> g = -std::cos(theta) * up<D>() + std::sin(theta) * generic_tangent<D>(up<D>());
  scene.loading.gravity.assign(g.data(), g.data() + D);
  scene.cd.dt = 1e-2;
  const Sample<D> sample = ball_on_plane<D>(up<D>(), 0.0);
  const auto engine = make_engine<D>(EngineKind::cd, scene, sample);
  engine->advance(million);
  const Snapshot<D> state = engine->snapshot();
  // Velocities of rounding, 1e-16 g dt, with one sign for 1e6 steps at worst; positions are rounded at 4e-15 each.
  EXPECT_LT((state.position[0] - sample.position[0]).norm(), 1e-10);
  EXPECT_LT(spin_norm(state.spin[0]), 1e-15);
  EXPECT_EQ(engine->solver_summary().corrections, 0);
  EXPECT_LT(engine->solver_summary().penetration, 1e-8);
}

/// The same ball at 1.01 of its limit: slides (or rolls, where rolling gives way first) with a constant acceleration.
template <int D>
void check_motion(double friction, double rolling) {
  const double tangent = 1.01 * std::min(friction, rolling / radius), theta = std::atan(tangent);
  Scene scene = free_scene(D, friction, 0.5, 1e4);
  scene.material.rolling_friction = rolling;
  const Vec<D> along = generic_tangent<D>(up<D>());
  const Vec<D> g = -std::cos(theta) * up<D>() + std::sin(theta) * along;
  scene.loading.gravity.assign(g.data(), g.data() + D);
  scene.cd.dt = 1e-3;
  const Sample<D> sample = ball_on_plane<D>(up<D>(), 0.0);
  const auto engine = make_engine<D>(EngineKind::cd, scene, sample);
  engine->advance(million);
  const bool slides = friction < rolling / radius;
  const double a =
      (std::sin(theta) - std::min(friction, rolling / radius) * std::cos(theta)) / (slides ? 1 : 1 + inertia_ratio<D>);
  const double time = 1e-3 * million, speed = a * time;
  const Snapshot<D> state = engine->snapshot();
  // a is 1 % of the forces that nearly balance: rounding of 1e-16 g dt in each step, with one sign at worst, is 1e-10
  // of the speed.
  EXPECT_NEAR(state.velocity[0].dot(along), speed, 1e-9 * speed);
  EXPECT_NEAR(spin_norm(state.spin[0]), slides ? 0 : speed / radius, 1e-9 * speed / radius);
  // Positions move with the velocity of each step's end: dt / 2 times the speed further than the parabola.
  const double path = speed * time / 2 + 1e-3 * speed / 2;
  EXPECT_NEAR((state.position[0] - sample.position[0]).dot(along), path, 1e-9 * path);
  EXPECT_LT(engine->solver_summary().penetration, 1e-8);
}

TEST(MotionOverAMillionSteps, DiskOnASlopeAboveItsFrictionAngle) { check_motion<2>(0.3, 0.4); }
TEST(MotionOverAMillionSteps, SphereOnASlopeAboveItsRollingLimit) { check_motion<3>(0.5, 0.1); }

TEST(RestOverAMillionSteps, DiskOnASlopeBelowItsFrictionAngle) { check_slope<2>(0.3, 0.4); }
TEST(RestOverAMillionSteps, SphereOnASlopeBelowItsRollingLimit) { check_slope<3>(0.5, 0.1); }

TEST(RestOverAMillionSteps, ColumnKeepsItsPenetration) {
  Scene scene = free_scene(2, 0.3, 0.3, 1e4);
  scene.loading.gravity = {0, -1};
  scene.cd.dt = 1e-2;
  scene.cd.tolerance = 1e-3;  // loose: drift is what is looked at
  scene.cd.penetration = 1e-5;
  const Sample<2> sample = column_sample<2>(4);
  const auto engine = make_engine<2>(EngineKind::cd, scene, sample);
  double kinetic = 0;
  for (int part = 0; part < 100; ++part) {
    engine->advance(million / 100);
    kinetic = std::max(kinetic, engine->energy().kinetic);
  }
  const SolverSummary summary = engine->solver_summary();
  EXPECT_LE(summary.penetration, 1e-5) << "what the scene asked for, and the engine says so";
  // Corrections move positions only: what moves is the solver's tolerance, (1e-3 g dt)^2 per grain.
  EXPECT_LT(kinetic, 4 * 1e-10);
  for (int i = 0; i < 4; ++i)
    EXPECT_NEAR(engine->snapshot().position[i].y(), sample.position[i].y(), 5e-5) << "no sinking, no rising";
}

TEST(RestOverAMillionSteps, PackingUnderPressureKeepsItsPenetration) {
  // A crystal of 8 disks under pressure and shear stress below its strength: hyperstatic, with a cell that can move.
  Scene scene = periodic_scene(2, 0.5, 0.3, 1e4);
  scene.loading.kind = LoadingKind::drives;
  scene.loading.drives = {{"xx", std::nullopt, 1.0}, {"yy", std::nullopt, 1.0}, {"xy", std::nullopt, 0.1}};
  scene.cd.dt = 1e-2;
  scene.cd.tolerance = 1e-3;
  scene.cd.penetration = 1e-5;
  const auto engine = make_engine<2>(EngineKind::cd, scene, crystal_sample<2>(2, 1.0));
  engine->advance(100);
  const Mat<2> box = engine->snapshot().cell->box;
  engine->advance(million - 100);
  EXPECT_LE(engine->solver_summary().penetration, 1e-5);
  EXPECT_LT((engine->snapshot().cell->box - box).norm(), 1e-4);
}

}  // namespace
}  // namespace galet::test::cd_rest_test
