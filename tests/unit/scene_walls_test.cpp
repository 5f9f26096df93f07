// Planes and walls that leave no room between them, or cross before the run ends.
#include <gtest/gtest.h>

#include "tests/unit/scene_mistakes.hpp"

namespace galet::test::scene_walls_test {
namespace {

using Texts = std::vector<std::string>;

/// Two planes that face each other, `apart` along y, and close at 25. The run lasts 1.
std::string planes(double apart, const std::string& more = "") {
  return sound + more +
         fmt::format(R"(cell.periodic = [true, false]
[[plane]]
point = [0, 0]
normal = [0, 1]
velocity = [3, 5]
[[plane]]
point = [4, {}]
normal = [0, -2]
velocity = [0, -20]
)",
                     apart);
}

TEST(SceneWalls, PlanesLeaveRoom) {
  EXPECT_EQ(mistakes_of(planes(-1)), (Texts{"11:9: plane[1].point: no room is left before plane[0]"}));
  EXPECT_EQ(mistakes_of(planes(0)), (Texts{"11:9: plane[1].point: no room is left before plane[0]"}));
}

TEST(SceneWalls, PlanesDoNotCrossWithinTheRun) {
  EXPECT_EQ(mistakes_of(planes(20)),
            (Texts{"13:12: plane[1].velocity: the plane crosses plane[0] at the time 0.8, before the end of the run"}));
  EXPECT_EQ(mistakes_of(planes(26)), Texts{});
  // A run that a condition may end before is not judged by its longest duration.
  EXPECT_EQ(mistakes_of(planes(20, "run.equilibrium = 1e-3\nloading.pressure = 1\n")), Texts{});
}

TEST(SceneWalls, PlanesThatLookAwayOrAsideAreNotJudged) {
  const std::string aside = sound + R"(cell.periodic = [false, false]
[[plane]]
point = [0, 0]
normal = [0, 1]
[[plane]]
point = [9, -1]
normal = [-1, 0]
velocity = [0, -90]
[[plane]]
point = [0, -1]
normal = [0, 1]
velocity = [0, 90]
)";
  EXPECT_EQ(mistakes_of(aside), Texts{});
}

TEST(SceneWalls, WallsDoNotMeet) {
  const std::string text = sound + R"(cell = {size = [10, 30], periodic = [true, false]}
body = [{name = "a", shape = "wall", at = 1}, {name = "b", shape = "wall", at = 21, velocity = [1, -40]}, {name = "c", shape = "wall", at = 1}]
)";
  EXPECT_EQ(mistakes_of(text),
            (Texts{"6:96: body[1].velocity: the wall crosses body[0] at the time 0.5, before the end of the run",
                   "6:107: body[2].velocity: the wall crosses body[1] at the time 0.5, before the end of the run",
                   "6:141: body[2].at: body[0], a wall too, stands in the same place"}));
  // Pressed by a force it stops at the grains.
  const std::string pressed = sound + R"(cell = {size = [10, 30], periodic = [true, false]}
body = [{name = "a", shape = "wall", at = 1}, {name = "b", shape = "wall", at = 21, velocity = [1, -40], free = [false, true], force = [0, -1]}]
)";
  EXPECT_EQ(mistakes_of(pressed), Texts{});
}

}  // namespace
}  // namespace galet::test::scene_walls_test
