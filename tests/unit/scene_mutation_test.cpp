// Scene files with random mistakes (some thousands; tests/long reads 1e5).
#include <gtest/gtest.h>

#include "tests/support/scene_mutations.hpp"

namespace galet::test::scene_mutation_test {
namespace {

// The comparison of a scene with its text finds what it should, so that "no differences" means something.
TEST(SceneMutations, TheOracleSeesADefaultInPlaceOfAValue) {
  const std::string text =
      "grains = {count = 10, diameter = 2.0}\nmaterial = {restitution = 0.5, normal_stiffness = 1e4}\n"
      "run.duration = 1\nloading = {kind = \"drives\"}\noutput.measures = [\"fabric\"]\n"
      "[[drive]]\ncomponent = \"xy\"\nrate = 0.5\n";
  const Scene scene = parse_scene(text, "test.toml");
  EXPECT_TRUE(differences(text, scene).empty());
  const auto changed = [&](auto change) {
    Scene other = scene;
    change(other);
    return differences(text, other).size();
  };
  EXPECT_EQ(changed([](Scene& s) { s.grains.count = 11; }), 1u);
  EXPECT_EQ(changed([](Scene& s) { s.material.normal_stiffness.reset(); }), 1u);
  EXPECT_EQ(changed([](Scene& s) { s.loading.kind = LoadingKind::none; }), 1u);
  EXPECT_EQ(changed([](Scene& s) { s.output.measures.clear(); }), 1u);
  EXPECT_EQ(changed([](Scene& s) { s.loading.drives.back().rate = 0.25; }), 1u);
}

TEST(SceneMutations, AreRefusedOrReadAsWritten) {
  const std::vector<std::string> texts = scene_texts(std::filesystem::path(GALET_SOURCE_DIR) / "scenes");
  ASSERT_GE(texts.size(), 5u);
  for (const std::string& text : texts) EXPECT_TRUE(differences(text, parse_scene(text, "scene.toml")).empty());
  const MutationCounts counts = read_mutations(texts, 0, 3000);
  for (const std::string& complaint : counts.complaints) ADD_FAILURE() << complaint;
  // Both sides are reached, or the mutations are too wild, or too tame.
  EXPECT_GT(counts.read, 300);
  EXPECT_GT(counts.refused, 300);
  EXPECT_LT(counts.slowest, 1) << counts.slowest_text;  // milliseconds, of which debug builds make tens
}

}  // namespace
}  // namespace galet::test::scene_mutation_test
