// check() on scenes built in code: the rules without a file.
#include <gtest/gtest.h>

#include "common/scene/check.hpp"

namespace galet::test::scene_check_test {
namespace {

TEST(SceneCheck, ReportsEveryBrokenRuleOfASceneBuiltInCode) {
  Scene scene;
  scene.grains.count = 10;
  scene.loading.kind = LoadingKind::isotropic;
  std::vector<std::string> messages;
  for (const Finding& finding : check(scene)) messages.push_back(finding.path + ": " + finding.message);
  EXPECT_EQ(messages, (std::vector<std::string>{
                          "material: material.restitution or material.damping_ratio is needed",
                          "material: material.stiffness_level or material.normal_stiffness is needed by engine md",
                          "loading: loading.pressure is needed with kind = \"isotropic\"",
                          "run: run.duration or run.strain is needed"}));
}

TEST(SceneCheck, StopsAtAnImpossibleDimension) {
  Scene scene;
  scene.dimension = 4;
  const std::vector<Finding> findings = check(scene);
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_EQ(findings[0].path, "dimension");
}

TEST(SceneCheck, AllowsMoreToTheRigidEngine) {
  Scene scene;
  scene.grains.count = 10;
  scene.engine = EngineKind::cd;
  scene.material.restitution = 0;
  scene.run.duration = 1;
  EXPECT_TRUE(check(scene).empty());
  scene.engine = EngineKind::md;
  EXPECT_EQ(check(scene).size(), 2u);  // no stiffness, and no restitution of 0
}

TEST(SceneCheck, AcceptsTheLimitsOfPlacement) {
  Scene scene;
  scene.grains.count = 10;
  scene.engine = EngineKind::cd;
  scene.material.restitution = 0.5;
  scene.run.duration = 1;
  scene.initial.solid_fraction = 0.5;
  EXPECT_TRUE(check(scene).empty());
  scene.initial.kind = InitialKind::lattice;
  scene.initial.solid_fraction = 0.78;
  EXPECT_TRUE(check(scene).empty());
  scene.dimension = 3;
  scene.initial.solid_fraction = 0.52;
  EXPECT_TRUE(check(scene).empty());
  scene.initial.kind = InitialKind::gas;
  scene.initial.solid_fraction = 0.33;
  EXPECT_TRUE(check(scene).empty());
  // A discrete lattice: the largest grain sets the spacing, (0.5 * 1 + 0.5 * 8) / 8 of the matter of equal grains.
  scene.initial.kind = InitialKind::lattice;
  scene.grains.diameter = {SizeKind::discrete, 1, 0, {1, 2}, {0.5, 0.5}};
  scene.initial.solid_fraction = 0.52 * 4.5 / 8 - 1e-6;
  EXPECT_TRUE(check(scene).empty());
  scene.initial.solid_fraction += 2e-6;
  EXPECT_EQ(check(scene).size(), 1u);
}

}  // namespace
}  // namespace galet::test::scene_check_test
