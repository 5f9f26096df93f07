// Studies as a whole: the registry, rows that are kept and skipped, and a tiny study from its plan to its files.
#include "src/studies/study.hpp"

#include <algorithm>
#include <filesystem>
#include <set>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "common/core/error.hpp"
#include "common/io/scene_file.hpp"
#include "src/studies/costs.hpp"
#include "src/studies/registry.hpp"
#include "src/studies/row_file.hpp"
#include "src/studies/run_study.hpp"
#include "src/studies/study_files.hpp"
#include "src/studies/templates.hpp"
#include "tests/support/temporary_folder.hpp"

namespace galet::test::study_test {
namespace {

ShearScene tiny_scene(EngineKind engine, double inertial_number) {
  ShearScene scene;
  scene.engine = engine;
  scene.grains = 30;
  scene.stiffness_level = 300;
  scene.inertial_number = inertial_number;
  scene.strain = 2;
  scene.settling = 0.5;
  return scene;
}

std::vector<StudyRun> tiny_plan(StudySize size) {
  std::vector<StudyRun> runs;
  for (const EngineKind engine : {EngineKind::md, EngineKind::cd})
    for (const double state : {0.1, 0.2}) {
      if (size == StudySize::quick && state > 0.1) continue;
      const std::string name = (engine == EngineKind::md ? "md_" : "cd_") + plain_number(state);
      runs.push_back({name, engine, {{"I", state}}, shear_scene(tiny_scene(engine, state)), engine == EngineKind::md});
    }
  return runs;
}

StudyReport tiny_report(const std::vector<StudyRow>& rows) {
  StudyReport report;
  report.add("mu* (md)", value_of(row_with(rows, EngineKind::md, {{"I", 0.1}}), Observable::mu_star),
             "flow.mu_star_at_0.1", "a handful of grains");
  report.add("mu* of no row", value_of(row_with(rows, EngineKind::md, {{"I", 7}}), Observable::mu_star),
             "flow.mu_star_at_0.1");
  report.figures.push_back({"mu_star",
                            {"mu*",
                             "I",
                             "mu*",
                             true,
                             false,
                             {series_of("md", rows_with(rows, EngineKind::md, {}), "I", Observable::mu_star)}}});
  report.remarks.emplace_back("a remark");
  return report;
}

const Study tiny{"tiny", "A tiny study", "nobody", "30 disks", Observable::mu_star, tiny_plan, tiny_report};

StudyOptions options_in(const test::TemporaryFolder& folder) {
  StudyOptions options;
  options.directory = folder.path();
  return options;
}

TEST(StudyRegistry, PlansHaveDistinctNamesAndScenesThatCanBeRead) {
  std::set<std::string> studies;
  for (const Study& study : all_studies()) {
    EXPECT_TRUE(studies.insert(study.name).second);
    EXPECT_EQ(&find_study(study.name), &study);
    for (const StudySize size : {StudySize::quick, StudySize::full}) {
      std::set<std::string> names, hashes;
      for (const StudyRun& run : study.plan(size)) {
        EXPECT_TRUE(names.insert(run.name).second) << run.name;
        EXPECT_EQ(run.name.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_.-"),
                  std::string::npos)
            << run.name;
        EXPECT_TRUE(hashes.insert(scene_hash(run)).second) << run.name << " is the scene of another run";
        if (size == StudySize::quick) {
          EXPECT_NO_THROW(parse_scene(run.scene, run.name)) << study.name;
        }
      }
      EXPECT_GT(names.size(), 1u);
    }
    EXPECT_LE(study.plan(StudySize::quick).size(), study.plan(StudySize::full).size());
  }
}

TEST(StudyRegistry, WithoutRowsEverythingIsOpen) {
  for (const Study& study : all_studies()) {
    const StudyReport report = study.evaluate({});
    for (const StudyFinding& finding : report.findings) EXPECT_EQ(finding.verdict, Verdict::open) << finding.quantity;
  }
}

TEST(StudyRegistry, UnknownNameHasANearMatch) {
  try {
    find_study("flow_law");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("did you mean \"flow-law\"?"), std::string::npos) << error.what();
  }
}

TEST(StudyRegistry, CostGrowsWithSize) {
  EXPECT_GT(estimate_study(tiny, StudySize::full).seconds, estimate_study(tiny, StudySize::quick).seconds);
  EXPECT_EQ(estimate_study(tiny, StudySize::full).runs, 4);
}

TEST(StudyScenes, HoldWhatTheyAreAskedFor) {
  ShearScene wanted = tiny_scene(EngineKind::cd, 1e-3);
  wanted.friction = 0.7;
  wanted.volume_strain = 4;
  wanted.dense_strain = 1;
  wanted.material = "cohesion_number = 2.0\n";
  const Scene scene = parse_scene(shear_scene(wanted), "scene");
  EXPECT_EQ(scene.engine, EngineKind::cd);
  EXPECT_EQ(scene.material.friction, 0.7);
  EXPECT_EQ(scene.material.cohesion_number, 2.0);
  ASSERT_EQ(scene.stages.size(), 3u);
  EXPECT_EQ(scene.stages[0].friction, 0.0);
  EXPECT_EQ(scene.stages[0].loading.inertial_number, 0.01);
  EXPECT_EQ(scene.stages[1].loading.inertial_number, 1e-3);
  EXPECT_TRUE(scene.stages[2].loading.fixed_volume);
  EXPECT_DOUBLE_EQ(scene.run.average_from, 0.125);
  EXPECT_EQ(plain_number(0.1), "0.1");
  EXPECT_EQ(plain_number(2e-3), "2e-3");
  EXPECT_EQ(plain_number(2.5e5), "2.5e5");
  EXPECT_EQ(plain_number(0), "0");
}

TEST(StudyScenes, ASlowStartRaisesThePressureFirst) {
  ShearScene wanted = tiny_scene(EngineKind::md, 0.2);
  wanted.slow_start = 50;
  const Scene scene = parse_scene(shear_scene(wanted), "scene");
  ASSERT_EQ(scene.stages.size(), 2u);
  const LoadingSpec& raised = scene.stages[0].loading;
  EXPECT_EQ(scene.stages[0].strain, 10.0);  // 50 inertial times at this rate
  EXPECT_EQ(raised.pressure, 0.05);
  EXPECT_EQ(raised.pressure_to, 1.0);
  EXPECT_EQ(raised.inertial_number, 0.2);  // of the pressure that the flow has
  EXPECT_EQ(scene.stages[1].strain, wanted.strain);
  EXPECT_FALSE(scene.stages[1].loading.pressure_to);
}

TEST(StudyScenes, AveragesWaitForThePressure) {
  ShearScene scene;
  scene.grains = 2500, scene.strain = 40, scene.settling = 2;
  scene.inertial_number = 0.01;
  EXPECT_EQ(settled_strain(scene), 2);
  scene.inertial_number = 0.2;  // 1.6 * 50 inertial times
  EXPECT_DOUBLE_EQ(settled_strain(scene), 16);
  EXPECT_DOUBLE_EQ(parse_scene(shear_scene(scene), "scene").run.average_from, 0.4);
  scene.dimension = 3, scene.grains = 1000;
  EXPECT_NEAR(settled_strain(scene), 3.2, 1e-12);
}

TEST(StudyRows, AreReadAsTheyWereWritten) {
  const test::TemporaryFolder folder;
  const StudyOutcome outcome = run_study(tiny, options_in(folder));
  ASSERT_EQ(outcome.rows.size(), 4u);
  for (const StudyRow& row : outcome.rows) {
    ASSERT_TRUE(row.usable()) << row.run.failure;
    const auto stored = read_row(folder.path(), row.plan);
    ASSERT_TRUE(stored);
    EXPECT_TRUE(stored->kept);
    EXPECT_EQ((*stored)[Observable::mu_star].value, row[Observable::mu_star].value);
    EXPECT_EQ((*stored)[Observable::mu_star].error, row[Observable::mu_star].error);
    EXPECT_EQ((*stored)[Observable::inertial_number].value, row[Observable::inertial_number].value);
    EXPECT_EQ(stored->run.state_hash, row.run.state_hash);
    EXPECT_EQ(stored->run.cpu_seconds, row.run.cpu_seconds);
    EXPECT_EQ(stored->run.last[Observable::solid_fraction], row.run.last[Observable::solid_fraction]);
    if (!row.plan.keep_series) continue;
    EXPECT_EQ(stored->run.series.column(Observable::sigma_xy), row.run.series.column(Observable::sigma_xy));
  }
}

TEST(StudyRows, OfAnotherSceneOrAnEditedFileAreNotTaken) {
  const test::TemporaryFolder folder;
  StudyOptions options = options_in(folder);
  options.size = StudySize::quick;
  const StudyOutcome outcome = run_study(tiny, options);
  StudyRun run = outcome.rows[0].plan;
  EXPECT_TRUE(read_row(folder.path(), run));
  StudyRun other = run;
  other.scene += "# another text\n";
  EXPECT_FALSE(read_row(folder.path(), other));
  other = run;
  other.engine = EngineKind::cd;
  EXPECT_FALSE(read_row(folder.path(), other));
  test::put_bytes(folder.file("rows/" + run.name + ".json"), "{\"scene_hash\": ");
  EXPECT_FALSE(read_row(folder.path(), run));
  test::put_bytes(folder.file("rows/" + run.name + ".json"), "{\"scene_hash\": \"" + scene_hash(run) + "\"}");
  EXPECT_FALSE(read_row(folder.path(), run));
}

TEST(Study, StoppedGoesOnWithWhatIsMissing) {
  const test::TemporaryFolder folder, whole_folder;
  StudyOptions options = options_in(folder);
  int asked = 0;
  const StudyOutcome whole = run_study(tiny, options_in(whole_folder));
  // Stops when two rows are there.
  options.stop = [&] {
    ++asked;
    return std::filesystem::exists(folder.file("rows")) &&
           std::distance(std::filesystem::directory_iterator(folder.file("rows")), {}) >= 2;
  };
  const StudyOutcome stopped = run_study(tiny, options);
  EXPECT_TRUE(stopped.interrupted);
  EXPECT_TRUE(stopped.failed());
  EXPECT_EQ(stopped.rows.size(), 2u);
  EXPECT_GT(asked, 2);
  const StudyOutcome resumed = run_study(tiny, options_in(folder));
  EXPECT_EQ(resumed.kept, 2);
  EXPECT_FALSE(resumed.failed());
  ASSERT_EQ(resumed.rows.size(), 4u);
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_EQ(resumed.rows[k].run.state_hash, whole.rows[k].run.state_hash);
    EXPECT_EQ(resumed.rows[k][Observable::mu_star].value, whole.rows[k][Observable::mu_star].value);
  }
  StudyOptions fresh = options_in(folder);
  fresh.fresh = true;
  EXPECT_EQ(run_study(tiny, fresh).kept, 0);
}

