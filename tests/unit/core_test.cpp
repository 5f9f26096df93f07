// Random streams, threads, hash, columns, errors.
#include <cmath>
#include <cstring>
#include <set>

#include <gtest/gtest.h>

#include "common/core/archive.hpp"
#include "common/core/column.hpp"
#include "common/core/error.hpp"
#include "common/core/parallel.hpp"
#include "common/core/random.hpp"

namespace galet::test::core_test {
namespace {

// Known answers of Philox 4x32-10, published with its reference implementation (Salmon et al. 2011).
TEST(Random, PhiloxGivesThePublishedNumbers) {
  using Block = std::array<std::uint32_t, 4>;
  EXPECT_EQ(philox({0, 0, 0, 0}, {0, 0}), (Block{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}));
  constexpr std::uint32_t all = 0xffffffff;
  EXPECT_EQ(philox({all, all, all, all}, {all, all}), (Block{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}));
  EXPECT_EQ(philox({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, {0xa4093822, 0x299f31d0}),
            (Block{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}));
}

TEST(Random, MomentsOfUniformAndNormal) {
  constexpr int count = 200000;
  double sum = 0, sum2 = 0, normal = 0, normal2 = 0, normal4 = 0;
  RandomStream stream(7, 3);
  for (int k = 0; k < count; ++k) {
    const double u = stream.uniform(), z = stream.normal();
    ASSERT_GE(u, 0);
    ASSERT_LT(u, 1);
    sum += u, sum2 += u * u, normal += z, normal2 += z * z, normal4 += z * z * z * z;
  }
  // Tolerances: five standard errors of each mean.
  const double root = std::sqrt(static_cast<double>(count));
  EXPECT_NEAR(sum / count, 0.5, 5 * std::sqrt(1.0 / 12) / root);
  EXPECT_NEAR(sum2 / count, 1.0 / 3, 5 * std::sqrt(4.0 / 45) / root);
  EXPECT_NEAR(normal / count, 0, 5 / root);
  EXPECT_NEAR(normal2 / count, 1, 5 * std::sqrt(2.0) / root);
  EXPECT_NEAR(normal4 / count, 3, 5 * std::sqrt(96.0) / root);
}

TEST(Random, StreamsDifferBySeedAndStream) {
  std::set<double> first;
  for (std::uint64_t seed = 0; seed < 10; ++seed)
    for (std::uint64_t stream = 0; stream < 10; ++stream) first.insert(RandomStream(seed, stream).uniform());
  EXPECT_EQ(first.size(), 100u);
}

TEST(Parallel, RangesCoverEveryIndexOnceForAnyNumberOfThreads) {
  for (int threads = 1; threads <= 4; ++threads) {
    set_thread_count(threads);
    std::vector<int> visits(10007, 0);
    parallel_ranges(
        visits.size(),
        [&](std::size_t begin, std::size_t end) {
          for (std::size_t k = begin; k < end; ++k) ++visits[k];
        },
        1);
    for (int count : visits) ASSERT_EQ(count, 1);
    std::vector<std::pair<std::size_t, std::size_t>> chunks(chunk_count(visits.size()));
    parallel_chunks(visits.size(), [&](std::size_t chunk, std::size_t begin, std::size_t end) {
      chunks[chunk] = {begin, end};
    });
    // The cut into chunks does not depend on the number of threads.
    for (std::size_t chunk = 0; chunk < chunks.size(); ++chunk) {
      ASSERT_EQ(chunks[chunk].first, chunk * chunk_size);
      ASSERT_EQ(chunks[chunk].second, std::min(visits.size(), (chunk + 1) * chunk_size));
    }
  }
  set_thread_count(1);
  EXPECT_THROW(set_thread_count(0), std::invalid_argument);
}

TEST(Archive, HashSeesEveryBitAndName) {
  Archive archive;
  archive.reals["x"] = {1.0, 0.0};
  archive.integers["n"] = {3};
  const std::uint64_t reference = state_hash(archive);
  Archive other = archive;
  EXPECT_EQ(state_hash(other), reference);
  other.reals["x"][1] = -0.0;
  EXPECT_NE(state_hash(other), reference);
  other = archive;
  other.integers["n"][0] = 4;
  EXPECT_NE(state_hash(other), reference);
  other = archive;
  other.reals["y"] = other.reals["x"];
  other.reals.erase("x");
  EXPECT_NE(state_hash(other), reference);
  other = archive;
  other.texts["title"] = "a title is no state";
  EXPECT_EQ(state_hash(other), reference);
  EXPECT_THROW(real_column(archive, "z"), InputError);
  EXPECT_THROW(integer_column(archive, "x"), InputError);
}

TEST(Column, AnAbsentColumnTakesNoSpace) {
  struct WithAbsent {
    double value;
    [[no_unique_address]] Column<double, false> absent;
  };
  EXPECT_EQ(sizeof(WithAbsent), sizeof(double));
}

TEST(Error, MessagesCarryTheirPlace) {
  EXPECT_EQ(to_string(Mistake{"a.toml", 3, 7, "no"}), "a.toml:3:7: error: no");
  EXPECT_EQ(to_string(Mistake{"a.toml", 0, 0, "no"}), "a.toml: error: no");
  EXPECT_EQ(to_string(Mistake{"", 0, 0, "no"}), "error: no");
  const InputError both(std::vector<Mistake>{{"a", 1, 1, "x"}, {"a", 2, 1, "y"}});
  EXPECT_STREQ(both.what(), "a:1:1: error: x\na:2:1: error: y");
}

}  // namespace
}  // namespace galet::test::core_test
