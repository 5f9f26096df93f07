// The same bits for any number of threads and across a restart, with every term of cd's laws.
#include <gtest/gtest.h>

#include "tests/determinism/sheared.hpp"
#include "tests/support/rigid_laws.hpp"

namespace galet::test::cd_laws_test {
namespace {

template <int D>
void check_restart(const RichLaw& law) {
  SCOPED_TRACE(law.name + ", D = " + std::to_string(D));
  for (long steps : {1, 37}) {
    const auto whole = small_run<D>(EngineKind::cd, &law);
    whole->advance(2 * steps);
    const auto first = small_run<D>(EngineKind::cd, &law);
    first->advance(steps);
    Archive archive;
    first->save(archive);
    const auto second = small_run<D>(EngineKind::cd, &law);
    second->restore(archive);
    EXPECT_EQ(hash_of<D>(*second), hash_of<D>(*first));
    // What a restored engine shows is what the other one showed.
    EXPECT_EQ(second->snapshot().contacts->force, first->snapshot().contacts->force);
    second->advance(steps);
    EXPECT_EQ(hash_of<D>(*second), hash_of<D>(*whole));
  }
}

TEST(restart, CdEveryLaw) {
  for (const RichLaw& law : rich_rigid_laws()) {
    check_restart<2>(law);
    check_restart<3>(law);
  }
}

TEST(restart, CdWithAFreePlaneAndDividedSteps) {
  Scene scene = free_scene(2, 0.3, 0.5, 1e4);
  scene.cd.dt = 2e-2;
  Sample<2> sample = column_sample<2>(3);
  Plane<2> piston;
  piston.normal = Vec<2>(0, -1);
  piston.point = sample.position[2] + Vec<2>(0, 0.6);
  piston.inverse_mass = 2;
  piston.force = 1;
  sample.planes.push_back(piston);
  sample.velocity[1] = Vec<2>(9, 20);  // fast enough for steps to be taken in parts
  const auto run = [&] { return make_engine<2>(EngineKind::cd, scene, sample); };
  const auto whole = run(), first = run(), second = run();
  whole->advance(60);
  EXPECT_GT(whole->solver_summary().divided, 0);
  first->advance(1);
  Archive archive;
  first->save(archive);
  second->restore(archive);
  second->advance(59);
  EXPECT_EQ(hash_of<2>(*second), hash_of<2>(*whole));
}

template <int D>
void check_threads(const RichLaw& law) {
  SCOPED_TRACE(law.name + ", D = " + std::to_string(D));
  const ThreadCount restore_at_end;
  set_thread_count(1);
  const auto one = large_run<D>(EngineKind::cd, 1, &law);
  const long steps = sanitized ? 1 : 2;
  one->advance(steps);
  set_thread_count(2);
  const auto two = large_run<D>(EngineKind::cd, 1, &law);
  two->advance(steps);
  EXPECT_EQ(hash_of<D>(*two), hash_of<D>(*one));
  EXPECT_GT(one->snapshot().contacts->size(), static_cast<std::size_t>(one->snapshot().grains() / 2));
}

TEST(determinism, ThreadsCdEveryLaw) {
  for (const RichLaw& law : rich_rigid_laws()) {
    check_threads<2>(law);
    check_threads<3>(law);
  }
}

}  // namespace
}  // namespace galet::test::cd_laws_test
