// Rest and failure of rigid grains: three cylinders in a heap, a piston on a column, and grains that move fast.
#include <gtest/gtest.h>

#include "common/core/error.hpp"
#include "tests/support/scenes.hpp"

namespace galet::test::cd_statics_test {
namespace {

/// Three equal cylinders, two on the floor and one on them. They stand iff mu between cylinders is at least
/// tan 15 deg = 2 - sqrt 3 and mu on the floor at least a third of that (references.md, T7).
double heap_speed(double between, double floor) {
  Scene scene = free_scene(2, between, 0, 1e4);
  scene.loading.gravity = {0, -1};
  scene.other_materials = {{.name = "floor"}};
  scene.pairs = {{.between = {"default", "floor"}, .friction = floor}};
  scene.cd.dt = 1e-2;
  scene.cd.tolerance = 1e-10;
  scene.cd.max_sweeps = 100000;
  Sample<2> sample = ball_on_plane<2>(up<2>(), 0.0);
  const Vec<2> left = sample.position[0];
  const auto planes = sample.planes;
  sample.resize(3);
  sample.planes = planes;
  sample.plane_material = {1};
  sample.position = {left, left + Vec<2>(1, 0), left + Vec<2>(0.5, std::sqrt(0.75))};
  const auto engine = make_engine<2>(EngineKind::cd, scene, sample);
  engine->advance(50);  // time 0.5
  double fastest = 0;
  for (const Vec<2>& v : engine->snapshot().velocity) fastest = std::max(fastest, v.norm());
  return fastest;
}

TEST(StaticsCd, HeapOfThreeStandsToHalfAPercent) {
  const double between = 2 - std::sqrt(3.0), floor = between / 3;
  // What stands is at rest to the solver's tolerance; what fails has an acceleration of some thousandths of g.
  EXPECT_LT(heap_speed(1.005 * between, 0.5), 1e-7);
  EXPECT_GT(heap_speed(0.995 * between, 0.5), 1e-4);
  EXPECT_LT(heap_speed(0.6, 1.005 * floor), 1e-7);
  EXPECT_GT(heap_speed(0.6, 0.995 * floor), 1e-4);
}

/// A plane with a mass: a piston above grains.
template <int D>
Sample<D> piston_sample(int grains, double gap, double mass, double force) {
  Sample<D> sample = column_sample<D>(grains);
  Plane<D> piston;
  piston.normal = -up<D>();
  piston.point = sample.position[grains - 1] + (0.5 + gap) * up<D>();
  piston.inverse_mass = 1 / mass;
  piston.force = force;
  sample.planes.push_back(piston);
  return sample;
}

template <int D>
void check_piston() {
  constexpr double force = 3;
  Scene scene = free_scene(D, 0.3, 0, 1e4);
  scene.loading.gravity.assign(D, 0.0);
  scene.loading.gravity[D - 1] = -1;
  scene.cd.dt = 1e-2;
  scene.cd.tolerance = 1e-10;
  for (double mass : {0.1, 10.0}) {  // a factor 100 in inertia changes nothing
    const auto engine = make_engine<D>(EngineKind::cd, scene, piston_sample<D>(4, 0, mass, force));
    engine->advance(100);
    const Snapshot<D> state = engine->snapshot();
    ASSERT_EQ(state.contacts->size(), 5u);
    for (std::size_t c = 0; c < 5; ++c) {
      // Above contact c: the grains that lie higher than its lower grain, and the piston's force.
      const int i = state.contacts->i[c], j = state.contacts->j[c];
      const double carried = j == 5 ? 0 : j == 4 ? 4 : 3 - i;  // plane 1: the piston; plane 0: the floor
      EXPECT_NEAR(std::abs(state.contacts->force[c].dot(up<D>())), force + carried, 1e-7);
    }
    EXPECT_LT(state.planes[1].velocity.norm(), 1e-10);
  }
}

TEST(StaticsCd, PistonPressesAColumn) {
  check_piston<2>();
  check_piston<3>();
}

TEST(StaticsCd, PistonHitsAGrain) {
  // A piston of mass M at speed V meets a resting grain of mass 1: head-on collision, and free acceleration before.
  constexpr double mass = 3, e = 0.5, speed = 2;
  Scene scene = free_scene(2, 0, e, 1e4);
  scene.cd.dt = 1e-2;
  Sample<2> sample = piston_sample<2>(1, 0.205, mass, 0);
  sample.position[0] += Vec<2>(0, 3);  // far above the floor
  sample.planes[1].point += Vec<2>(0, 3);
  sample.planes[1].velocity = Vec<2>(0, -speed);
  const auto engine = make_engine<2>(EngineKind::cd, scene, sample);
  engine->advance(30);
  const Snapshot<2> state = engine->snapshot();
  const double common = mass * speed / (mass + 1);
  EXPECT_NEAR(-state.velocity[0].y(), common * (1 + e), 1e-12);
  EXPECT_NEAR(-state.planes[1].velocity.y(), common - e * speed / (mass + 1), 1e-12);
}

/// A small, fast grain (10 diameters of the large one per step) and a wall, a large grain in its way, one beside it.
TEST(FastGrainsCd, DoNotTunnelThroughAPlane) {
  Scene scene = free_scene(2, 0, 1, 1e4);
  scene.cd.dt = 0.1;
  Sample<2> sample = ball_on_plane<2>(up<2>(), 3.0, 0.05, 0.01);
  sample.velocity[0] = Vec<2>(0, -100);
  const auto engine = make_engine<2>(EngineKind::cd, scene, sample);
  engine->advance(1);
  EXPECT_GT(engine->solver_summary().divided, 0);
  EXPECT_NEAR(engine->snapshot().velocity[0].y(), 100, 1e-11);
  // Free flight of 10, of which 3 are downwards; the rebound is found within one part of the step, 0.025 at most.
  EXPECT_NEAR(engine->snapshot().position[0].y() - sample.position[0].y(), 10 - 2 * 3.0, 2 * 0.025);
}

Sample<2> bullet_sample(double beside) {
  Sample<2> sample = pair_sample<2>(Vec<2>(1, 0), 2.0, {0.05, 0.5}, {0.01, 1});
  sample.position[1].y() += beside;
  sample.velocity[0] = Vec<2>(100, 0);
  sample.cell = cube<2>(1000, false);
  return sample;
}

TEST(FastGrainsCd, DoNotTunnelThroughAGrain) {
  Scene scene = free_scene(2, 0, 1, 1e4);
  scene.cd.dt = 0.1;
  const auto engine = make_engine<2>(EngineKind::cd, scene, bullet_sample(0));
  engine->advance(1);
  // Head-on and elastic: v0' = (m0 - m1)/(m0 + m1) v.
  EXPECT_NEAR(engine->snapshot().velocity[0].x(), -100 * 0.99 / 1.01, 1e-10);
  EXPECT_NEAR(engine->snapshot().velocity[1].x(), 2.0 / 1.01, 1e-10);
}

TEST(FastGrainsCd, PassBesideAnotherUndisturbed) {
  Scene scene = free_scene(2, 0.5, 0.5, 1e4);
  scene.cd.dt = 0.1;
  const auto engine = make_engine<2>(EngineKind::cd, scene, bullet_sample(0.58));
  engine->advance(1);
  EXPECT_EQ(engine->snapshot().velocity[0], Vec<2>(100, 0));
  EXPECT_EQ(engine->snapshot().velocity[1], Vec<2>(0, 0));
}

TEST(FastGrainsCd, AStepWithoutSenseIsRefused) {
  Scene scene = free_scene(2, 0, 1, 1e4);
  scene.cd.dt = 10;
  const auto engine = make_engine<2>(EngineKind::cd, scene, bullet_sample(0));
  EXPECT_THROW(engine->advance(1), RunError);
}

}  // namespace
}  // namespace galet::test::cd_statics_test
