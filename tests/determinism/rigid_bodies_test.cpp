// Scenes with rigid bodies: the same bits for any number of threads and across a restart.
#include "tests/support/rigid_bodies.hpp"

#include <gtest/gtest.h>

#include "tests/determinism/sheared.hpp"

namespace galet::test::rigid_bodies_test {
namespace {

/// A gas of clumps that collides, with a torque on one of them and a rotor.
template <int D>
std::unique_ptr<Engine<D>> clump_run(EngineKind kind, int side, bool rolling, double stepping = 1) {
  auto [scene, sample] = clump_gas<D>(side, 4, 71);
  if (rolling) resist_rolling(scene);
  scene.bodies[0].torque.assign(D == 2 ? 1 : 3, 0.3);
  scene.bodies[1].free_rotation.clear();
  scene.bodies[1].free.clear();
  scene.cd.dt = 4e-3 * stepping;
  scene.cd.max_sweeps = 40;
  return make_engine<D>(kind, scene, sample);
}

template <int D>
void check_threads(EngineKind kind, bool rolling, const std::vector<int>& counts, int looks) {
  SCOPED_TRACE(to_string(kind) + " D = " + std::to_string(D) + (rolling ? ", rolling resistance" : ""));
  const ThreadCount restored;
  std::uint64_t expected = 0;
  for (const int threads : counts) {
    set_thread_count(threads);
    const auto engine = clump_run<D>(kind, D == 2 ? 30 : 9, rolling, 2);
    std::size_t contacts = 0;
    for (int look = 0; look < looks; ++look) {
      engine->advance(kind == EngineKind::md ? 200 : 12);
      contacts += engine->snapshot().contacts->size();
    }
    EXPECT_GT(contacts, 30u);
    if (threads == 1)
      expected = hash_of<D>(*engine);
    else
      EXPECT_EQ(hash_of<D>(*engine), expected) << threads << " threads";
  }
}

TEST(determinism, RigidBodies) {
  const std::vector<int> counts = sanitized ? std::vector{1, 2} : std::vector{1, 2, 4};
  for (EngineKind kind : both_engines)
    check_threads<2>(kind, false, counts, 5), check_threads<3>(kind, false, counts, 5);
  // Rolling resistance makes another contact problem of cd, a dear one; md gives its torques to bodies as it gives
  // forces.
  check_threads<2>(EngineKind::cd, true, {1, 2}, 1), check_threads<3>(EngineKind::cd, true, {1, 2}, 5);
}

template <int D>
void check_restart(EngineKind kind, bool rolling) {
  for (long steps : {1, 37, sanitized ? 101 : 301}) {
    SCOPED_TRACE(to_string(kind) + " D = " + std::to_string(D) + (rolling ? ", rolling resistance, " : ", ") +
                 std::to_string(steps) + " steps");
    const auto start = [&] { return clump_run<D>(kind, D == 2 ? 5 : 3, rolling); };
    const auto whole = start(), first = start(), second = start();
    whole->advance(2 * steps);
    first->advance(steps);
    Archive archive;
    first->save(archive);
    second->restore(archive);
    EXPECT_EQ(hash_of<D>(*second), hash_of<D>(*first));
    second->advance(steps);
    EXPECT_EQ(hash_of<D>(*second), hash_of<D>(*whole));
  }
}

TEST(restart, RigidBodies) {
  for (EngineKind kind : both_engines)
    for (const bool rolling : {false, true}) check_restart<2>(kind, rolling), check_restart<3>(kind, rolling);
}

}  // namespace
}  // namespace galet::test::rigid_bodies_test