TEST(Study, FromPlanToFiles) {
  const test::TemporaryFolder folder;
  StudyOptions options = options_in(folder);
  options.jobs = 2;
  const StudyOutcome outcome = run_study(tiny, options);
  for (const std::string& file : write_study(tiny, outcome, folder.path())) EXPECT_TRUE(std::filesystem::exists(file));
  for (const char* name : {"report.txt", "runs.csv", "findings.csv", "study.json", "mu_star.dat", "mu_star.gp",
                           "scenes/md_0.1.toml", "rows/cd_0.2.json"})
    EXPECT_TRUE(std::filesystem::exists(folder.file(name))) << name;
  const auto json = nlohmann::json::parse(study_json(tiny, outcome));
  EXPECT_EQ(json["rows"].size(), 4u);
  EXPECT_EQ(json["findings"][0]["published"], 0.37);
  EXPECT_EQ(json["findings"][1]["verdict"], "-");
  EXPECT_EQ(json["costs"].size(), 2u);  // both engines at both I
  const std::string text = study_text(tiny, outcome);
  EXPECT_NE(text.find("0.37 ±0.02"), std::string::npos);
  EXPECT_NE(text.find("a handful of grains"), std::string::npos);
  EXPECT_NE(text.find("remark: a remark"), std::string::npos);
  // The echo of a scene is a scene.
  EXPECT_EQ(read_scene(folder.file("scenes/md_0.1.toml")).grains.count, 30);
}

