// Pieces of work side by side: each is done once, the costliest first, and an exception comes back.
#include "src/side_by_side.hpp"

#include <atomic>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

namespace galet::test::side_by_side_test {
namespace {

TEST(SideBySide, EachPieceOnceTheCostliestFirst) {
  std::vector<std::size_t> order;
  run_side_by_side({}, {1, 5, 3, 5}, [&](std::size_t k, const WorkControl&) { order.push_back(k); });
  EXPECT_EQ(order, (std::vector<std::size_t>{1, 3, 2, 0}));
  std::atomic<int> sum = 0;
  SideBySideOptions options;
  options.jobs = 3;
  run_side_by_side(options, std::vector<double>(20, 1),
                   [&](std::size_t k, const WorkControl&) { sum += static_cast<int>(k); });
  EXPECT_EQ(sum, 190);
  run_side_by_side(options, {}, [](std::size_t, const WorkControl&) { FAIL(); });
}

TEST(SideBySide, AnExceptionStopsTheOthersAndComesBack) {
  int stopped = 0;
  const auto work = [&](std::size_t k, const WorkControl& control) {
    if (k == 0) throw std::runtime_error("piece 0");
    stopped += control.stop() ? 1 : 0;
  };
  EXPECT_THROW(run_side_by_side({}, {3, 2, 1}, work), std::runtime_error);
  EXPECT_EQ(stopped, 2);
}

TEST(SideBySide, TellsTheShareOfTheWholeWork) {
  SideBySideOptions options;
  std::vector<double> shares;
  options.progress = [&](double share, double) { shares.push_back(share); };
  run_side_by_side(options, {3, 1}, [](std::size_t k, const WorkControl& control) {
    if (k == 0) control.progress(0.5);
  });
  ASSERT_FALSE(shares.empty());
  EXPECT_DOUBLE_EQ(shares.front(), 0.5 * 3 / 4);  // what comes within a fifth of a second may be left out
}

}  // namespace
}  // namespace galet::test::side_by_side_test
