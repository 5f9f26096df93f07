// The facade: when it measures, that measuring and stopping change nothing, the compression of a gas, equilibrium.
#include "src/simulation.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "common/core/error.hpp"
#include "src/engines.hpp"
#include "src/restart.hpp"

namespace galet::test::simulation_test {
namespace {

/// A small sheared gas: dense enough for contacts within the run.
Scene shear_scene(int grains = 60) {
  Scene scene;
  scene.grains.count = grains;
  scene.grains.diameter = {SizeKind::uniform, 1, 0.2, {}, {}};
  scene.material.friction = 0.4;
  scene.material.restitution = 0.1;
  scene.material.stiffness_level = 1e3;
  scene.initial.kind = InitialKind::gas;
  scene.initial.solid_fraction = 0.5;
  scene.loading.kind = LoadingKind::plane_shear;
  scene.loading.pressure = 1;
  scene.loading.inertial_number = 0.2;
  scene.cd.dt_factor = 0.02;
  scene.cd.tolerance = 1e-3;
  scene.run.duration = 8;
  scene.run.samples = 20;
  return scene;
}

Scene isotropic_scene() {
  Scene scene = shear_scene();
  scene.loading = LoadingSpec{};
  scene.loading.kind = LoadingKind::isotropic;
  scene.loading.pressure = 1;
  scene.material.restitution = 0.3;
  scene.run.duration = 500;
  scene.run.samples = 400;
  scene.run.equilibrium = 1e-5;
  return scene;
}

Scene compressed_scene() {
  Scene scene = shear_scene();
  scene.initial.kind = InitialKind::compressed_gas;
  scene.initial.friction = 0;
  scene.run.duration = 2;
  return scene;
}

RunControl at_most(long steps) {
  RunControl control;
  control.most_steps = steps;
  return control;
}

void expect_same(const RunResult& a, const RunResult& b) {
  EXPECT_EQ(a.state_hash, b.state_hash);
  EXPECT_EQ(a.steps, b.steps);
  EXPECT_EQ(a.ending, b.ending);
  ASSERT_EQ(a.series.rows.size(), b.series.rows.size());
  for (std::size_t r = 0; r < a.series.rows.size(); ++r)
    for (int k = 0; k < observable_count; ++k) {
      const double one = a.series.rows[r].values[k], other = b.series.rows[r].values[k];
      ASSERT_TRUE(one == other || (std::isnan(one) && std::isnan(other)))
          << observable_table[k].name << " in row " << r << ": " << one << " and " << other;
    }
}

class BothEngines : public testing::TestWithParam<EngineKind> {};
class restart : public BothEngines {};
const auto name_of = [](const auto& info) { return engine_name(info.param); };
INSTANTIATE_TEST_SUITE_P(Simulation, BothEngines, testing::Values(EngineKind::md, EngineKind::cd), name_of);
INSTANTIATE_TEST_SUITE_P(Simulation, restart, testing::Values(EngineKind::md, EngineKind::cd), name_of);

// ---- Schedule ----

TEST(Schedule, GivesTheRowsThatWereAskedFor) {
  const Schedule schedule = make_schedule(12345, 200, 6);
  EXPECT_EQ(schedule.samples_per_row, 10);  // 12345 / (200 * 6) = 10.3
  EXPECT_EQ(schedule.step_of(2000), 12345);
  EXPECT_EQ(schedule.samples_until(12345), 2000);
  for (long sample = 1; sample <= 2000; ++sample) ASSERT_LT(schedule.step_of(sample - 1), schedule.step_of(sample));
}

TEST(Schedule, FewStepsGiveFewRows) {
  const Schedule schedule = make_schedule(7, 200, 1);
  EXPECT_EQ(schedule.samples_per_row, 1);
  EXPECT_EQ(schedule.samples_until(7), 7);
}

TEST(Schedule, CountsTheSamplesUntilAnyStep) {
  const Schedule schedule = make_schedule(1000, 30, 3);
  long sample = 0;
  for (long step = 0; step <= 1000; ++step) {
    if (schedule.step_of(sample + 1) == step) ++sample;
    ASSERT_EQ(schedule.samples_until(step), sample) << "step " << step;
  }
}

TEST(Schedule, DurationIsReachedInWholeSteps) {
  EXPECT_EQ(steps_for(1.0, 0.1), 10);  // 1.0 / 0.1 rounds to 10: no eleventh step
  EXPECT_EQ(steps_for(1.0, 0.3), 4);
}

// ---- Averages ----

TEST(Averages, TakeTheLastPartOfTheRun) {
  TimeSeries series;
  for (int r = 1; r <= 10; ++r) {
    Measurement row;
    row[Observable::time] = r;
    row[Observable::z] = r <= 5 ? 100 : 4;
    row[Observable::peak_overlap] = r;
    series.rows.push_back(row);
  }
  const Averages mean = averages(series, MeasureScale{}, 0.5);
  EXPECT_EQ(mean.rows, 5);
  EXPECT_EQ(mean[Observable::z].value, 4);
  EXPECT_EQ(mean[Observable::peak_overlap].value, 10);  // a largest value, not a mean
}

TEST(Averages, NumbersFollowFromTheMeanStress) {
  MeasureScale scale;
  scale.shear_rate = 0.1;
  scale.law.emplace().stiffness = 1000;
  TimeSeries series;
  for (int r = 1; r <= 4; ++r) {
    Measurement row;
    row[Observable::time] = r;
    row[Observable::sigma_yy] = r % 2 == 0 ? 1 : 3;
    row[Observable::sigma_xy] = -0.5;
    complete(row, scale);
    series.rows.push_back(row);
  }
  const Averages mean = averages(series, scale, 0);
  EXPECT_DOUBLE_EQ(mean[Observable::stiffness_level].value, 500);
  EXPECT_DOUBLE_EQ(mean[Observable::inertial_number].value, 0.1 / std::sqrt(2.0));
  EXPECT_DOUBLE_EQ(mean[Observable::mu_star].value, 0.25);
  const double relative = mean[Observable::sigma_yy].error / 2;
  EXPECT_DOUBLE_EQ(mean[Observable::stiffness_level].error, 500 * relative);
}

TEST(Averages, RatioIsOfTheMeans) {
  // Fluctuations of the denominator bias the mean of ratios; here (1/1 + 1/3) / 2 = 2/3 instead of 1/2.
  EXPECT_DOUBLE_EQ(ratio_of_means({-1, -1}, {1, 3}).value, 0.5);
  // A numerator proportional to the denominator has an exact ratio.
  EXPECT_NEAR(ratio_of_means({2, 6, 4, 8}, {1, 3, 2, 4}).error, 0, 1e-15);
  EXPECT_TRUE(std::isnan(ratio_of_means({1}, {0}).value));
}

TEST(Averages, RowIsTheMeanOfItsSamples) {
  MeasureScale scale;
  RowAverager averager;
  for (int k = 1; k <= 3; ++k) {
    Measurement sample;
    sample[Observable::time] = k;
    sample[Observable::sigma_xy] = -k;
    sample[Observable::sigma_yy] = 2 * k * k;
    sample[Observable::peak_overlap] = k == 2 ? 5 : 1;
    averager.add(sample);
  }
  const Measurement row = averager.finish(scale);
  EXPECT_EQ(row[Observable::time], 3);
  EXPECT_DOUBLE_EQ(row[Observable::sigma_yy], 28.0 / 3);
  EXPECT_DOUBLE_EQ(row[Observable::mu_star], 6.0 / 28);
  EXPECT_EQ(row[Observable::peak_overlap], 5);
  EXPECT_EQ(averager.samples(), 0);
}

// ---- Runs ----

TEST_P(BothEngines, MeasuringChangesNothing) {
  Simulation<2> measured(shear_scene(), GetParam());
  const RunResult result = measured.run();
  ASSERT_EQ(result.ending, Ending::finished) << result.failure;
  EXPECT_EQ(result.series.rows.size(), 20u);

  Simulation<2> plain(shear_scene(), GetParam());
  plain.engine().advance(result.steps);
  Archive state;
  plain.engine().save(state);
  EXPECT_EQ(state_hash(state), result.state_hash);
}

TEST_P(restart, InTheMiddleOfARow) {
  const Scene scene = shear_scene();
  const RunResult whole = Simulation<2>(scene, GetParam()).run();

  Simulation<2> first(scene, GetParam());
  const RunResult part = first.run(at_most(whole.steps / 2 + 3));
  EXPECT_EQ(part.ending, Ending::interrupted);
  Simulation<2> second = Simulation<2>::resume(scene, first.checkpoint());
  EXPECT_EQ(second.engine().steps(), whole.steps / 2 + 3);
  expect_same(second.run(), whole);
}

TEST_P(restart, OfALongerRunKeepsItsRows) {
  Scene scene = shear_scene();
  Simulation<2> first(scene, GetParam());
  const RunResult shorter = first.run();
  scene.run.duration = 2 * *scene.run.duration;
  Simulation<2> second = Simulation<2>::resume(scene, first.checkpoint());
  const RunResult longer = second.run();
  EXPECT_NEAR(static_cast<double>(longer.steps), 2.0 * static_cast<double>(shorter.steps), 1);
  ASSERT_EQ(longer.series.rows.size(), 40u);
  EXPECT_EQ(longer.series.rows[19][Observable::sigma_xy], shorter.series.rows[19][Observable::sigma_xy]);
  scene.run.duration = 1;  // already passed
  EXPECT_THROW(Simulation<2>::resume(scene, first.checkpoint()), InputError);
}

TEST_P(restart, AfterAStop) {
  int asked = 0;
  RunControl control;
  control.stop = [&] { return ++asked == 5; };
  Simulation<2> simulation(shear_scene(), GetParam());
  const RunResult part = simulation.run(control);
  EXPECT_EQ(part.ending, Ending::interrupted);
  EXPECT_LT(part.steps, part.total_steps);
  // The same simulation goes on.
  expect_same(simulation.run(), Simulation<2>(shear_scene(), GetParam()).run());
}

TEST_P(BothEngines, PressureIsHeldInShear) {
  Scene scene = shear_scene(100);
  scene.run.duration = 60;
  const RunResult result = Simulation<2>(scene, GetParam()).run();
  ASSERT_EQ(result.ending, Ending::finished) << result.failure;
  // The cell's inertia answers within a few tau_i: over 30 tau_i the mean stress follows to a few percent.
  EXPECT_NEAR(result.averages[Observable::sigma_yy].value, 1, 0.1);
  EXPECT_NEAR(result.averages[Observable::inertial_number].value, 0.2, 0.02);
  EXPECT_LT(result.averages[Observable::sigma_xy].value, 0);  // L_xy > 0
  EXPECT_NEAR(result.strain, 60 * 0.2, 0.2);
}

TEST_P(BothEngines, EndsAtEquilibrium) {
  const Scene scene = isotropic_scene();
  const RunResult result = Simulation<2>(scene, GetParam()).run();
  ASSERT_EQ(result.ending, Ending::equilibrium) << result.failure << result.last[Observable::kinetic_per_grain];
  EXPECT_LT(result.steps, result.total_steps);
  EXPECT_NEAR(result.last[Observable::pressure], 1, equilibrium_stress_tolerance);
  EXPECT_LT(result.last[Observable::rattler_fraction], 0.5);
  // A packing with friction has between D + 1 and 2 D contacts per grain of its backbone, less what a small number of
  // grains leaves to chance.
  EXPECT_GT(result.last[Observable::z_star], 2.8);
  EXPECT_LT(result.last[Observable::z_star], 4.5);
}

TEST_P(BothEngines, CompressesTheGasFirst) {
  Simulation<2> simulation(compressed_scene(), GetParam());
  EXPECT_TRUE(simulation.compressing());
  EXPECT_FALSE(simulation.engine().layout().friction);  // initial.friction = 0
  const RunResult result = simulation.run();
  ASSERT_EQ(result.ending, Ending::finished) << result.failure;
  ASSERT_TRUE(result.compression);
  EXPECT_TRUE(result.layout.friction);
  EXPECT_TRUE(result.compression->equilibrium);
  EXPECT_NEAR(result.compression->pressure, 1, equilibrium_stress_tolerance);
  EXPECT_GT(result.compression->solid_fraction, 0.75);
  // The run proper starts dense.
  EXPECT_GT(result.series.rows.front()[Observable::solid_fraction], 0.75);
}

TEST_P(restart, WhileTheGasIsCompressed) {
  const Scene scene = compressed_scene();
  const RunResult whole = Simulation<2>(scene, GetParam()).run();
  int asked = 0;
  RunControl control;
  control.stop = [&] { return ++asked == 20; };
  Simulation<2> first(scene, GetParam());
  ASSERT_EQ(first.run(control).ending, Ending::interrupted);
  ASSERT_TRUE(first.compressing());
  Simulation<2> second = Simulation<2>::resume(scene, first.checkpoint());
  EXPECT_TRUE(second.compressing());
  const RunResult resumed = second.run();
  expect_same(resumed, whole);
  EXPECT_EQ(resumed.compression->steps, whole.compression->steps);

  // And once more after it, in the run proper.
  Simulation<2> third = Simulation<2>::resume(scene, second.checkpoint());
  EXPECT_FALSE(third.compressing());
  const RunResult again = third.run();
  EXPECT_EQ(again.state_hash, whole.state_hash);
  EXPECT_EQ(again.compression->steps, whole.compression->steps);
}

TEST(Equilibrium, RattlersDontCount) {
  // Two grains pressed against each other along each direction of a periodic cell; a third spins in the void.
  const Scene scene = isotropic_scene();
  Sample<2> sample;
  sample.resize(3);
  sample.cell.box = 2 * Mat<2>::Identity();
  sample.cell.periodic = {true, true};
  sample.spin = {0, 0, 100};
  const EquilibriumTest<2> test(scene, derive(scene, grain_facts(scene, sample)));

  ContactColumns<2> contacts;
  contacts.i = {0, 0, 0};
  contacts.j = {1, 1, 1};
  contacts.image = {Image<2>{0, 0}, Image<2>{-1, 0}, Image<2>{0, -1}};
  contacts.normal = contacts.branch = contacts.force = {Vec<2>(0, 1), Vec<2>(1, 0), Vec<2>(0, -1)};
  contacts.gap = {0, 0, 0};
  Snapshot<2> snapshot;
  snapshot.cell = &sample.cell;
  snapshot.position = sample.position;
  snapshot.velocity = sample.velocity;
  snapshot.spin = sample.spin;
  snapshot.radius = sample.radius;
  snapshot.mass = sample.mass;
  snapshot.contacts = &contacts;
  EXPECT_EQ(test.backbone_energy(snapshot), 0);
  sample.velocity[0] = Vec<2>(2, 0);  // m v^2 / 2 = 2, shared by the two grains of the backbone; P d^2 = 1
  EXPECT_DOUBLE_EQ(test.backbone_energy(snapshot), 1);
}

TEST(Simulation, FailureKeepsTheLastSoundState) {
  Scene scene = shear_scene();
  scene.md.dt = 1;  // hundreds of times above the stability bound
  scene.md.allow_unsafe_dt = true;
  scene.run.duration = 5000;
  const RunResult result = Simulation<2>(scene, EngineKind::md).run();
  ASSERT_EQ(result.ending, Ending::failed);
  EXPECT_FALSE(result.failure.empty());
  ASSERT_TRUE(result.last_good);
  EXPECT_LT(Simulation<2>::resume(scene, *result.last_good).engine().steps(), result.total_steps);
}

TEST(Simulation, CheckpointsOnTheClock) {
  int written = 0;
  RunControl control;
  control.checkpoint_every = 1e-9;
  control.checkpoint = [&](const Archive& archive) {
    ++written;
    EXPECT_NO_THROW(stored_sample<2>(archive));
  };
  EXPECT_EQ(Simulation<2>(shear_scene(), EngineKind::md).run(control).ending, Ending::finished);
  EXPECT_GT(written, 5);
}

// ---- What a checkpoint says about its scene ----

constexpr const char* scene_text = R"(
title = "restart"
[grains]
count = 20
[material]
restitution = 0.5
stiffness_level = 1e3
[loading]
kind = "isotropic"
pressure = 1.0
[run]
duration = 1
samples = 5
)";

TEST(restartFromText, NeedsNothingButTheCheckpoint) {
  const std::vector<Override> changes = {{"grains.count", "30"}, {"run.duration", "2"}};
  const Scene scene = parse_scene(scene_text, "test", changes);
  Simulation<2> simulation(scene, EngineKind::md, changes);
  simulation.run(at_most(10));
  const Archive archive = simulation.checkpoint();
  EXPECT_EQ(stored_engine(archive), EngineKind::md);
  const Scene stored = stored_scene(archive);
  EXPECT_EQ(stored.grains.count, 30);
  EXPECT_EQ(*stored.run.duration, 2);
  expect_same(Simulation<2>::resume(stored, archive).run(), Simulation<2>(scene, EngineKind::md, changes).run());
}

TEST(restartFromText, OnlyTheLengthOfARunMayChange) {
  const Scene scene = parse_scene(scene_text, "test");
  const Archive archive = Simulation<2>(scene, EngineKind::md).checkpoint();
  EXPECT_EQ(*stored_scene(archive, {{"run.duration", "3"}}).run.duration, 3);
  EXPECT_THROW(stored_scene(archive, {{"material.friction", "0.3"}}), InputError);
  const Archive unwritten = Simulation<2>(shear_scene(), EngineKind::md).checkpoint();
  EXPECT_THROW(stored_scene(unwritten), InputError);  // a scene built in code has no text
}

TEST(restartFromText, FindsTheSameGrains) {
  Sample<3> sample;
  sample.resize(2);
  sample.cell.box << 4, 1, 0, 0, 5, 0, 0, 0, 6;
  sample.cell.periodic = {true, false, true};
  sample.planes = {{Vec<3>(0, 1, 0), Vec<3>(0, 1, 0), Vec<3>(0.5, 0, 0)}};
  sample.position = {Vec<3>(1, 2, 3), Vec<3>(3, 2, 1)};
  sample.spin[1] = Vec<3>(7, 8, 9);
  sample.radius = {0.5, 0.25};
  Archive archive;
  save_sample(archive, sample);
  const Sample<3> stored = stored_sample<3>(archive);
  EXPECT_EQ(stored.cell.box, sample.cell.box);
  EXPECT_EQ(stored.cell.periodic, sample.cell.periodic);
  ASSERT_EQ(stored.planes.size(), 1u);
  EXPECT_EQ(stored.planes[0].velocity, sample.planes[0].velocity);
  EXPECT_EQ(stored.position, sample.position);
  EXPECT_EQ(stored.spin, sample.spin);
  EXPECT_EQ(stored.radius, sample.radius);
  EXPECT_THROW(stored_sample<2>(archive), InputError);
}

}  // namespace
}  // namespace galet::test::simulation_test
