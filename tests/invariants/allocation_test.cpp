// A step in steady state allocates no memory, list rebuilds included.
#include <gtest/gtest.h>

#include "tests/support/laws.hpp"
#include "tests/support/limit_alloc.hpp"
#include "tests/support/sanitized.hpp"
#include "tests/support/scenes.hpp"

namespace galet::test::allocation_test {
namespace {

TEST(Allocation, IsCounted) {
  const AllocationCount count;
  auto* some = new std::vector<double>(100);
  const long seen = count.count();
  delete some;
  EXPECT_EQ(seen, 2);
}

/// A crystal that shakes in its place: its contacts open and close, but the number of neighbours stays what it is, so
/// that no column has a reason to grow after the start.
template <int D>
void check(EngineKind kind, double friction, const RichLaw* law = nullptr) {
  SCOPED_TRACE(to_string(kind) + " D = " + std::to_string(D) + " mu = " + std::to_string(friction));
  Scene scene = periodic_scene(D, friction, 1, 1e3);
  scene.cd.dt = 1e-2;
  Sample<D> sample = crystal_sample<D>(D == 2 ? 6 : 3, 1.1);
  shake<D>(sample, 0.5, 41, 0.5);
  if (law) {
    law->change(scene);
    mix_materials<D>(scene, sample);
  }
  const auto engine = make_engine<D>(kind, scene, sample);
  engine->advance(sanitized ? 400 : 1000);  // columns reach their size within a few list builds
  const AllocationCount count;
  engine->advance(300);  // moves grains by several skins: the list is built anew
  EXPECT_EQ(count.count(), 0);
}

TEST(Allocation, NoneInSteadyState) {
  for (EngineKind kind : both_engines)
    for (double friction : {0.0, 0.4}) {
      check<2>(kind, friction);
      check<3>(kind, friction);
    }
}

TEST(Allocation, NoneWithAnyLawOfMd) {
  for (const RichLaw& law : rich_laws()) {
    SCOPED_TRACE(law.name);
    check<2>(EngineKind::md, 0.4, &law);
    check<3>(EngineKind::md, 0.4, &law);
  }
}

}  // namespace
}  // namespace galet::test::allocation_test
