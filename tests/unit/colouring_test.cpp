#include "common/graph/colouring.hpp"

#include <algorithm>
#include <set>

#include <gtest/gtest.h>

#include "common/core/random.hpp"

namespace galet::test::colouring_test {
namespace {

/// Every contact once, no body twice in a colour (bodies >= movable and the overflow group excepted).
void expect_proper(const Colouring& colouring, const std::vector<int>& i, const std::vector<int>& j, int movable) {
  std::vector<int> order = colouring.order;
  std::sort(order.begin(), order.end());
  for (std::size_t k = 0; k < order.size(); ++k) ASSERT_EQ(order[k], static_cast<int>(k));
  ASSERT_EQ(colouring.start.front(), 0);
  ASSERT_EQ(colouring.start.back(), static_cast<int>(i.size()));
  const int checked = colouring.colours() - (colouring.overflow ? 1 : 0);
  for (int colour = 0; colour < checked; ++colour) {
    std::set<int> seen;
    for (int k = colouring.start[colour]; k < colouring.start[colour + 1]; ++k) {
      const int contact = colouring.order[k];
      const bool ascending = k == colouring.start[colour] || colouring.order[k - 1] < contact;
      ASSERT_TRUE(ascending);
      ASSERT_TRUE(i[contact] >= movable || seen.insert(i[contact]).second);
      ASSERT_TRUE(j[contact] >= movable || seen.insert(j[contact]).second);
    }
  }
}

TEST(Colouring, RandomGraphsAreProperlyColoured) {
  for (int trial = 0; trial < 50; ++trial) {
    RandomStream stream(trial, 0);
    const int bodies = 2 + static_cast<int>(stream.uniform(0, 60));
    std::vector<int> i, j;
    for (int k = 0; k < 4 * bodies; ++k) {
      const int a = static_cast<int>(stream.uniform(0, bodies)), b = static_cast<int>(stream.uniform(0, bodies));
      if (a == b) continue;
      i.push_back(std::min(a, b)), j.push_back(std::max(a, b));
    }
    Colouring colouring;
    colouring.colour(i, j, bodies);
    expect_proper(colouring, i, j, bodies);
    EXPECT_FALSE(colouring.overflow);
  }
}

TEST(Colouring, ImmovableBodiesAreShared) {
  // 100 grains on one plane (body 100): one colour.
  std::vector<int> i(100), j(100, 100);
  for (int k = 0; k < 100; ++k) i[k] = k;
  Colouring colouring;
  colouring.colour(i, j, 100);
  EXPECT_EQ(colouring.colours(), 1);
}

TEST(Colouring, ABodyWithTooManyContactsOverflows) {
  // A star: the centre touches 100 others; 64 find a colour of their own, the rest are sequential.
  std::vector<int> i(100, 0), j(100);
  for (int k = 0; k < 100; ++k) j[k] = k + 1;
  Colouring colouring;
  colouring.colour(i, j, 101);
  EXPECT_TRUE(colouring.overflow);
  EXPECT_EQ(colouring.colours(), Colouring::most_colours + 1);
  EXPECT_EQ(colouring.start[64 + 1] - colouring.start[64], 36);
  expect_proper(colouring, i, j, 101);
}

TEST(Colouring, NoContacts) {
  Colouring colouring;
  colouring.colour({}, {}, 5);
  EXPECT_EQ(colouring.colours(), 0);
  EXPECT_FALSE(colouring.overflow);
}

}  // namespace
}  // namespace galet::test::colouring_test
