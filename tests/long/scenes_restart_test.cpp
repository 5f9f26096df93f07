// Every scene of scenes/, shortened: a run, and one that is stopped half-way, written to a checkpoint file and taken up
// again, end in the same bits; so do runs of one and of two threads, and runs that change their number at the restart.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "common/core/parallel.hpp"
#include "common/io/checkpoint.hpp"
#include "src/engines.hpp"
#include "src/restart.hpp"
#include "src/simulation.hpp"
#include "tests/support/temporary_folder.hpp"

namespace galet::test::scenes_restart_test {
namespace {

namespace fs = std::filesystem;

/// What makes each scene last up to ten inertial times, with all of its stages.
const std::map<std::string, std::vector<Override>>& shortened() {
  static const std::map<std::string, std::vector<Override>> changes = {
      {"annular_shear_2d", {{"run.duration", "1.5"}}},
      {"ballistic_aggregation_2d", {{"grains.count", "100"}, {"stage[0].duration", "1"}, {"stage[1].duration", "1"}}},
      {"clumps_2d", {{"run.duration", "2"}}},
      {"dense_start_2d", {{"grains.count", "200"}, {"run.duration", "2"}}},
      {"inclined_plane_2d", {{"run.duration", "2"}}},
      {"pluviation_2d", {{"run.duration", "2"}}},
      {"rough_wall_shear_2d", {{"run.duration", "2"}}},
      {"assembly_3d", {{"stage[0].duration", "8"}, {"stage[1].duration", "0.5"}, {"stage[2].duration", "2"}}},
      {"biaxial_2d", {{"stage[0].duration", "8"}, {"stage[1].strain", "0.002"}}},
      {"cyclic_shear_2d", {{"stage[0].duration", "8"}, {"stage[1].strain", "0.004"}}},
      {"frictionless_2d", {{"run.duration", "10"}}},
      {"glass_3d", {{"run.duration", "\"0.3 ms\""}}},
      {"isotropic_3d", {{"run.duration", "10"}}},
      {"oedometric_2d",
       {{"stage[0].duration", "7"},
        {"stage[1].duration", "1"},
        {"stage[2].duration", "1"},
        {"stage[3].duration", "1"}}},
      {"plane_shear_2d", {{"run.strain", "1"}}},
      {"triaxial_creep_3d",
       {{"stage[0].duration", "7"},
        {"stage[1].strain", "0.001"},
        {"stage[2].duration", "1"},
        {"stage[3].strain", "0.001"}}}};
  return changes;
}

std::vector<std::string> scene_names() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(fs::path(GALET_SOURCE_DIR) / "scenes"))
    if (entry.path().extension() == ".toml") names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

struct End {
  std::uint64_t state = 0;
  std::vector<Measurement> rows;
  long steps = 0;
};

bool same_rows(const std::vector<Measurement>& a, const std::vector<Measurement>& b) {
  if (a.size() != b.size()) return false;
  for (std::size_t row = 0; row < a.size(); ++row)
    for (int k = 0; k < observable_count; ++k)
      if (a[row].values[k] != b[row].values[k] && !(std::isnan(a[row].values[k]) && std::isnan(b[row].values[k])))
        return false;
  return true;
}

template <int D>
class Course {
 public:
  Course(Scene scene, EngineKind kind, std::vector<Override> changes)
      : scene_(std::move(scene)), kind_(kind), changes_(std::move(changes)) {}

  End whole(int threads) const {
    set_thread_count(threads);
    Simulation<D> simulation(scene_, kind_, changes_);
    return end_of(simulation.run());
  }
  /// `steps` with so many threads, a checkpoint file, the rest with others.
  End halves(long steps, int threads, int threads_after) const {
    const TemporaryFolder folder;
    {
      set_thread_count(threads);
      Simulation<D> first(scene_, kind_, changes_);
      RunControl control;
      control.most_steps = steps;
      EXPECT_EQ(first.run(control).steps, steps);
      write_checkpoint(folder.file("half.h5"), first.checkpoint());
    }
    set_thread_count(threads_after);
    const Archive archive = read_checkpoint(folder.file("half.h5"));
    Simulation<D> second = Simulation<D>::resume(stored_scene(archive), archive);
    return end_of(second.run());
  }

 private:
  static End end_of(const RunResult& result) {
    EXPECT_NE(result.ending, Ending::failed) << result.failure;
    EXPECT_NE(result.ending, Ending::interrupted);
    return {result.state_hash, result.series.rows, result.steps};
  }

  Scene scene_;
  EngineKind kind_;
  std::vector<Override> changes_;
};

template <int D>
void check(const Scene& scene, EngineKind kind, const std::vector<Override>& changes) {
  const int before = thread_count();
  const Course<D> course(scene, kind, changes);
  const End whole = course.whole(1);
  EXPECT_GT(whole.steps, 100);
  const auto expect_same = [&](const End& other, const char* what) {
    EXPECT_EQ(other.state, whole.state) << what;
    EXPECT_EQ(other.steps, whole.steps) << what;
    EXPECT_TRUE(same_rows(other.rows, whole.rows)) << what;
  };
  expect_same(course.whole(2), "two threads");
  expect_same(course.halves(whole.steps / 2, 1, 2), "one thread, then two");
  expect_same(course.halves(whole.steps / 2, 2, 1), "two threads, then one");
  set_thread_count(before);
}

class EveryScene : public testing::TestWithParam<std::tuple<std::string, EngineKind>> {};
const auto name_of = [](const auto& tested) {
  return std::get<0>(tested.param) + "_" + engine_name(std::get<1>(tested.param));
};
INSTANTIATE_TEST_SUITE_P(Scenes, EveryScene,
                         testing::Combine(testing::ValuesIn(scene_names()),
                                          testing::Values(EngineKind::md, EngineKind::cd)),
                         name_of);

TEST_P(EveryScene, SameBitsAfterARestart_restart) {
  const auto& [name, kind] = GetParam();
  ASSERT_TRUE(shortened().contains(name)) << "a new scene needs its line in the table above";
  const std::vector<Override>& changes = shortened().at(name);
  const Scene scene = read_scene((fs::path(GALET_SOURCE_DIR) / "scenes" / (name + ".toml")).string(), changes);
  if (scene.dimension == 2)
    check<2>(scene, kind, changes);
  else
    check<3>(scene, kind, changes);
}

}  // namespace
}  // namespace galet::test::scenes_restart_test
