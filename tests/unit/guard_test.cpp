// Guards: each unsound state is refused by name, in a run it ends the run and leaves the last sound state.
#include "src/guard.hpp"

#include <limits>

#include <gtest/gtest.h>

#include "common/core/error.hpp"
#include "src/simulation.hpp"
#include "tests/support/brute_force.hpp"

namespace galet::test::guard_test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Two grains above a floor, at rest, under gravity 2 in a cell of height 4: v_s = sqrt(2 * 2 * 4) = 4.
struct Calm {
  Scene scene;
  Sample<2> sample;
  ContactColumns<2> contacts;
  Derived derived;
  Calm() {
    scene.initial.kind = InitialKind::listed;
    scene.cell.periodic = {false, false};
    scene.material.friction = 0.5;
    scene.material.restitution = 0.5;
    scene.material.normal_stiffness = 1e4;
    scene.loading.gravity = {0, -2};
    scene.run.duration = 1;
    sample.resize(2);
    sample.cell.box = Vec<2>(3, 4).asDiagonal();
    sample.position = {Vec<2>(1, 0.5), Vec<2>(2, 0.5)};
    sample.planes.push_back({Vec<2>::Zero(), Vec<2>::UnitY(), Vec<2>::Zero()});
    derived = derive(scene, grain_facts(scene, sample));
    contacts.i = {0, 1}, contacts.j = {1, 2};
    contacts.gap = {-1e-3, -1e-3};
  }
  std::string complaint(EngineKind engine = EngineKind::md) const {
    const Guard<2> guard(scene, derived, sample, engine);
    Snapshot<2> snapshot = test::snapshot_of(now, contacts);
    snapshot.time = 0.25;
    try {
      guard.check(snapshot);
    } catch (const RunError& error) {
      return error.what();
    }
    return "";
  }
  Sample<2> now;
};

Calm calm() {
  Calm state;
  state.now = state.sample;
  return state;
}

TEST(Guard, SoundStatesPass) {
  EXPECT_EQ(calm().complaint(), "");
  const Calm state = calm();
  EXPECT_DOUBLE_EQ(Guard<2>(state.scene, state.derived, state.sample, EngineKind::cd).own_speed(), 4);
}

TEST(Guard, NotFinite) {
  Calm state = calm();
  state.now.velocity[1].x() = nan;
  EXPECT_EQ(state.complaint(),
            "at time 0.25 the state of grain 1 is not finite: lower md.dt (or raise md.steps_per_contact)");
  state = calm();
  state.now.spin[0] = INFINITY;
  EXPECT_EQ(state.complaint(EngineKind::cd),
            "at time 0.25 the state of grain 0 is not finite: lower cd.dt (or cd.dt_factor)");
  state = calm();
  state.now.position[0].y() = nan;
  EXPECT_NE(state.complaint(), "");
}

TEST(Guard, Overlap) {
  Calm state = calm();
  state.contacts.gap[0] = -0.3;
  EXPECT_EQ(
      state.complaint(),
      "at time 0.25 grain 0 and grain 1 overlap by 0.3, 0.6 of the smaller radius (guard.overlap = 0.5): raise the "
      "material's stiffness or lower the load, or lower md.dt");
  state = calm();
  state.scene.guard.overlap = 0.1;
  state.contacts.gap[1] = -0.06;
  EXPECT_EQ(state.complaint(EngineKind::cd),
            "at time 0.25 grain 1 and plane 0 overlap by 0.06, 0.12 of the smaller radius (guard.overlap = 0.1): lower "
            "cd.tolerance or cd.dt");
}

TEST(Guard, Outside) {
  Calm state = calm();
  state.now.position[1].y() = -0.01;
  EXPECT_EQ(state.complaint(), "at time 0.25 grain 1 is behind plane 0: lower md.dt (or raise md.steps_per_contact)");
}

TEST(Guard, Speed) {
  Calm state = calm();
  state.now.velocity[1] = Vec<2>(0, 4001);
  EXPECT_EQ(
      state.complaint(EngineKind::cd),
      "at time 0.25 grain 1 moves at 4e+03, 1e+03 times the scene's own speed 4 (guard.speed = 1000): lower cd.dt "
      "(or cd.dt_factor)");
  state.now.velocity[1] = Vec<2>(0, 100);
  EXPECT_EQ(state.complaint(EngineKind::cd), "");
}