TEST(Study, CostAtEqualErrorDoesNotDependOnTheLengthOfARun) {
  StudyRow row;
  row.run.cpu_seconds = 10;
  row.run.averages.values[static_cast<int>(Observable::mu_star)] = {0.4, 0.008};  // 2 %
  EXPECT_DOUBLE_EQ(seconds_to_one_percent(row, Observable::mu_star), 40);
  row.run.cpu_seconds = 40;  // four times as long, half the error
  row.run.averages.values[static_cast<int>(Observable::mu_star)].error = 0.004;
  EXPECT_DOUBLE_EQ(seconds_to_one_percent(row, Observable::mu_star), 40);
}

StudyRow cost_row(EngineKind engine, std::vector<std::pair<std::string, double>> parameters, const Estimate& friction,
                  double seconds, Ending ending = Ending::finished) {
  StudyRow row;
  row.plan.engine = engine, row.plan.parameters = std::move(parameters);
  row.run.averages.values[static_cast<int>(Observable::mu_star)] = friction;
  row.run.cpu_seconds = seconds, row.run.ending = ending;
  return row;
}

TEST(Study, CostOfSamplesIsThatOfTheirScatter) {
  // Block errors of states at rest say nothing. Samples of 0.38, 0.40 and 0.42 in md, of 0.36, 0.40 and 0.44 in cd,
  // which takes five times as long.
  std::vector<StudyRow> rows;
  for (const int copies : {1, 2}) {
    rows.clear();
    for (int copy = 0; copy < copies; ++copy)
      for (const int seed : {0, 1, 2})
        for (const EngineKind engine : {EngineKind::md, EngineKind::cd}) {
          const bool soft = engine == EngineKind::md;
          rows.push_back(cost_row(engine, {{"state", 'A'}, {"seed", 3 * copy + seed}},
                                  {0.4 + (soft ? 0.02 : 0.04) * (seed - 1), 1e-9}, (soft ? 1 : 5) * (1.0 + seed),
                                  Ending::equilibrium));
        }
    const auto pairs = cost_pairs(tiny, rows);
    ASSERT_EQ(pairs.size(), 1u);
    EXPECT_EQ(pairs[0].state, "state = A");
    // Squares of 5 % and 10 %, each twice in a copy; two means are known from the samples.
    const double variance = copies * 2 * (0.0025 + 0.01) / (6 * copies - 2);
    EXPECT_NEAR(pairs[0].md, 2 * 1e4 * variance, 1e-9 * pairs[0].md);
    EXPECT_NEAR(pairs[0].cd, 5 * pairs[0].md, 1e-9 * pairs[0].cd);
  }
  // One sample at rest has no known error.
  EXPECT_TRUE(cost_pairs(tiny, {rows[0], rows[1]}).empty());
}

