// Many damaged files: scenes with mistakes, checkpoints with flipped and missing bits. The seeds are fixed.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "common/core/error.hpp"
#include "common/io/checkpoint.hpp"
#include "src/simulation.hpp"
#include "tests/support/checkpoint_mutations.hpp"
#include "tests/support/scene_mutations.hpp"

namespace galet::test::mutation_test {
namespace {

TEST(Mutations, OfSceneFiles) {
  const std::vector<std::string> texts = scene_texts(std::filesystem::path(GALET_SOURCE_DIR) / "scenes");
  const MutationCounts counts = read_mutations(texts, 3000, 100000);
  for (const std::string& complaint : counts.complaints) ADD_FAILURE() << complaint;
  EXPECT_GT(counts.read, 10000);
  EXPECT_GT(counts.refused, 10000);
  EXPECT_LT(counts.slowest, 1) << counts.slowest_text;
  fmt::print("{} read, {} refused, slowest {:.1f} ms\n", counts.read, counts.refused, 1e3 * counts.slowest);
}

TEST(Mutations, OfCheckpoints) {
  const DamageCounts counts = read_damaged_checkpoints(0, 10000);
  for (const std::string& complaint : counts.complaints) ADD_FAILURE() << complaint;
  EXPECT_EQ(counts.refused + counts.same, 10000);
  EXPECT_GT(counts.refused, 9900);
  fmt::print("{} refused, {} with the same bits\n", counts.refused, counts.same);
}

}  // namespace
}  // namespace galet::test::mutation_test
