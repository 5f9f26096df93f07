// Statics under gravity: one ball on a plane, a column, and three cylinders in a heap.
#include <gtest/gtest.h>

#include "tests/support/scenes.hpp"

namespace galet::test::rest_test {
namespace {

constexpr double gravity = 1;
constexpr double stiffness = 1e4;

template <int D>
Scene gravity_scene(double friction) {
  Scene scene = free_scene(D, friction, 0.1, stiffness);
  const Vec<D> g = -gravity * up<D>();
  scene.loading.gravity.assign(g.data(), g.data() + D);
  return scene;
}

constexpr long many_steps = 100000;

template <int D>
void check_soft_ball() {
  const Sample<D> sample = ball_on_plane<D>(up<D>(), 0.0);
  const auto engine = make_engine<D>(EngineKind::md, gravity_scene<D>(0.5), sample);
  engine->advance(many_steps);
  const Snapshot<D> state = engine->snapshot();
  ASSERT_EQ(state.contacts->size(), 1u);
  // The bounce has died out (exp(-zeta w0 t) with t = 1e5 steps is nothing). What keeps it going is the rounding of
  // positions of 16.5 (3.6e-15 in every step): some ten of these in the deflection of 1e-4, K times that in the force,
  // and w0 = 100 times that in the velocity, each with a margin of 3.
  EXPECT_NEAR(-state.contacts->gap[0], gravity / stiffness, 1e-13);
  EXPECT_NEAR(std::abs(state.contacts->force[0].dot(up<D>())), gravity, 1e-9);
  EXPECT_LT(state.velocity[0].norm(), 1e-11);
  const Vec<D> shift = state.position[0] - sample.position[0];
  EXPECT_LT((shift - shift.dot(up<D>()) * up<D>()).norm(), 1e-14);
}

TEST(RestMd, BallOnPlane) {
  check_soft_ball<2>();
  check_soft_ball<3>();
}

template <int D>
void check_rigid_ball(double restitution) {
  SCOPED_TRACE(restitution);
  Scene scene = gravity_scene<D>(0.5);
  scene.material.restitution = restitution;
  scene.cd.dt = 1e-2;
  scene.cd.tolerance = 1e-10;
  scene.cd.penetration = 1e-6;
  const Sample<D> sample = ball_on_plane<D>(up<D>(), 0.0);
  const auto engine = make_engine<D>(EngineKind::cd, scene, sample);
  engine->advance(many_steps);
  const Snapshot<D> state = engine->snapshot();
  ASSERT_EQ(state.contacts->size(), 1u);
  // Each step leaves a velocity of at most tolerance * g dt = 1e-12.
  EXPECT_LT(state.velocity[0].norm(), 1e-12);
  EXPECT_NEAR(std::abs(state.contacts->force[0].dot(up<D>())), gravity, 1e-9);
  EXPECT_LT(std::abs(state.contacts->gap[0]), 1e-6);  // what the scene allows
  const Vec<D> shift = state.position[0] - sample.position[0];
  EXPECT_LT((shift - shift.dot(up<D>()) * up<D>()).norm(), 1e-12);
}

TEST(RestCd, BallOnPlane) {
  for (double restitution : {0.0, 0.5, 1.0}) {
    check_rigid_ball<2>(restitution);
    check_rigid_ball<3>(restitution);
  }
}

/// A ball dropped from height 1 comes to rest after a time sqrt(2h/g) (1 + e) / (1 - e), however many bounces that
/// takes (references.md, T1).
void check_bouncing_ball(EngineKind kind) {
  SCOPED_TRACE(to_string(kind));
  const double e = 0.5, g = 9.81;
  Scene scene = gravity_scene<2>(0);
  scene.material.restitution = e;
  scene.material.normal_stiffness = 1e8;
  scene.loading.gravity = {0, -g};
  scene.md.steps_per_contact = 200;
  scene.cd.dt = 1e-4;
  Sample<2> sample = ball_on_plane<2>(up<2>(), 1.0);
  const double floor = sample.planes[0].point.y() + 0.5;
  const auto engine = make_engine<2>(kind, scene, sample);
  const double stop = std::sqrt(2 / g) * (1 + e) / (1 - e);
  // The fourth impact is at sqrt(2/g) (1 + 2e + 2e^2 + 2e^3); the flight after it has its top e^4 sqrt(2/g) later, at
  // height e^8. cd: an impact happens up to v dt above the floor, which adds up to 2.6 % of that height. md: the error
  // in e at 200 steps per contact, 0.5 % per impact, counts twice in each of four impacts: 4 %.
  const double top = std::sqrt(2 / g) * (1 + 2 * (e + e * e + e * e * e) + std::pow(e, 4));
  engine->advance(std::lround(top / engine->dt()));
  EXPECT_NEAR(engine->snapshot().position[0].y() - floor, std::pow(e, 8), 0.05 * std::pow(e, 8));
  EXPECT_LT(std::abs(engine->snapshot().velocity[0].y()), 0.05 * std::sqrt(2 * g));
  engine->advance(std::lround(0.6 * stop / engine->dt()));
  EXPECT_NEAR(engine->snapshot().position[0].y(), floor, 1e-4);
  // What a rigid ball may keep is the velocity of one step; the soft one still rings below 1e-3.
  EXPECT_LT(std::abs(engine->snapshot().velocity[0].y()), kind == EngineKind::cd ? 2 * g * 1e-4 : 1e-3);
}

TEST(RestCd, BouncingBall) { check_bouncing_ball(EngineKind::cd); }
TEST(RestMd, BouncingBall) { check_bouncing_ball(EngineKind::md); }

/// The k-th contact from the top carries k m g; contact 0 is the plane's.
template <int D>
void expect_column_forces(const Snapshot<D>& state, double tolerance) {
  const int count = state.grains();
  ASSERT_EQ(state.contacts->size(), static_cast<std::size_t>(count));
  for (std::size_t c = 0; c < state.contacts->size(); ++c) {
    const int i = state.contacts->i[c], j = state.contacts->j[c];
    const int below = j == count ? 0 : std::max(i, j);  // the grain whose weight comes first on this contact
    EXPECT_NEAR(std::abs(state.contacts->force[c].dot(up<D>())), (count - below) * gravity, tolerance) << below;
    const Vec<D> force = state.contacts->force[c];
    EXPECT_LT((force - force.dot(up<D>()) * up<D>()).norm(), tolerance);
  }
}

template <int D>
void check_soft_column() {
  const int count = 10;
  const auto engine = make_engine<D>(EngineKind::md, gravity_scene<D>(0.5), column_sample<D>(count));
  // The slowest mode of the chain, w = 2 w1 sin(pi / 42), w1 = sqrt(K/m), is damped by zeta sqrt(2) w^2 / (2 w1):
  // 0.0093 w1 for e = 0.1. After t = 30 its amplitude is down by exp(-0.0093 * 100 * 30) = 1e-12.
  engine->advance(std::lround(30 / engine->dt()));
  const Snapshot<D> state = engine->snapshot();
  expect_column_forces<D>(state, 1e-9);
  for (std::size_t c = 0; c < state.contacts->size(); ++c)
    EXPECT_NEAR(-state.contacts->gap[c], state.contacts->force[c].norm() / stiffness, 1e-13);
}

TEST(RestMd, ColumnCarriesItsWeight) {
  check_soft_column<2>();
  check_soft_column<3>();
}

template <int D>
void check_rigid_column(double solver_tolerance) {
  SCOPED_TRACE(solver_tolerance);
  const int count = 10;
  Scene scene = gravity_scene<D>(0.5);
  scene.cd.dt = 1e-2;
  scene.cd.tolerance = solver_tolerance;
  scene.cd.max_sweeps = 20000;
  const auto engine = make_engine<D>(EngineKind::cd, scene, column_sample<D>(count));
  for (long steps : {1, 200}) {
    engine->advance(steps);
    EXPECT_EQ(engine->solver_summary().missed, 0);
    // The residual is relative to the norm of all impulses (19.6 m g dt) and scaled to a block of mean W = 2 W_NN
    // (disks) or 2.7 W_NN (spheres); the chain's smallest eigenvalue is 2 sin(pi / 42)^2 = 0.0112 of W_NN, so that a
    // residual may hide an error 2.7 / 0.0112 = 240 times as large, 4700 m g dt.
    expect_column_forces<D>(engine->snapshot(), 4700 * solver_tolerance * gravity);
  }
  const Snapshot<D> state = engine->snapshot();
  for (int i = 0; i < count; ++i)
    EXPECT_LT((state.position[i] - column_sample<D>(count).position[i]).norm(), count * scene.cd.penetration);
}

TEST(RestCd, ColumnCarriesItsWeight) {
  for (double tolerance : {1e-4, 1e-10}) {
    check_rigid_column<2>(tolerance);
    check_rigid_column<3>(tolerance);
  }
}

/// Two equal disks on the floor, touching, a third on top of them. Stable iff mu >= tan(15 deg) = 0.268 (on the
/// floor 0.089 is enough); then each floor contact carries 3/2 m g. Returns how far the top disk has sunk.
double heap_settlement(EngineKind kind, double friction) {
  Scene scene = gravity_scene<2>(friction);
  scene.material.normal_stiffness = 1e5;
  scene.cd.dt = 2e-3;
  scene.cd.tolerance = 1e-8;
  Sample<2> sample = column_sample<2>(3);
  sample.position[1] = sample.position[0] + Vec<2>(1, 0);
  sample.position[2] = sample.position[0] + Vec<2>(0.5, std::sqrt(0.75));
  const auto engine = make_engine<2>(kind, scene, sample);
  engine->advance(std::lround(3 / engine->dt()));
  const Snapshot<2> state = engine->snapshot();
  double floor_force = 0;
  for (std::size_t c = 0; c < state.contacts->size(); ++c)
    if (state.contacts->j[c] == 3) floor_force += std::abs(state.contacts->force[c].y());
  const double sunk = sample.position[2].y() - state.position[2].y();
  if (sunk < 1e-2) {
    EXPECT_NEAR(floor_force, 3 * gravity, 1e-3);
  }
  return sunk;
}

TEST(Rest, ThreeDisksStandIffFrictionSuffices) {
  for (EngineKind kind : both_engines) {
    SCOPED_TRACE(to_string(kind));
    // Stable: the top sinks by deflections (md, some 3 m g / K = 3e-5) or by the allowed penetration (cd, 1e-4).
    EXPECT_LT(heap_settlement(kind, 0.29), 5e-4);
    // Unstable by 10 % of mu: accelerates at a few hundredths of g, so it is down by more than 0.05 at t = 3.
    EXPECT_GT(heap_settlement(kind, 0.24), 0.05);
  }
}

}  // namespace
}  // namespace galet::test::rest_test
