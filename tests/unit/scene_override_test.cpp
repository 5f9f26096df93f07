// Changes of a scene from the command line: --set path=value.
#include <gtest/gtest.h>

#include "tests/unit/scene_mistakes.hpp"

namespace galet::test::scene_override_test {
namespace {

using Reals = std::vector<double>;

TEST(SceneOverride, ReplacesAddsAndCreatesTables) {
  const Scene scene = parse_scene(sound, "s",
                                  {{"grains.count", "33"},
                                   {"material.friction", "0.25"},
                                   {"title", "two words"},
                                   {"engine", "cd"},
                                   {"cell.aspect", "[1, 3]"},
                                   {"grains.diameter", "{distribution = \"uniform\", spread = 0.1}"}});
  EXPECT_EQ(scene.grains.count, 33);
  EXPECT_EQ(scene.material.friction, 0.25);
  EXPECT_EQ(scene.title, "two words");
  EXPECT_EQ(scene.engine, EngineKind::cd);
  EXPECT_EQ(scene.cell.aspect, (Reals{1, 3}));
  EXPECT_EQ(scene.grains.diameter.spread, 0.1);
  EXPECT_EQ(scene.source, sound);
}

const std::string two_planes = R"(material = {restitution = 0.5, normal_stiffness = 1e4}
cell = {periodic = [true, false], size = [10, 20]}
run.duration = 2
[[plane]]
point = [0, 1]
normal = [0, 2]
[[plane]]
point = [0, 19]
normal = [0, -1]
[[grain]]
position = [1, 2]
[[grain]]
position = [5, 5]
)";

TEST(SceneOverride, ReachesEntriesOfLists) {
  const Scene scene = parse_scene(two_planes, "s", {{"grain[1].diameter", "2"}, {"plane[0].velocity", "[3, 0]"}});
  EXPECT_EQ(scene.grains.listed[1].diameter, 2);
  EXPECT_EQ(scene.planes[0].velocity, (Reals{3, 0}));
}

TEST(SceneOverride, TakesTheLastOfTwo) {
  EXPECT_EQ(parse_scene(sound, "s", {{"grains.count", "5"}, {"grains.count", "6"}}).grains.count, 6);
}

TEST(SceneOverride, RepairsAMistakeOfTheFile) {
  EXPECT_EQ(parse_scene(sound + "material.friction = -1\n", "s", {{"material.friction", "1"}}).material.friction, 1);
}

TEST(SceneOverride, TakesValuesWithUnits) {
  const std::string si = "units = \"SI\"\ngrains.diameter = 1e-3\ngrains.mass = 1\n";
  EXPECT_EQ(parse_scene(sound + si, "s", {{"grains.mass", "2 g"}}).grains.mass, 0.002);
}

/// The message of one bad override of the sound scene.
std::string override_message(const std::string& path, const std::string& value) {
  try {
    parse_scene(sound, "s", {{path, value}});
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(SceneOverride, PlacesItsMistakesAtTheOption) {
  EXPECT_EQ(override_message("grains.count", "many"),
            "--set grains.count=many: error: grains.count: expected a whole number >= 1, got \"many\"");
  EXPECT_EQ(override_message("grains.cuont", "5"),
            "--set grains.cuont=5: error: unknown name \"cuont\" in [grains]; did you mean \"count\"?");
  EXPECT_EQ(override_message("run.strain", "5"),
            "--set run.strain=5: error: run.duration and run.strain exclude each other\n"
            "--set run.strain=5: error: run.strain needs a loading that imposes a rate");
}

TEST(SceneOverride, RefusesPathsThatLeadNowhere) {
  EXPECT_EQ(override_message("grains.count.x", "5"), "--set grains.count.x=5: error: no \"x\" below 10");
  EXPECT_EQ(override_message("drive[0].rate", "5"), "--set drive[0].rate=5: error: the scene has no [[drive]] entry");
  EXPECT_EQ(override_message("grains..count", "5"),
            "--set grains..count=5: error: expected a path like grains.count, got \"grains..count\"");
  EXPECT_EQ(override_message("drive[x].rate", "5"),
            "--set drive[x].rate=5: error: expected a path like grains.count, got \"drive[x].rate\"");
  EXPECT_EQ(override_message("", "5"), "--set =5: error: expected a path like grains.count, got \"\"");
}

TEST(SceneOverride, RefusesBrokenValues) {
  EXPECT_EQ(override_message("cell.aspect", "[1, 2"),
            "--set cell.aspect=[1, 2: error: expected a value in TOML syntax, got [1, 2");
  EXPECT_EQ(override_message("title", ""), "--set title=: error: expected a value in TOML syntax, got ");
}

TEST(SceneOverride, CannotSmuggleInFurtherFields) {
  const std::string value = "7\ngrains = 3";
  EXPECT_EQ(parse_scene(sound, "s", {{"title", value}}).title, value);
}

TEST(SceneOverride, RefusesAnEntryThatIsNotThere) {
  try {
    parse_scene(two_planes, "s", {{"plane[2].velocity", "[0, 0]"}});
    FAIL() << "a third plane was accepted";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(),
                 "--set plane[2].velocity=[0, 0]: error: no plane[2]: the number of [[plane]] entries is 2");
  }
}

}  // namespace
}  // namespace galet::test::scene_override_test
