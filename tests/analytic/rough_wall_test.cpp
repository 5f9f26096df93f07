// Rough walls in cd: rigid bodies of glued grains that translate, imposed or moved by forces.
#include <gtest/gtest.h>

#include "tests/support/scenes.hpp"

namespace galet::test::rough_wall_test {
namespace {

/// A floor of three touching disks, and one disk in each of its two hollows.
Sample<2> floor_sample() {
  Sample<2> sample;
  sample.cell = cube<2>(40, false);
  sample.resize(5);
  for (int k = 0; k < 3; ++k) sample.position[k] = Vec<2>(10 + k, 10);
  for (int k = 0; k < 2; ++k) sample.position[3 + k] = Vec<2>(10.5 + k, 10 + std::sqrt(0.75));
  sample.body = {0, 0, 0, -1, -1};
  return sample;
}

Scene wall_scene(const BodySpec& wall) {
  Scene scene = free_scene(2, 0.5, 0, 1e4);
  scene.bodies = {wall};
  scene.cd.dt = 1e-2;
  scene.cd.tolerance = 1e-11;
  scene.cd.max_sweeps = 20000;
  return scene;
}

double upwards(const Snapshot<2>& state) {
  double sum = 0;
  for (std::size_t c = 0; c < state.contacts->size(); ++c)
    if (state.contacts->i[c] < 3 && state.contacts->j[c] >= 3) sum += state.contacts->force[c].y();
  return sum;
}

TEST(RoughWallCd, CarriesTheWeightAtRest) {
  Scene scene = wall_scene({.name = "floor"});
  scene.loading.gravity = {0, -1};
  const Sample<2> sample = floor_sample();
  const auto engine = make_engine<2>(EngineKind::cd, scene, sample);
  engine->advance(200);
  EXPECT_NEAR(upwards(engine->snapshot()), 2, 1e-8);
  for (int k = 0; k < 3; ++k)
    EXPECT_LT((engine->snapshot().position[k] - sample.position[k]).norm(), 1e-14) << "walls stay where they are";
  // Grains of one wall touch, but nothing acts between them.
  for (std::size_t c = 0; c < engine->snapshot().contacts->size(); ++c) EXPECT_GE(engine->snapshot().contacts->j[c], 3);
}

TEST(RoughWallCd, MovesAsImposed) {
  // Lifted at a steady speed from rest: the grains on it are hit (e = 0), and then carried along.
  Scene scene = wall_scene({.name = "floor", .velocity = {0, 0.3}});
  scene.loading.gravity = {0, -1};
  const Sample<2> sample = floor_sample();
  const auto engine = make_engine<2>(EngineKind::cd, scene, sample);
  engine->advance(100);
  for (int k = 0; k < 5; ++k) EXPECT_NEAR((engine->snapshot().velocity[k] - Vec<2>(0, 0.3)).norm(), 0, 1e-9) << k;
  EXPECT_NEAR(engine->snapshot().position[1].y(), 10.3, 1e-12);
  EXPECT_NEAR(upwards(engine->snapshot()), 2, 1e-8);
}

TEST(RoughWallCd, MovesUnderAForceTogetherWithItsGrains) {
  // Wall of mass M pushed up by F with two grains (mass 1, in its hollows) on it, no gravity: a = F / (M + 2).
  for (double mass : {0.3, 30.0}) {
    constexpr double force = 4;
    const Scene scene = wall_scene({.name = "lift", .free = {false, true}, .force = {0, force}, .mass = mass});
    const auto engine = make_engine<2>(EngineKind::cd, scene, floor_sample());
    engine->advance(50);  // time 0.5
    for (int k = 0; k < 5; ++k)
      EXPECT_NEAR(engine->snapshot().velocity[k].y(), 0.5 * force / (mass + 2), 1e-9) << k << ", M = " << mass;
    EXPECT_NEAR(upwards(engine->snapshot()), 2 * force / (mass + 2), 1e-7);
    EXPECT_EQ(engine->snapshot().velocity[0].x(), 0) << "not free";
  }
}

TEST(RoughWallCd, TakesTheMomentumOfAnImpact) {
  // A free wall of two disks (mass 2, its grains') and a disk that comes down between them: symmetric, so that
  // horizontal impulses cancel; e = 0 and no friction, so that both move on together.
  Scene scene = free_scene(2, 0, 0, 1e4);
  scene.bodies = {{.name = "target", .free = {true, true}}};
  scene.cd.dt = 1e-3;
  scene.cd.tolerance = 1e-12;
  Sample<2> sample;
  sample.cell = cube<2>(40, false);
  sample.resize(3);
  sample.position = {Vec<2>(10, 10), Vec<2>(11, 10), Vec<2>(10.5, 11)};
  sample.velocity[2] = Vec<2>(0, -1);
  sample.body = {0, 0, -1};
  const auto engine = make_engine<2>(EngineKind::cd, scene, sample);
  engine->advance(300);
  for (int k = 0; k < 3; ++k) EXPECT_LT((engine->snapshot().velocity[k] - Vec<2>(0, -1.0 / 3)).norm(), 1e-9) << k;
}

TEST(RoughWallCd, RestartsWithTheSameBits) {
  Scene scene = wall_scene({.name = "lift", .free = {true, true}, .force = {0.5, 4}, .mass = 2.0});
  scene.loading.gravity = {0, -1};
  const auto run = [&] { return make_engine<2>(EngineKind::cd, scene, floor_sample()); };
  const auto whole = run(), first = run(), second = run();
  whole->advance(60);
  first->advance(25);
  Archive archive;
  first->save(archive);
  second->restore(archive);
  second->advance(35);
  Archive a, b;
  whole->save(a);
  second->save(b);
  EXPECT_EQ(state_hash(a), state_hash(b));
}

}  // namespace
}  // namespace galet::test::rough_wall_test
