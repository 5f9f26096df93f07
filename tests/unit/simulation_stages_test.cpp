// Stages at work: what a change of the loading keeps, conditions that end a stage, paths, starts from checkpoints.
#include <filesystem>

#include <gtest/gtest.h>

#include "common/core/error.hpp"
#include "common/io/checkpoint.hpp"
#include "common/scene/stages.hpp"
#include "src/simulation.hpp"
#include "tests/support/scenes.hpp"
#include "tests/support/stages.hpp"
#include "tests/support/temporary_folder.hpp"

namespace galet::test::simulation_stages_test {
namespace {

class StagesOfBothEngines : public testing::TestWithParam<EngineKind> {};
INSTANTIATE_TEST_SUITE_P(Stages, StagesOfBothEngines, testing::Values(EngineKind::md, EngineKind::cd),
                         [](const auto& engine) { return to_string(engine.param); });

/// Contacts keep forces and springs when the loading changes; held components keep their rate.
TEST_P(StagesOfBothEngines, ChangeOfLoadingKeepsTheState) {
  Scene scene = periodic_scene(2, 0.4, 0.3, 1e3);
  scene.loading.kind = LoadingKind::drives;
  scene.loading.pressure = 1;
  scene.loading.drives = {{.component = "isotropic", .stress = 1}, {.component = "xy", .rate = 0.1}};
  scene.cd.dt = 0.01;
  const Sample<2> sample = gas_sample<2>(6, 0.5, 0.1, 5, 0.1);
  const auto engine = make_engine<2>(GetParam(), scene, sample);
  engine->advance(std::lround(8 / engine->dt()));
  const Snapshot<2> before = engine->snapshot();
  const ContactColumns<2> contacts = *before.contacts;
  const std::vector<Vec<2>> position(before.position.begin(), before.position.end());
  const double rate = before.cell->rate(1, 1);
  ASSERT_GT(contacts.size(), 20u);
  ASSERT_NE(rate, 0);

  scene.material.friction = 0.1;
  scene.loading.drives = {{.component = "xx", .rate = -0.2}, {.component = "yy", .stress = 1}};
  engine->change(scene, derive_for<2>(scene, sample));
  const Snapshot<2> after = engine->snapshot();
  EXPECT_EQ(after.cell->rate(0, 0), -0.2);
  EXPECT_EQ(after.cell->rate(1, 1), rate);
  EXPECT_EQ(after.cell->rate(0, 1), 0);
  EXPECT_EQ(after.contacts->force, contacts.force);
  EXPECT_EQ(after.contacts->i, contacts.i);
  for (std::size_t i = 0; i < position.size(); ++i) EXPECT_EQ(after.position[i], position[i]);
  EXPECT_NO_THROW(engine->advance(10));
}

/// A gas of frictionless disks loses energy while e = 0.5, and none in a stage where e = 1.
TEST_P(StagesOfBothEngines, RestitutionIsThatOfTheStage) {
  Scene scene = periodic_scene(2, 0, 0.5, 1e4);
  set_dt(scene, GetParam() == EngineKind::md ? 2e-4 : 2e-3);
  StageSpec stage;
  stage.duration = 4;
  scene.stages = {stage, stage};
  scene.stages[1].restitution = 1;
  const std::vector<Scene> stages = stage_scenes(scene);
  const Sample<2> sample = gas_sample<2>(8, 0.5, 0.1, 5, 1.0);
  const auto engine = make_engine<2>(GetParam(), stages[0], sample);
  const double start = engine->energy().total();
  engine->advance(std::lround(4 / engine->dt()));
  const double middle = engine->energy().total();
  EXPECT_LT(middle, 0.5 * start);
  engine->change(stages[1], derive_for<2>(stages[1], sample));
  engine->advance(std::lround(4 / engine->dt()));
  // md: the integrator's error at about 100 steps per contact. cd: rigid grains that touch two others in one step.
  EXPECT_NEAR(engine->energy().total() / middle, 1, GetParam() == EngineKind::md ? 1e-3 : 0.02);
}

TEST_P(StagesOfBothEngines, EndWhereTheyAreToldTo) {
  const Scene scene = staged_scene();
  Simulation<2> simulation(scene, GetParam());
  EXPECT_TRUE(simulation.engine().layout().friction);  // of the stages to come
  const RunResult result = simulation.run();
  ASSERT_EQ(result.ending, Ending::finished) << result.failure;
  ASSERT_EQ(result.stages.size(), 6u);
  EXPECT_EQ(result.stage, "unloading");
  const auto& stages = result.stages;
  // Strain of the third stage: 0.04, overshot by less than a sample (at most 0.1 tau_i at a rate of 0.02).
  const double squeezed = stages[2].last[Observable::eps_yy] - stages[1].last[Observable::eps_yy];
  EXPECT_GE(squeezed, 0.04);
  EXPECT_LT(squeezed, 0.04 + 0.002);
  // The shear strain is that of the second stage, 3 * 0.05, up to one step's.
  EXPECT_NEAR(result.last[Observable::strain], 0.15, 0.05 * result.dt * 1.001);
  // Cycles return to where they began, up to the step in which the path turns.
  EXPECT_NEAR(stages[4].last[Observable::eps_yy], stages[3].last[Observable::eps_yy], 2 * 0.02 * result.dt * 1.001);
  EXPECT_EQ(stages[4].last[Observable::eps_xx], stages[3].last[Observable::eps_xx]);  // no lateral strain
  double steps = 0;
  for (const StageReport& stage : stages) steps += static_cast<double>(stage.steps);
  EXPECT_EQ(steps, static_cast<double>(result.steps));
  // Averages are of the last stage only: its second half.
  EXPECT_NEAR(result.averages.from, result.time - 1.5, 2 * result.dt);
}

/// A sheared stage ends when sigma_yy, its mean over about an inertial time, passes the value from below.
TEST_P(StagesOfBothEngines, EndAtAStress) {
  Scene scene = staged_scene();
  scene.stages.resize(2);
  StageSpec& load = scene.stages[1];
  load = {};
  load.duration = 50;
  load.loading.kind = LoadingKind::oedometric;
  load.loading.compression_rate = 0.01;
  load.until = "yy";
  load.until_stress = 4;
  const RunResult result = Simulation<2>(scene, GetParam()).run();
  ASSERT_EQ(result.ending, Ending::reached) << result.failure;
  // A frame of rigid grains jams: stresses rise within a part of the averaging time; soft ones rise by kappa * 0.01 =
  // 10 P per unit of time, so that the value may be passed by as much.
  EXPECT_GT(result.last[Observable::sigma_yy], 4);
  EXPECT_LT(result.strain, 1);
}

/// Oedometric compression of a triangular crystal of frictionless disks: lambda = mu = sqrt(3)/4 K, so that
/// sigma_yy = (lambda + 2 mu) eps, sigma_xx = lambda eps (bonds along x stay open at zero force).
TEST(Stages, OedometricCrystalHasItsModuli) {
  Scene scene = periodic_scene(2, 0, 0.3, 1e4);
  scene.loading.kind = LoadingKind::oedometric;
  scene.loading.compression_rate = 1e-4;
  scene.run.duration.reset();
  scene.run.strain = 1e-3;
  const Sample<2> sample = crystal_sample<2>(3, 1.0);
  scene.grains.count = sample.count();
  const RunResult result = Simulation<2>(scene, EngineKind::md, sample).run();
  ASSERT_EQ(result.ending, Ending::finished) << result.failure;
  const double modulus = std::sqrt(3.0) / 4 * 1e4 * 1e-3;
  // Corrections of second order in the strain (bonds turn): a few 1e-3.
  EXPECT_NEAR(result.last[Observable::sigma_yy], 3 * modulus, 5e-3 * 3 * modulus);
  EXPECT_NEAR(result.last[Observable::sigma_xx], modulus, 5e-3 * modulus);
  // The same path there and back, through the same states: nothing is left.
  scene.run.strain = 2e-3;
  scene.run.cycles = 1;
  const RunResult back = Simulation<2>(scene, EngineKind::md, sample).run();
  EXPECT_LT(std::abs(back.last[Observable::sigma_yy]), 1e-2 * modulus);
}

/// A pressure that rises linearly is followed: the crystal's own period is of the order of 0.1, its damping quick.
TEST(Stages, RampsAreFollowed) {
  Scene scene = periodic_scene(2, 0, 0.3, 1e3);
  scene.loading.kind = LoadingKind::isotropic;
  scene.loading.pressure = 1;
  scene.loading.pressure_to = 3;
  scene.run.duration = 100;
  scene.run.samples = 50;
  const Sample<2> sample = crystal_sample<2>(3, 1.0);
  scene.grains.count = sample.count();
  const RunResult result = Simulation<2>(scene, EngineKind::md, sample).run();
  ASSERT_EQ(result.ending, Ending::finished) << result.failure;
  for (const Measurement& row : result.series.rows) {
    if (row[Observable::time] < 20) continue;  // the start from no stress rings
    // A row is a mean over its interval of 2 time units: the target at its middle. 1 %: what is left of the ringing.
    const double middle = row[Observable::time] - 1;
    EXPECT_NEAR(row[Observable::pressure], 1 + 0.02 * middle, 0.01) << "at " << middle;
  }
}

TEST(Stages, PathsCanNotBeLengthened) {
  Scene scene = staged_scene();
  scene.stages.clear();
  scene.loading.kind = LoadingKind::isotropic;
  scene.loading.pressure_to = 2;
  scene.run.duration = 1;
  Simulation<2> simulation(scene, EngineKind::md);
  RunControl control;
  control.most_steps = 10;
  simulation.run(control);
  scene.run.duration = 2;
  EXPECT_THROW(Simulation<2>::resume(scene, simulation.checkpoint()), InputError);
}

// ---- starts from checkpoints -------------------------------------------------------------------------------

/// Two stages in one run, and the second one as a scene of its own that starts from the checkpoint of the first.
TEST_P(StagesOfBothEngines, CheckpointGoesOnLikeTheNextStage) {
  const TemporaryFolder folder;
  Scene scene = staged_scene();
  scene.grains.diameter = {};  // equal grains: their mean diameter is the same to the last bit
  scene.stages.resize(2);
  scene.stages[0].friction.reset();
  scene.material.stiffness_level.reset();
  scene.material.normal_stiffness = 1e3;
  set_dt(scene, GetParam() == EngineKind::md ? 1e-3 : 0.02);
  RunControl control;
  const std::string file = folder.file("first.h5");
  control.stage_end = [&file](int number, const std::string&, const Archive& archive) {
    if (number == 1) write_checkpoint(file, archive);
  };
  Simulation<2> whole(scene, GetParam());
  const RunResult both = whole.run(control);
  ASSERT_EQ(both.ending, Ending::finished) << both.failure;

  Scene second = scene;
  second.stages.clear();
  second.grains.count = 0;
  second.initial = {};
  second.initial.kind = InitialKind::checkpoint;
  second.initial.file = file;
  second.loading = scene.stages[1].loading;
  second.loading.pressure = 1;
  second.run.duration = scene.stages[1].duration;
  Simulation<2> part(second, GetParam());
  EXPECT_EQ(part.engine().time(), 0);
  const RunResult result = part.run();
  ASSERT_EQ(result.ending, Ending::finished) << result.failure;
  EXPECT_EQ(result.steps, both.stages[1].steps);
  const Snapshot<2> one = whole.engine().snapshot(), other = part.engine().snapshot();
  for (int i = 0; i < one.grains(); ++i) ASSERT_EQ(one.position[i], other.position[i]) << "grain " << i;
  EXPECT_EQ(one.contacts->force, other.contacts->force);
  EXPECT_EQ(result.last[Observable::strain], both.last[Observable::strain]);
  EXPECT_EQ(result.last[Observable::eps_xx], 0);  // strains count from the start of the run

  // A restart of that run needs the first one's file no more.
  RunControl half;
  half.most_steps = result.steps / 2;
  Simulation<2> stopped(second, GetParam());
  stopped.run(half);
  const Archive archive = stopped.checkpoint();
  std::filesystem::remove(file);
  EXPECT_EQ(Simulation<2>::resume(second, archive).run().state_hash, result.state_hash);
}

std::string refusal(const Scene& scene, EngineKind kind) {
  try {
    Simulation<2>(scene, kind).run();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Stages, CheckpointContactsThatDoNotFitAreRefused) {
  const TemporaryFolder folder;
  Scene scene = staged_scene();
  scene.stages.clear();
  scene.loading.kind = LoadingKind::isotropic;
  scene.run.duration = 15;
  Simulation<2> first(scene, EngineKind::md);
  ASSERT_EQ(first.run().ending, Ending::finished);
  scene.initial = {};
  scene.initial.kind = InitialKind::checkpoint;
  scene.initial.file = folder.file("first.h5");
  scene.grains.count = 0;
  scene.run.duration = 1;
  write_checkpoint(scene.initial.file, first.checkpoint());
  EXPECT_EQ(refusal(scene, EngineKind::md), "");

  const std::string fresh = "; set initial.contacts = \"fresh\" to take over only its grains and cell";
  EXPECT_EQ(
      refusal(scene, EngineKind::cd),
      "error: initial.file: the checkpoint's contacts can't be kept: they are of engine md, the run is of engine cd" +
          fresh);
  Scene smooth = scene;
  smooth.material.friction = 0;
  EXPECT_EQ(
      refusal(smooth, EngineKind::md),
      "error: initial.file: the checkpoint's contacts can't be kept: they are of materials with other friction or "
      "rolling resistance (another layout)" +
          fresh);
  Scene sticky = scene;
  sticky.material.cohesion_force = 0.1;
  sticky.material.cohesion_range = 0.01;
  EXPECT_EQ(
      refusal(sticky, EngineKind::md),
      "error: initial.file: the checkpoint's contacts can't be kept: the scene has another cohesion range" + fresh);
  for (Scene* unlike : {&scene, &smooth, &sticky}) {
    unlike->initial.fresh_contacts = true;
    EXPECT_EQ(refusal(*unlike, EngineKind::cd), "");
    EXPECT_EQ(refusal(*unlike, EngineKind::md), "");
  }
}

}  // namespace
}  // namespace galet::test::simulation_stages_test
