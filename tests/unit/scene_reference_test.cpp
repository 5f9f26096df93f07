// The field table and the reference made from it.
#include <set>

#include <gtest/gtest.h>

#include "common/io/files.hpp"
#include "common/io/scene_fields.hpp"
#include "common/io/scene_file.hpp"

namespace galet::test::scene_reference_test {
namespace {

TEST(SceneReference, HasARowForEveryField) {
  const std::string text = scene_reference();
  std::size_t rows = 0;
  for (std::size_t at = text.find("\n| `"); at != std::string::npos; at = text.find("\n| `", at + 1)) ++rows;
  EXPECT_EQ(rows, scene_fields().size());
  for (const SceneField& field : scene_fields()) {
    SCOPED_TRACE(field.path);
    const std::string section(parent_path(field.path));
    const std::string title = section.empty() ? "\n## Top of the file\n" : "\n## `" + table_name(section) + "`\n";
    const auto begin = text.find(title);
    ASSERT_NE(begin, std::string::npos);
    const std::string body = text.substr(begin, text.find("\n## ", begin + 1) - begin);
    EXPECT_NE(body.find("| `" + std::string(last_key(field.path)) + "` |"), std::string::npos);
    EXPECT_NE(body.find(field.doc.substr(0, field.doc.find('|'))), std::string::npos);
  }
}

TEST(SceneReference, IsTheOneInTheDocumentation) {
  const std::string text = scene_reference();
  if (read_file(GALET_SOURCE_DIR "/docs/scene_reference.md") == text) return;
  const std::string path = testing::TempDir() + "scene_reference.md";
  write_file(path, text);
  FAIL() << "docs/scene_reference.md is out of date; replace it by " << path;
}

TEST(SceneFields, AreNamedOnceAndLieInASection) {
  std::set<std::string> paths;
  for (const SceneField& field : scene_fields()) {
    SCOPED_TRACE(field.path);
    EXPECT_TRUE(paths.insert(field.path).second);
    EXPECT_NE(find_section(parent_path(field.path)), nullptr);
    EXPECT_FALSE(field.doc.empty());
    EXPECT_FALSE(default_text(field).empty());
  }
}

}  // namespace
}  // namespace galet::test::scene_reference_test
