// A run with stages that is stopped anywhere (within a stage, at a turn of its path, at its end) and resumed has the
// bits of one that was not.
#include "tests/support/stages.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "src/simulation.hpp"
#include "tests/support/scenes.hpp"

namespace galet::test::stages_test {
namespace {

void expect_same(const RunResult& a, const RunResult& b) {
  EXPECT_EQ(a.state_hash, b.state_hash);
  EXPECT_EQ(a.steps, b.steps);
  EXPECT_EQ(a.ending, b.ending);
  ASSERT_EQ(a.stages.size(), b.stages.size());
  for (std::size_t k = 0; k < a.stages.size(); ++k) {
    EXPECT_EQ(a.stages[k].name, b.stages[k].name);
    EXPECT_EQ(a.stages[k].steps, b.stages[k].steps);
    EXPECT_EQ(a.stages[k].ending, b.stages[k].ending);
    EXPECT_EQ(a.stages[k].last[Observable::sigma_yy], b.stages[k].last[Observable::sigma_yy]);
  }
  ASSERT_EQ(a.series.rows.size(), b.series.rows.size());
  for (std::size_t r = 0; r < a.series.rows.size(); ++r)
    for (int k = 0; k < observable_count; ++k) {
      const double one = a.series.rows[r].values[k], other = b.series.rows[r].values[k];
      ASSERT_TRUE(one == other || (std::isnan(one) && std::isnan(other)))
          << observable_table[k].name << " in row " << r << ": " << one << " and " << other;
    }
}

void check_engine(EngineKind kind) {
  SCOPED_TRACE(to_string(kind));
  Scene scene = staged_scene();
  scene.md.energy_budget = true;
  std::vector<Archive> ends;
  RunControl control;
  control.stage_end = [&ends](int number, const std::string&, const Archive& archive) {
    EXPECT_EQ(number, static_cast<int>(ends.size()) + 1);
    ends.push_back(archive);
  };
  const RunResult whole = Simulation<2>(scene, kind).run(control);
  ASSERT_EQ(whole.ending, Ending::finished) << whole.failure;
  ASSERT_EQ(whole.stages.size(), scene.stages.size());
  EXPECT_EQ(whole.stages[0].ending, Ending::equilibrium);
  EXPECT_EQ(whole.stages[2].ending, Ending::reached);

  std::vector<long> stops;
  long before = 0;
  for (const StageReport& stage : whole.stages) {
    stops.insert(stops.end(), {before + 1, before + stage.steps / 2 + 3, before + stage.steps});
    before += stage.steps;
  }
  const long cycles = whole.steps - whole.stages[5].steps - whole.stages[4].steps;
  stops.push_back(cycles + std::lround(0.25 * static_cast<double>(whole.stages[4].steps)));  // a turn of the path
  for (const long stop : stops) {
    if (stop >= whole.steps) continue;
    SCOPED_TRACE("stop at " + std::to_string(stop));
    RunControl part;
    part.most_steps = stop;
    Simulation<2> first(scene, kind);
    EXPECT_EQ(first.run(part).ending, Ending::interrupted);
    expect_same(Simulation<2>::resume(scene, first.checkpoint()).run(), whole);
  }
  ASSERT_EQ(ends.size(), scene.stages.size());
  for (const Archive& end : ends) expect_same(Simulation<2>::resume(scene, end).run(), whole);
}

TEST(restart, WithinAnyStageMd) { check_engine(EngineKind::md); }
TEST(restart, WithinAnyStageCd) { check_engine(EngineKind::cd); }

}  // namespace
}  // namespace galet::test::stages_test
