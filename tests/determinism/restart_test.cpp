// A run that is stopped, saved and taken up again by a fresh engine has the same bits as one that is not.
#include <filesystem>

#include <gtest/gtest.h>

#include "common/io/checkpoint.hpp"
#include "tests/determinism/sheared.hpp"

namespace galet::test::restart_test {
namespace {

template <int D>
void check(EngineKind kind, const std::function<std::unique_ptr<Engine<D>>()>& start, long steps) {
  SCOPED_TRACE(to_string(kind) + " D = " + std::to_string(D));
  const auto whole = start();
  whole->advance(2 * steps);

  const auto first = start();
  first->advance(steps);
  Archive archive;
  first->save(archive);
  const auto second = start();
  second->restore(archive);
  EXPECT_EQ(hash_of<D>(*second), hash_of<D>(*first));  // nothing is lost on the way
  EXPECT_EQ(second->steps(), steps);
  EXPECT_EQ(second->time(), first->time());
  second->advance(steps);
  EXPECT_EQ(hash_of<D>(*second), hash_of<D>(*whole));
  EXPECT_EQ(second->steps(), 2 * steps);
  // An engine that has been somewhere else may be restored, too.
  second->restore(archive);
  second->advance(steps);
  EXPECT_EQ(hash_of<D>(*second), hash_of<D>(*whole));
}

template <int D>
void check_small(EngineKind kind) {
  // Odd numbers of steps, and long enough for the neighbour lists to be rebuilt on both sides of the restart.
  for (long steps : {1, 37, 201})
    check<D>(
        kind, [&] { return small_run<D>(kind); }, steps);
}

TEST(restart, Md) {
  check_small<2>(EngineKind::md);
  check_small<3>(EngineKind::md);
}
TEST(restart, Cd) {
  check_small<2>(EngineKind::cd);
  check_small<3>(EngineKind::cd);
}

template <int D>
void check_law(const RichLaw& law) {
  for (long steps : {1, 37, 201})
    check<D>(
        EngineKind::md, [&] { return small_run<D>(EngineKind::md, &law); }, steps);
}

TEST(restart, MdEveryLaw) {
  for (const RichLaw& law : rich_laws()) {
    SCOPED_TRACE(law.name);
    check_law<2>(law);
    check_law<3>(law);
  }
}

/// Relaxers and the account of energy, under a pressure.
template <int D>
void check_relaxers() {
  check<D>(
      EngineKind::md,
      [] {
        Scene scene = periodic_scene(D, 0.4, 0.3, 1e3);
        scene.loading.kind = LoadingKind::isotropic;
        scene.loading.pressure = 1;
        scene.md.drag = 0.5;
        scene.md.acceleration_damping = 0.2;
        scene.md.energy_budget = true;
        return make_engine<D>(EngineKind::md, scene, sheared_sample<D>(D == 2 ? 5 : 3));
      },
      150);
}

TEST(restart, MdWithRelaxers) {
  check_relaxers<2>();
  check_relaxers<3>();
}

TEST(restart, WithTwoThreads) {
  const ThreadCount restore_at_end;
  set_thread_count(2);
  check<2>(
      EngineKind::md, [] { return large_run<2>(EngineKind::md, 1); }, 20);
  check<3>(
      EngineKind::md, [] { return large_run<3>(EngineKind::md, 1); }, 20);
  check<2>(
      EngineKind::cd, [] { return large_run<2>(EngineKind::cd, 1); }, 2);
}

TEST(restart, UnderGravityWithAPlaneThatMoves) {
  for (EngineKind kind : both_engines) {
    Scene scene = free_scene(2, 0.3, 0.5, 1e4);
    scene.loading.gravity = {0.1, -1};
    scene.cd.dt = 1e-3;
    Sample<2> sample = column_sample<2>(4);
    sample.planes[0].velocity = Vec<2>(0, 0.05);
    sample.velocity[3] = Vec<2>(0.2, -0.3);
    check<2>(
        kind, [&] { return make_engine<2>(kind, scene, sample); }, 150);
  }
}

TEST(restart, ThroughACheckpointFile) {
  const std::string file = (std::filesystem::temp_directory_path() / "galet_restart_test.h5").string();
  for (EngineKind kind : both_engines) {
    SCOPED_TRACE(to_string(kind));
    const auto whole = small_run<2>(kind);
    whole->advance(100);
    const auto first = small_run<2>(kind);
    first->advance(50);
    Archive written;
    first->save(written);
    write_checkpoint(file, written);
    const Archive read = read_checkpoint(file);
    EXPECT_EQ(read.reals, written.reals);
    EXPECT_EQ(read.integers, written.integers);
    const auto second = small_run<2>(kind);
    second->restore(read);
    second->advance(50);
    EXPECT_EQ(hash_of<2>(*second), hash_of<2>(*whole));
  }
  std::filesystem::remove(file);
}

}  // namespace
}  // namespace galet::test::restart_test