TEST(Study, CostsAreComparedAtOneStiffness) {
  const Estimate one_percent{0.4, 0.004};
  const auto md = [&](double kappa, double seconds) {
    return cost_row(EngineKind::md, {{"I", 0.1}, {"kappa", kappa}}, one_percent, seconds);
  };
  const auto pairs = cost_pairs(
      tiny, {md(40, 1), md(1e3, 5), md(1e5, 50), cost_row(EngineKind::cd, {{"I", 0.1}, {"kappa", 40}}, one_percent, 3),
             cost_row(EngineKind::cd, {{"I", 0.1}, {"kappa", 200}}, one_percent, 3),
             cost_row(EngineKind::cd, {{"I", 0.1}, {"rigid", 1}}, one_percent, 4)});
  ASSERT_EQ(pairs.size(), 2u);  // nothing of md has kappa = 200
  EXPECT_EQ(pairs[0].state, "I = 0.1, kappa = 40");
  EXPECT_DOUBLE_EQ(pairs[0].md, 1);
  EXPECT_DOUBLE_EQ(pairs[0].cd, 3);
  EXPECT_EQ(pairs[1].state, "I = 0.1, kappa = 100000 (cd: rigid)");
  EXPECT_DOUBLE_EQ(pairs[1].md, 50);
  EXPECT_DOUBLE_EQ(pairs[1].cd, 4);
}

}  // namespace
}  // namespace galet::test::study_test
