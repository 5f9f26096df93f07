// Rough walls of a scene: what a file may say of them, what it may not, and the sample that they make.
#include <gtest/gtest.h>

#include "common/scene/derive.hpp"
#include "common/scene/packing.hpp"
#include "src/engines.hpp"
#include "tests/support/scenes.hpp"
#include "tests/unit/scene_mistakes.hpp"

namespace galet::test {
namespace {

const std::string walls = R"(engine = "cd"
material.restitution = 0.5
run.duration = 1
cell = {periodic = [false, false], size = [10, 10]}
grain = [{position = [2, 2], wall = "floor"}, {position = [3, 2], wall = "floor"}, {position = [5, 5]}]
)";

TEST(SceneWalls, AreReadAndKnowTheirGrains) {
  const Scene scene = parse_scene(walls + R"([[wall]]
name = "floor"
velocity = [0.5, 0]
free = [false, true]
force = [0, 3]
mass = 7
)",
                                  "walls.toml", {});
  ASSERT_EQ(scene.walls.size(), 1u);
  EXPECT_EQ(scene.walls[0].velocity, (std::vector<double>{0.5, 0}));
  EXPECT_EQ(scene.walls[0].free, (std::vector<bool>{false, true}));
  EXPECT_EQ(scene.walls[0].force, (std::vector<double>{0, 3}));
  EXPECT_EQ(scene.walls[0].mass, 7);
  EXPECT_EQ(initial_sample<2>(scene).wall, (std::vector<int>{0, 0, -1}));
}

TEST(SceneWalls, MistakesSayWhatIsWrong) {
  EXPECT_EQ(mistakes_of(walls + R"(wall = [{name = "flor"}]
)"),
            (std::vector<std::string>{
                R"(5:37: grain[0].wall: no [[wall]] is called "floor"; did you mean "flor"?)",
                R"(5:74: grain[1].wall: no [[wall]] is called "floor"; did you mean "flor"?)",
                R"(6:17: wall[0].name: no [[grain]] is glued to "flor": give its grains wall = "flor")"}));
  EXPECT_EQ(
      mistakes_of(walls + R"(wall = [{name = "floor", force = [1, 0], mass = 2}]
)"),
      (std::vector<std::string>{"6:34: wall[0].force: the wall is not free along x, where its velocity is imposed",
                                "6:49: wall[0].mass has no effect on a wall that is free in no direction"}));
}

TEST(SceneWalls, NeedTheRigidEngine) {
  std::string soft = walls + R"(wall = [{name = "floor"}]
material.normal_stiffness = 1e4
)";
  soft.replace(soft.find("cd"), 2, "md");
  EXPECT_EQ(mistakes_of(soft),
            (std::vector<std::string>{R"(6:8: [[wall]] entries need engine = "cd": md has no rigid bodies)"}));
}

/// `compare` and tests make engines without a scene file's rules: what md has no motion for is refused there too.
TEST(SceneWalls, SoftEngineRefusesWhatItCanNotMove) {
  const auto refusal = [](const Sample<2>& sample) -> std::string {
    try {
      const Scene scene = periodic_scene(2, 0, 1, 1e4);
      galet::make_engine<2>(EngineKind::md, scene, derive(scene, grain_facts<2>(scene, sample)), sample);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  Sample<2> sample = gas_sample<2>(3, 0.3, 0, 5, 0);
  EXPECT_EQ(refusal(sample), "");
  sample.wall = {0};
  EXPECT_NE(refusal(sample).find("[[wall]] entries need engine cd"), std::string::npos);
  sample.wall.clear();
  sample.planes = {{Vec<2>(0, -1), Vec<2>(0, 1)}};
  sample.planes[0].inverse_mass = 1;
  EXPECT_NE(refusal(sample).find("planes with a mass need engine cd"), std::string::npos);
}

}  // namespace
}  // namespace galet::test
