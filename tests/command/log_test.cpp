// What the program says at each level of its log.
#include <gtest/gtest.h>

#include "common/io/files.hpp"
#include "tests/command/program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace galet::test::log_test {
namespace {

constexpr const char* scene = R"(engine = "cd"
grains.count = 200
material = {friction = 0.4, restitution = 0.1}
initial = {kind = "gas", solid_fraction = 0.45}
loading = {kind = "plane_shear", pressure = 1, inertial_number = 0.2}
run = {duration = 10}
)";

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// Everything that a run with these arguments says; its output is no terminal.
std::string said(const std::vector<std::string>& more) {
  const TemporaryFolder folder;
  write_file(folder.file("scene.toml"), scene);
  std::vector<std::string> arguments = {"run", folder.file("scene.toml"), "--out", folder.file("out")};
  arguments.insert(arguments.end(), more.begin(), more.end());
  EXPECT_EQ(run_galet(arguments, folder.file("log")), 0);
  return read_file(folder.file("log"));
}

TEST(Log, WarningsOnly) { EXPECT_EQ(said({"--log", "warnings"}), ""); }

TEST(Log, ResultsAreTheDefault) {
  for (const std::vector<std::string>& arguments : {std::vector<std::string>{}, {"--log", "results"}}) {
    const std::string text = said(arguments);
    EXPECT_TRUE(has(text, "wrote ")) << text;
    EXPECT_FALSE(has(text, " left\n")) << text;
  }
}

TEST(Log, ProgressWithoutATerminal) {
  const std::string text = said({"--log", "progress"});
  EXPECT_TRUE(has(text, "wrote ")) << text;
  EXPECT_TRUE(has(text, " left\n")) << text;
}

TEST(Log, AnotherLevelIsRefused) {
  const TemporaryFolder folder;
  write_file(folder.file("scene.toml"), scene);
  EXPECT_EQ(run_galet({"run", folder.file("scene.toml"), "--log", "all"}, folder.file("log")), 2);
  EXPECT_TRUE(has(read_file(folder.file("log")), "--log")) << read_file(folder.file("log"));
}

}  // namespace
}  // namespace galet::test::log_test