TEST(Guard, Energy) {
  Calm state = calm();
  state.now.velocity[0] = state.now.velocity[1] = Vec<2>(401, 0);  // 1e4 times the energy of v_s = 4
  EXPECT_EQ(state.complaint(EngineKind::cd),
            "at time 0.25 the kinetic energy per grain is 8.04e+04, 1.01e+04 times that of the scene's own speed 4 "
            "(guard.energy = 10000): lower cd.dt (or cd.dt_factor)");
}

// Soft grains may move at the speed of sound, also where nothing else gives a speed; rigid ones without any scale have
// no bound.
TEST(Guard, SceneWithoutASpeedOfItsOwn) {
  Calm state = calm();
  state.scene.loading.gravity.clear();
  state.now.velocity[0] = Vec<2>(5, 0);
  EXPECT_EQ(state.complaint(EngineKind::md), "");
  EXPECT_EQ(Guard<2>(state.scene, state.derived, state.sample, EngineKind::cd).own_speed(), 0);
  state.now.velocity[0] = Vec<2>(1e9, 0);
  EXPECT_EQ(state.complaint(EngineKind::cd), "");
  EXPECT_NE(state.complaint(EngineKind::md), "");
}

Scene gas_scene() {
  Scene scene;
  scene.grains.count = 60;
  scene.material.friction = 0.4;
  scene.material.restitution = 0.5;
  scene.material.stiffness_level = 1e3;
  scene.initial.kind = InitialKind::gas;
  scene.initial.speed = 1;
  scene.loading.pressure = 1;
  scene.loading.kind = LoadingKind::isotropic;
  scene.cd.dt_factor = 0.02;
  scene.run.duration = 4;
  return scene;
}

// Each bound, set below what the run does, ends it in both engines; what is left is a state that passes.
TEST(Guard, EndsRunsAndKeepsTheLastSoundState) {
  for (const EngineKind kind : {EngineKind::md, EngineKind::cd}) {
    Scene scene = gas_scene();
    scene.guard.every = 7;
    EXPECT_EQ(Simulation<2>(scene, kind).run().ending, Ending::finished);
    scene.initial.speed = 0;
    scene.guard.speed = 0.05;  // of sqrt(P d^2 / m): collisions of a gas that is compressed from rest are faster
    RunResult result = Simulation<2>(scene, kind).run();
    ASSERT_EQ(result.ending, Ending::failed);
    EXPECT_NE(result.failure.find("guard.speed = 0.05"), std::string::npos) << result.failure;
    ASSERT_TRUE(result.last_good);
    EXPECT_LT(Simulation<2>::resume(scene, *result.last_good).engine().steps(), result.steps);
    scene.guard = {};
    scene.guard.energy = 1e-6;
    result = Simulation<2>(scene, kind).run();
    EXPECT_NE(result.failure.find("guard.energy = 1e-06"), std::string::npos) << result.failure;
  }
  Scene scene = gas_scene();
  scene.material.stiffness_level = 100;
  scene.guard.overlap = 1e-3;
  scene.guard.every = 5;
  const RunResult result = Simulation<2>(scene, EngineKind::md).run();
  EXPECT_NE(result.failure.find("guard.overlap = 0.001"), std::string::npos) << result.failure;
}

// A time step twelve times above the bound of stability: collisions blow up, and the run says so within a few steps.
TEST(Guard, BlowUp) {
  Scene scene = gas_scene();
  scene.md.dt = 0.3;
  scene.md.allow_unsafe_dt = true;
  scene.run.duration = 3000;
  scene.guard.every = 1;
  const RunResult result = Simulation<2>(scene, EngineKind::md).run();
  ASSERT_EQ(result.ending, Ending::failed);
  ASSERT_TRUE(result.last_good);
  EXPECT_NO_THROW(Guard<2>(scene, Simulation<2>(scene, EngineKind::md).derived(),
                           Simulation<2>(scene, EngineKind::md).present_sample(), EngineKind::md)
                      .check(Simulation<2>::resume(scene, *result.last_good).engine().snapshot()));
}

}  // namespace
}  // namespace galet::test::guard_test
