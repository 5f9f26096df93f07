// What md's arrays hold per grain and per listed pair: large samples are bound by memory, so that a column added by
// the way should not go unseen.
#include <gtest/gtest.h>

#include "common/scene/derive.hpp"
#include "md/engine.hpp"
#include "md/kernel/view.hpp"
#include "tests/support/scenes.hpp"

namespace galet::test::md_memory_test {
namespace {

/// What a step works on. Exact: derived from the layout, which the constants must add up to.
template <Layout Y>
constexpr std::size_t step_bytes_per_grain() {
  return sizeof(double) * (md::record_size(Y) + md::StateGroups<Y>::size) + sizeof(int) * md::slots_per_grain;
}
template <Layout Y>
constexpr std::size_t step_bytes_per_pair() {
  return sizeof(md::RowBlock) / md::block_rows + sizeof(double) * (md::RowColumns<Y>::count(false) + md::out_size(Y));
}

static_assert(step_bytes_per_grain<Layout{2, false}>() <= 164 && step_bytes_per_pair<Layout{2, false}>() <= 32);
static_assert(step_bytes_per_grain<Layout{2, true}>() <= 228 && step_bytes_per_pair<Layout{2, true}>() <= 56);
static_assert(step_bytes_per_grain<Layout{3, false}>() <= 164 && step_bytes_per_pair<Layout{3, false}>() <= 48);
static_assert(step_bytes_per_grain<Layout{3, true}>() <= 260 && step_bytes_per_pair<Layout{3, true}>() <= 88);
static_assert(step_bytes_per_grain<Layout{3, true, true}>() <= 292 &&
              step_bytes_per_pair<Layout{3, true, true}>() <= 152);

struct Bound {
  double per_grain, per_pair;  ///< bytes
};

/// A dense crystal at rest after a few steps. The bounds leave room for second buffers and for growth.
template <int D>
void expect_below(Layout layout, const Bound& bound) {
  SCOPED_TRACE(to_string(layout));
  const Sample<D> sample = test::crystal_sample<D>(D == 2 ? 40 : 10, 1.0);
  const Scene scene = test::periodic_scene(D, layout.friction ? 0.4 : 0, 0.3, 1e3);
  Derived derived = derive(scene, grain_facts<D>(scene, sample));
  derived.layout = layout;
  auto engine = md::make_engine<D>(scene, derived, sample);
  engine->advance(3);
  const MemoryUse memory = engine->memory();
  // Half of the neighbours: 6 in the triangular crystal, 12 in the face-centred cubic one.
  EXPECT_EQ(memory.listed, static_cast<std::size_t>(sample.count()) * (D == 2 ? 3 : 6));
  const double per_grain = static_cast<double>(memory.grains) / sample.count();
  const double per_pair = static_cast<double>(memory.pairs) / static_cast<double>(memory.listed);
  EXPECT_LE(per_grain, bound.per_grain);
  EXPECT_LE(per_pair, bound.per_pair);
  // An array that is left out of the account shows here: two buffers of rows and the list's five columns of pairs.
  const std::size_t least = layout == Layout{2, false}   ? step_bytes_per_pair<Layout{2, false}>()
                            : layout == Layout{2, true}  ? step_bytes_per_pair<Layout{2, true}>()
                            : layout == Layout{3, false} ? step_bytes_per_pair<Layout{3, false}>()
                            : layout == Layout{3, true}  ? step_bytes_per_pair<Layout{3, true}>()
                                                         : step_bytes_per_pair<Layout{3, true, true}>();
  EXPECT_GE(per_pair, 2.0 * static_cast<double>(least) + 5 * sizeof(int));
}

TEST(MdMemory, PerGrainAndPerListedPairIsBounded) {
  // Bytes per grain: what a step works on, the bodies and the list's reference positions and bins, times at most 1.5
  // where an array grows in steps. Per pair: twice the rows and the list's columns, times 1.5 likewise.
  expect_below<2>({2, false}, {600, 250});
  expect_below<2>({2, true}, {750, 350});
  expect_below<3>({3, false}, {700, 320});
  expect_below<3>({3, true}, {950, 600});
  expect_below<3>({3, true, true}, {1000, 850});
}

}  // namespace
}  // namespace galet::test::md_memory_test
