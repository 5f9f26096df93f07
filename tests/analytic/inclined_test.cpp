// Inclined gravity in a cell that is periodic along the slope, and bodies that move along a line: accelerations against
// their closed forms, both engines.
#include <gtest/gtest.h>

#include "common/scene/loading.hpp"
#include "common/scene/stages.hpp"
#include "tests/support/scenes.hpp"
#include "tests/unit/scene_mistakes.hpp"

namespace galet::test::inclined_test {
namespace {

constexpr double slope = 20;
const double sine = std::sin(slope * pi / 180), cosine = std::cos(slope * pi / 180);

/// A ball that touches the floor of a cell that is periodic along it.
template <int D>
Sample<D> ball_on_floor() {
  Sample<D> sample;
  sample.cell = cube<D>(5, true);
  sample.cell.periodic[D - 1] = false;
  sample.resize(1);
  sample.planes = {{Vec<D>::Zero(), up<D>(), Vec<D>::Zero()}};
  sample.position[0] = Vec<D>::Constant(2.5);
  sample.position[0][D - 1] = 0.5;
  return sample;
}

template <int D>
Scene slope_scene(double friction) {
  Scene scene = periodic_scene(D, friction, 0.05, 1e6);
  scene.cell.periodic[D - 1] = false;
  scene.loading.gravity.assign(D, 0);
  scene.loading.gravity.back() = -1;
  scene.loading.inclination = slope;
  scene.cd.dt = 1e-3;
  scene.cd.tolerance = 1e-12;
  scene.md.energy_budget = true;
  return scene;
}

/// Rolling: a = g sin / (1 + k); sliding (mu < tan k / (1 + k)): a = g (sin - mu cos), R dw/dt = mu g cos / k.
template <int D>
void check_slope(EngineKind kind, double friction) {
  const double k = inertia_ratio<D>;
  const bool rolls = sine / cosine <= friction * (1 + 1 / k);
  const auto engine = make_engine<D>(kind, slope_scene<D>(friction), ball_on_floor<D>());
  constexpr double time = 5;  // some times around the cell
  engine->advance(std::lround(time / engine->dt()));
  const double expected = time * (rolls ? sine / (1 + k) : sine - friction * cosine);
  // md: the contact swings for 1.5e-3 before the force is m g cos, and rolling begins with tangential springs unloaded.
  const double tolerance = kind == EngineKind::md ? 1e-3 : 1e-9;
  EXPECT_NEAR(engine->snapshot().velocity[0].x(), expected, tolerance) << to_string(kind) << " D = " << D;
  EXPECT_NEAR(spin_norm(engine->snapshot().spin[0]) / 2, rolls ? expected : friction * cosine / k * time,
              2 * tolerance);
  if (kind == EngineKind::cd) return;
  // No height along the periodic direction: what gravity gives there is work.
  const EnergyFlows flows = engine->energy_flows();
  EXPECT_NEAR(flows.work, sine * 0.5 * expected * time, 2e-3 * flows.work);
  EXPECT_NEAR(engine->energy().total() - 0.5 * cosine, flows.work - flows.viscous - flows.sliding - flows.unloading,
              1e-4 * flows.work);
}

TEST(InclinedPlane, BallRollsAndSlides) {
  for (const EngineKind kind : both_engines)
    for (const double friction : {0.05, 0.6}) check_slope<2>(kind, friction), check_slope<3>(kind, friction);
}

TEST(InclinedPlane, GravityIsTurnedTowardsX) {
  LoadingSpec loading;
  loading.inclination = slope;
  EXPECT_TRUE(gravity_of(loading).empty());
  loading.gravity = {0, 0, -2};
  const std::vector<double> turned = gravity_of(loading);
  EXPECT_NEAR(turned[0], 2 * sine, 1e-15);
  EXPECT_EQ(turned[1], 0);
  EXPECT_NEAR(turned[2], -2 * cosine, 1e-15);
}

TEST(InclinedPlane, WhatCanNotBeMeantIsRefused) {
  using Mistakes = std::vector<std::string>;
  const std::string scene = R"(material = {restitution = 0.5, normal_stiffness = 1e4, friction = 0.4}
run.duration = 1
grains.count = 4
cell = {size = [9, 9], periodic = [true, false]}
)";
  const std::string floor = "plane = [{point = [0, 0], normal = [0, 1]}]\n";
  EXPECT_EQ(mistakes_of(scene + "loading = {gravity = [0, -1], inclination = 20}\n" + floor), Mistakes{});
  EXPECT_EQ(mistakes_of(scene + "loading = {inclination = 20}\n" + floor),
            (Mistakes{"5:26: loading.inclination needs loading.gravity: what it turns"}));
  EXPECT_EQ(
      mistakes_of(scene + "loading = {gravity = [0, -1], inclination = 20}\n"),
      (Mistakes{"5:45: loading.inclination needs a floor, a [[plane]] or a [[body]] that is not free: grains would "
                "fall forever"}));
  EXPECT_EQ(mistakes_of(scene + "loading = {gravity = [0.3, -1]}\n" + floor),
            (Mistakes{"5:22: loading.gravity: x is a periodic direction, in which grains would fall forever; set "
                      "cell.periodic to false there, or turn gravity by loading.inclination"}));
}

/// A stage may have a slope of its own.
TEST(InclinedPlane, StagesInheritAndChangeTheSlope) {
  Scene scene;
  scene.loading.gravity = {0, -1};
  scene.loading.inclination = 10;
  scene.stages.resize(2);
  scene.stages[1].loading.inclination = 15;
  const std::vector<Scene> stages = stage_scenes(scene);
  EXPECT_EQ(stages[0].loading.inclination, 10);
  EXPECT_EQ(stages[1].loading.inclination, 15);
}

/// A body on a line under gravity and a force: a = e (e.g + e.F / M), and no motion across.
TEST(GuidedBody, FallsAlongItsLine) {
  const Vec<2> line(0.6, 0.8);
  for (const EngineKind kind : both_engines) {
    Scene scene = free_scene(2, 0.5, 0.1, 1e3);
    scene.bodies = {{.name = "slider", .force = {1, 0}, .mass = 2.0, .guide = {3, 4}}};
    scene.loading.gravity = {0, -1};
    set_dt(scene, 1e-3);
    Sample<2> sample;
    sample.cell = cube<2>(40, false);
    sample.resize(2);
    sample.position = {Vec<2>(20, 20), Vec<2>(20.7, 20)};
    sample.body = {0, 0};
    const auto engine = make_engine<2>(kind, scene, sample);
    engine->advance(1000);
    const double expected = line.dot(Vec<2>(0.5, -1));
    for (int k = 0; k < 2; ++k)
      EXPECT_LT((engine->snapshot().velocity[k] - expected * line).norm(), 1e-12) << to_string(kind);
  }
}

/// A ball hits a guided body of mass M along the normal n, e = 0: both move on along n with
/// v / (1 + m c^2 / M ), c = e.n the cosine between line and normal.
TEST(GuidedBody, TakesTheImpulseAlongItsLine) {
  const Vec<2> line(0.6, 0.8);
  Scene scene = free_scene(2, 0, 0, 1e4);
  scene.bodies = {{.name = "slider", .mass = 2.0, .guide = {0.6, 0.8}}};
  scene.cd.dt = 1e-3;
  scene.cd.tolerance = 1e-12;
  Sample<2> sample;
  sample.cell = cube<2>(40, false);
  sample.resize(2);
  sample.position = {Vec<2>(20, 20), Vec<2>(20, 21.05)};
  sample.velocity[1] = Vec<2>(0, -1);
  sample.body = {0, -1};
  const auto engine = make_engine<2>(EngineKind::cd, scene, sample);
  engine->advance(53);  // just after the impact
  const Snapshot<2> state = engine->snapshot();
  // Impulse p along -y: ball v = -1 + p / m; body V = -p c / M along the line, its y part -p c^2 / M.
  const double c = line.y(), p = 1 / (1 + c * c / 2);
  EXPECT_NEAR(state.velocity[1].y(), -1 + p, 2e-3);
  EXPECT_LT((state.velocity[0] + p * c / 2 * line).norm(), 2e-3) << "its grain slides off sideways at 1e-2 per step";
}

}  // namespace
}  // namespace galet::test::inclined_test
