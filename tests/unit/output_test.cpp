// What [output] asks for: columns, files, frames; nothing else, and no change of the run.
#include <cmath>
#include <set>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "common/io/csv.hpp"
#include "common/io/files.hpp"
#include "src/engines.hpp"
#include "src/frame_files.hpp"
#include "src/run_files.hpp"
#include "src/simulation.hpp"
#include "tests/support/temporary_folder.hpp"

namespace galet::test::output_test {
namespace {

Scene shear_scene() {
  Scene scene;
  scene.grains.count = 60;
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

std::vector<std::string> all_measures() {
  std::vector<std::string> names;
  for (const MeasureInfo& measure : measure_table) names.emplace_back(measure.name);
  return names;
}

std::set<std::string> columns_of(const CsvTable& table) {
  std::set<std::string> names;
  for (const CsvColumn& column : table.columns) names.insert(column.name);
  return names;
}

class OutputOfEngines : public testing::TestWithParam<EngineKind> {};
const auto name_of = [](const auto& info) { return engine_name(info.param); };
INSTANTIATE_TEST_SUITE_P(Output, OutputOfEngines, testing::Values(EngineKind::md, EngineKind::cd), name_of);

TEST_P(OutputOfEngines, MeasureOnlyWhatWasAskedFor) {
  Scene scene = shear_scene();
  const RunResult plain = Simulation<2>(scene, GetParam()).run();
  scene.output.measures = all_measures();
  Simulation<2> simulation(scene, GetParam());
  const RunResult asked = simulation.run();
  EXPECT_EQ(plain.state_hash, asked.state_hash);
  const std::set<std::string> before = columns_of(to_table(plain.series)), after = columns_of(to_table(asked.series));
  EXPECT_EQ(after.size(), before.size() + 10);
  for (const char* name : {"a_c", "a_t", "sliding", "T_rot", "unbalanced_force"}) {
    EXPECT_EQ(before.count(name), 0u);
    EXPECT_EQ(after.count(name), 1u);
    EXPECT_EQ(to_json(plain, "").find(std::string("\"") + name + "\""), std::string::npos);
  }
  EXPECT_TRUE(std::isnan(plain.series.rows.back()[Observable::sliding]));
  EXPECT_FALSE(plain.measures.forces || plain.measures.moduli || plain.measures.indeterminacy);
  EXPECT_TRUE(plain.measures.gaps.empty() && plain.measures.profile.empty() &&
              plain.measures.local_solid_fraction.empty());

  // In range, whatever the state: shear builds contacts along the compression, some of them slide.
  const Measurement& last = asked.last;
  EXPECT_GT(last[Observable::sliding], 0);
  EXPECT_LT(last[Observable::sliding], 1);
  EXPECT_GT(last[Observable::mobilised], last[Observable::sliding]);
  EXPECT_LT(last[Observable::mobilised], 1);
  EXPECT_GT(asked.averages[Observable::anisotropy_normal].value, 0);
  EXPECT_GT(last[Observable::temperature], 0);
  EXPECT_GT(last[Observable::unbalanced_force], 0);

  const FinalMeasures& final = asked.measures;
  ASSERT_TRUE(final.forces && final.moduli && final.indeterminacy);
  EXPECT_EQ(final.profile.size(), 20u);
  EXPECT_EQ(final.profile_states, asked.averages.rows);
  double phi = 0, inverse = 0;
  for (const ProfileRow& row : final.profile) phi += row.solid_fraction / 20;
  EXPECT_NEAR(phi, asked.averages[Observable::solid_fraction].value, 0.02);
  EXPECT_EQ(final.local_solid_fraction.size(), 60u);
  const Snapshot<2> state = simulation.engine().snapshot();
  for (int i = 0; i < 60; ++i) inverse += grain_volume<2>(2 * state.radius[i]) / final.local_solid_fraction[i];
  EXPECT_NEAR(inverse, state.cell->volume(), 1e-9 * inverse);  // the cells fill the sample
  EXPECT_LE(final.moduli->bulk, final.moduli->affine_bulk);
}

TEST_P(OutputOfEngines, WriteWhatWasAskedFor) {
  Scene scene = shear_scene();
  scene.output.measures = {"profile", "directions", "gaps", "indeterminacy", "voronoi", "forces", "moduli"};
  scene.run.duration = 80;
  scene.run.samples = 200;
  Simulation<2> simulation(scene, GetParam());
  const RunResult result = simulation.run();
  const test::TemporaryFolder folder;
  write_run(result, simulation, "scene", folder.path());
  const std::string engine = engine_name(GetParam());
  const NumberTable profile = read_csv(folder.file(engine + "_profile.csv"));
  EXPECT_EQ(profile.rows(), 20);
  double sigma = 0;
  for (int k = 0; k < 20; ++k) sigma += profile.at(k, *profile.find("sigma_yy")) / 20;
  EXPECT_NEAR(sigma, 1, 0.2);  // the pressure: 100 looks at impacts of few grains, each off by about its own size
  EXPECT_TRUE(profile.find("I") && profile.find("shear_rate") && profile.find("T"));
  EXPECT_EQ(read_csv(folder.file(engine + "_gaps.csv")).rows(), gap_intervals + 1);
  EXPECT_EQ(read_csv(folder.file(engine + "_voronoi.csv")).rows(), 60);
  EXPECT_EQ(read_csv(folder.file(engine + "_directions.csv"), EmptyCells::not_a_number).rows(), direction_sectors);
  EXPECT_EQ(read_csv(folder.file(engine + "_forces.csv")).rows(), 60);
  const auto json = nlohmann::json::parse(read_file(folder.file(engine + "_summary.json")));
  EXPECT_EQ(json["measures"]["indeterminacy"]["indeterminacy"], result.measures.indeterminacy->indeterminacy());
  EXPECT_EQ(json["measures"]["moduli"]["stiffness"].size(), 3u);
}

// A run that is stopped and resumed has the same profile and the same columns, bit for bit, and writes each frame once.
TEST_P(OutputOfEngines, SameAfterRestart_restart) {
  Scene scene = shear_scene();
  scene.output.measures = {"profile", "fabric", "friction", "balance", "temperature"};
  scene.output.frames = 4;
  std::vector<Frame> frames;
  RunControl control;
  control.frame = [&](const Frame& frame) { frames.push_back(frame); };
  const RunResult whole = Simulation<2>(scene, GetParam()).run(control);
  ASSERT_EQ(frames.size(), 5u);
  EXPECT_EQ(frames.back().step, whole.steps);
  EXPECT_EQ(frames.back().times.size(), 5u);
  EXPECT_EQ(frames.back().times.back(), whole.time);

  std::vector<Frame> again;
  control.frame = [&](const Frame& frame) { again.push_back(frame); };
  control.most_steps = frames[3].step;  // stops where a frame has just been written, past the middle
  Simulation<2> first(scene, GetParam());
  first.run(control);
  control.most_steps = whole.steps;
  const RunResult resumed = Simulation<2>::resume(scene, first.checkpoint()).run(control);
  ASSERT_EQ(again.size(), frames.size());
  for (std::size_t k = 0; k < frames.size(); ++k) {
    EXPECT_EQ(again[k].step, frames[k].step);
    EXPECT_EQ(again[k].times, frames[k].times);
  }
  EXPECT_EQ(resumed.state_hash, whole.state_hash);
  for (std::size_t k = 0; k < whole.measures.profile.size(); ++k) {
    EXPECT_EQ(resumed.measures.profile[k].velocity, whole.measures.profile[k].velocity);
    EXPECT_EQ(resumed.measures.profile[k].stress, whole.measures.profile[k].stress);
  }
  for (const Observable observable : {Observable::anisotropy_normal, Observable::sliding, Observable::unbalanced_force})
    for (std::size_t row = 0; row < whole.series.rows.size(); ++row) {
      const double one = resumed.series.rows[row][observable], other = whole.series.rows[row][observable];
      EXPECT_TRUE(one == other || (std::isnan(one) && std::isnan(other))) << info(observable).name << row;
    }
}

}  // namespace
}  // namespace galet::test::output_test
