// Pictures of spheres by VTK, where it is installed.
#include "src/render.hpp"

#include <array>
#include <cstdlib>

#include <gtest/gtest.h>

#include "common/core/error.hpp"
#include "common/io/files.hpp"
#include "tests/support/lattices.hpp"
#include "tests/support/temporary_folder.hpp"

namespace galet::test::render_test {
namespace {

struct State {
  Sample<3> sample = test::face_centred(2);
  ContactColumns<3> contacts = test::touching<3>(sample);
  State() {
    for (int i = 0; i < sample.count(); ++i) sample.velocity[i] = Vec<3>(0.01 * i, 0, 0);
  }
  Snapshot<3> snapshot() const { return test::snapshot_of(sample, contacts); }
};

/// Width and height that a PNG file says it has.
std::array<unsigned, 2> size_of(const std::string& png) {
  const auto number = [&](std::size_t at) {
    unsigned value = 0;
    for (std::size_t k = at; k < at + 4; ++k) value = value << 8 | static_cast<unsigned char>(png.at(k));
    return value;
  };
  return {number(16), number(20)};
}

TEST(Render, SpheresAndForceChains) {
  const State state;
  const test::TemporaryFolder folder;
  const std::string speed = folder.file("speed.png"), coordination = folder.file("coordination.png");
  const std::string missing = render_spheres(speed, state.snapshot(), {"a crystal", GrainColour::speed, 800});
  if (!missing.empty()) {
    EXPECT_EQ(folder.entries(), 0);
    GTEST_SKIP() << missing;
  }
  ASSERT_EQ(render_spheres(coordination, state.snapshot(), {"a crystal", GrainColour::coordination, 800}), "");
  const std::string first = read_file(speed), second = read_file(coordination);
  EXPECT_TRUE(first.starts_with("\x89PNG"));
  EXPECT_EQ(size_of(first), (std::array<unsigned, 2>{800, 450}));
  EXPECT_GT(first.size(), 20000u) << "an empty picture packs into far less";
  EXPECT_NE(first, second) << "speeds differ from grain to grain, numbers of contacts don't";
  // Grains without contacts are drawn, too.
  const ContactColumns<3> none;
  EXPECT_EQ(render_spheres(speed, test::snapshot_of(state.sample, none), {"a gas"}), "");
  EXPECT_EQ(size_of(read_file(speed)), (std::array<unsigned, 2>{1600, 900}));
}

TEST(Render, SaysWhereItLookedForItsScript) {
  const State state;
  const test::TemporaryFolder folder;
  ::setenv("GALET_DATA", folder.path().c_str(), 1);
  std::string message;
  try {
    render_spheres(folder.file("a.png"), state.snapshot(), {});
  } catch (const RunError& error) {
    message = error.what();
  }
  ::unsetenv("GALET_DATA");
  EXPECT_NE(message.find(folder.file("render.py")), std::string::npos) << message;
  EXPECT_THROW(render_spheres(folder.file("a.png"), state.snapshot(), {"", GrainColour::speed, 10}),
               std::invalid_argument);
}

}  // namespace
}  // namespace galet::test::render_test
