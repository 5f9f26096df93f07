// The same bits for any number of threads, and however the steps are asked for.
#include <algorithm>

#include <gtest/gtest.h>

#include "common/core/instructions.hpp"
#include "common/core/parallel.hpp"
#include "tests/determinism/sheared.hpp"

namespace galet::test::determinism_test {
namespace {

template <int D>
void check_threads(EngineKind kind, double pressure, const RichLaw* law = nullptr) {
  SCOPED_TRACE(to_string(kind) + " D = " + std::to_string(D) + " pressure " + std::to_string(pressure));
  const ThreadCount restore_at_end;
  set_thread_count(1);
  const auto one = large_run<D>(kind, pressure, law);
  one->advance(large_steps(kind));
  set_thread_count(2);
  ASSERT_EQ(thread_count(), 2);
  const auto two = large_run<D>(kind, pressure, law);
  two->advance(large_steps(kind));
  EXPECT_EQ(hash_of<D>(*two), hash_of<D>(*one));
  // A run in which nothing touched would agree whatever the threads do.
  const Snapshot<D> state = one->snapshot();
  EXPECT_GE(state.grains(), 3000);
  EXPECT_GT(state.contacts->size(), static_cast<std::size_t>(state.grains() / 2));
}

TEST(determinism, ThreadsMd2D) {
  for (double pressure : {0.0, 1.0}) check_threads<2>(EngineKind::md, pressure);
}
TEST(determinism, ThreadsMd3D) { check_threads<3>(EngineKind::md, 1); }
TEST(determinism, ThreadsMdEveryLaw) {
  for (const RichLaw& law : rich_laws()) {
    SCOPED_TRACE(law.name);
    check_threads<2>(EngineKind::md, 1, &law);
    check_threads<3>(EngineKind::md, 1, &law);
  }
}
TEST(determinism, ThreadsCd2D) {
  check_threads<2>(EngineKind::cd, 1);
}  // rigid crystals can't shear at constant volume
TEST(determinism, ThreadsCd3D) { check_threads<3>(EngineKind::cd, 1); }

TEST(determinism, ThreadsAreReallyUsed) {
  // The guard of the tests above: work of this size is handed to two threads.
  const ThreadCount restore_at_end;
  set_thread_count(2);
  std::size_t first_end = 0, second_begin = 0;  // each written by one thread only
  parallel_ranges(3000, [&](std::size_t begin, std::size_t end) {
    if (begin == 0)
      first_end = end;
    else
      second_begin = begin;
  });
  EXPECT_GT(first_end, 0u);
  EXPECT_EQ(first_end, second_begin);
  EXPECT_LT(first_end, 3000u);
}

/// Engines made while it lives use the instruction set.
class Use {
 public:
  explicit Use(Instructions set) : before_(instructions()) { use_instructions(set); }
  ~Use() { use_instructions(before_); }
  Use(const Use&) = delete;
  Use& operator=(const Use&) = delete;

 private:
  Instructions before_;
};

/// The sets of this processor beyond the scalar one.
std::vector<Instructions> vector_instructions() {
  std::vector<Instructions> sets;
  for (const Instructions set : {Instructions::avx2, Instructions::avx512})
    if (has_instructions(set)) sets.push_back(set);
  return sets;
}

template <int D>
void check_instructions(const RichLaw* law = nullptr, EngineKind kind = EngineKind::md) {
  const auto run = [&](Instructions set) {
    const Use use(set);
    auto engine = small_run<D>(kind, law);
    engine->advance(kind == EngineKind::md ? 400 : 50);
    EXPECT_GT(engine->snapshot().contacts->size(), 10u);
    return hash_of<D>(*engine);
  };
  const auto expected = run(Instructions::scalar);
  for (const Instructions set : vector_instructions())
    EXPECT_EQ(run(set), expected) << "D = " << D << ' ' << to_string(set);
}

TEST(determinism, EveryInstructionSetGivesTheSameBits) {
  if (vector_instructions().empty()) GTEST_SKIP() << "this processor has only scalar kernels";
  check_instructions<2>(), check_instructions<3>();
  check_instructions<2>(nullptr, EngineKind::cd), check_instructions<3>(nullptr, EngineKind::cd);
  for (const RichLaw& law : rich_laws()) {
    SCOPED_TRACE(law.name);
    check_instructions<2>(&law), check_instructions<3>(&law);
  }
}

/// The same with planes, and without friction (a layout of its own).
TEST(determinism, EveryInstructionSetGivesTheSameBitsBetweenPlanes) {
  if (vector_instructions().empty()) GTEST_SKIP() << "this processor has only scalar kernels";
  for (double friction : {0.0, 0.4}) {
    const auto run = [&](Instructions set) {
      const Use use(set);
      Scene scene = periodic_scene(3, friction, 0.5, 1e3);
      scene.cell.periodic = {true, true, false};
      Sample<3> sample = crystal_sample<3>(3, 0.999);
      sample.cell.periodic = {true, true, false};
      shake<3>(sample, 0.5, 71, 0.5);
      const double height = sample.cell.box(2, 2);
      sample.planes = {{Vec<3>(0, 0, -0.3), Vec<3>::UnitZ(), Vec<3>(0.1, 0, 0)},
                       {Vec<3>(0, 0, height + 0.3), -Vec<3>::UnitZ(), Vec<3>::Zero()}};
      const auto engine = make_engine<3>(EngineKind::md, scene, sample);
      engine->advance(400);
      int at_planes = 0;
      for (const int j : engine->snapshot().contacts->j) at_planes += j >= sample.count();
      EXPECT_GT(at_planes, 0);
      return hash_of<3>(*engine);
    };
    const auto expected = run(Instructions::scalar);
    for (const Instructions set : vector_instructions())
      EXPECT_EQ(run(set), expected) << "mu = " << friction << ' ' << to_string(set);
  }
}

template <int D>
void check_slicing(EngineKind kind) {
  SCOPED_TRACE(to_string(kind) + " D = " + std::to_string(D));
  const auto whole = small_run<D>(kind);
  whole->advance(120);
  const auto sliced = small_run<D>(kind);
  for (long steps : {1, 1, 7, 31, 80}) {
    sliced->advance(steps);
    // Looking changes nothing.
    EXPECT_GT(sliced->snapshot().grains(), 0);
    EXPECT_GT(sliced->energy().total(), 0);
    (void)hash_of<D>(*sliced);
  }
  EXPECT_EQ(hash_of<D>(*sliced), hash_of<D>(*whole));
  EXPECT_EQ(sliced->steps(), 120);
  whole->advance(1);
  EXPECT_NE(hash_of<D>(*sliced), hash_of<D>(*whole));  // the hash sees a step
}

TEST(determinism, StepsMayBeAskedForInAnySlices) {
  for (EngineKind kind : both_engines) {
    check_slicing<2>(kind);
    check_slicing<3>(kind);
  }
}

}  // namespace
}  // namespace galet::test::determinism_test
