// Rigid bodies of a scene: what a file may say of them, what it may not, and the bodies that they make.
#include <gtest/gtest.h>

#include "common/scene/packing.hpp"
#include "common/scene/rigid_bodies.hpp"
#include "src/engines.hpp"
#include "tests/support/scenes.hpp"
#include "tests/unit/scene_mistakes.hpp"

namespace galet::test::scene_bodies_test {
namespace {

const std::string bodies = R"(engine = "cd"
material.restitution = 0.5
run.duration = 1
cell = {periodic = [false, false], size = [10, 10]}
grain = [{position = [2, 2], body = "lid"}, {position = [3, 2], body = "lid"}, {position = [5, 5]}]
)";

TEST(SceneBodies, AreReadAndKnowTheirGrains) {
  const Scene scene = parse_scene(bodies + R"([[body]]
name = "lid"
velocity = [0.5, 0]
free = [false, true]
force = [0, 3]
spin = 0.25
free_rotation = [true]
torque = 2
mass = 7
centre = [2, 2.5]
inertia = 9
)",
                                  "bodies.toml", {});
  ASSERT_EQ(scene.bodies.size(), 1u);
  const BodySpec& body = scene.bodies[0];
  EXPECT_EQ(body.velocity, (std::vector<double>{0.5, 0}));
  EXPECT_EQ(body.free, (std::vector<bool>{false, true}));
  EXPECT_EQ(body.force, (std::vector<double>{0, 3}));
  EXPECT_EQ(body.spin, std::vector<double>{0.25});
  EXPECT_EQ(body.free_rotation, std::vector<bool>{true});
  EXPECT_EQ(body.torque, std::vector<double>{2});
  EXPECT_EQ(body.mass, 7);
  EXPECT_EQ(body.centre, (std::vector<double>{2, 2.5}));
  EXPECT_EQ(body.inertia, std::vector<double>{9});
  const Sample<2> sample = initial_sample<2>(scene);
  EXPECT_EQ(sample.body, (std::vector<int>{0, 0, -1}));
  // V + w x r, r from the centre given.
  EXPECT_LT((sample.velocity[1] - Vec<2>(0.5 + 0.25 * 0.5, 0.25)).norm(), 1e-15);
  EXPECT_EQ(sample.spin[0], 0.25);
}

std::vector<std::string> body_mistakes(const std::string& entry) {
  return mistakes_of(bodies + "body = [{name = \"lid\", " + entry + "}]\n");
}

TEST(SceneBodies, MistakesSayWhatIsWrong) {
  using Mistakes = std::vector<std::string>;
  EXPECT_EQ(mistakes_of(bodies + R"(body = [{name = "lit"}]
)"),
            (Mistakes{R"(5:37: grain[0].body: no [[body]] is called "lid"; did you mean "lit"?)",
                      R"(5:72: grain[1].body: no [[body]] is called "lid"; did you mean "lit"?)",
                      R"(6:17: body[0].name: no [[grain]] is glued to "lit": give its grains body = "lit")"}));
  EXPECT_EQ(body_mistakes("force = [1, 0], mass = 2"),
            (Mistakes{"6:32: body[0].force: the body is not free along x, where its velocity is imposed",
                      "6:47: body[0].mass has no effect on a body that is free in nothing"}));
  EXPECT_EQ(body_mistakes("torque = 1"),
            (Mistakes{"6:33: body[0].torque: the body does not turn freely, where its spin is imposed"}));
  EXPECT_EQ(body_mistakes("spin = [1, 2, 3]"), (Mistakes{"6:31: body[0].spin: 2D needs 1 component, got 3"}));
  EXPECT_EQ(body_mistakes("free_rotation = [true, true, false]"),
            (Mistakes{"6:40: body[0].free_rotation: 2D needs 1 component, got 3"}));
  EXPECT_EQ(body_mistakes("centre = [1, 1]"),
            (Mistakes{"6:33: body[0].centre has no effect on a body that never turns"}));
  EXPECT_EQ(body_mistakes("spin = 1, inertia = 3"),
            (Mistakes{"6:44: body[0].inertia has no effect on a body that does not turn freely"}));
  EXPECT_EQ(body_mistakes("free_rotation = [true], inertia = [1, 2]"),
            (Mistakes{"6:58: body[0].inertia: 2D needs a number, got 2"}));
  EXPECT_EQ(body_mistakes("free_rotation = [true], inertia = 0"),
            (Mistakes{"6:58: body[0].inertia: every moment of inertia must be above 0"}));
  EXPECT_EQ(mistakes_of(bodies + "body = [{name = \"lid\"}, {name = \"lid\"}]\n"),
            (Mistakes{"6:33: body[1].name: \"lid\" is the name of another body already"}));
  EXPECT_EQ(mistakes_of(bodies + "wall = [{name = \"lid\"}]\n").size(), 3u) << "walls are bodies now";
}

TEST(SceneBodies, MistakesInSpaceSayWhatIsWrong) {
  using Mistakes = std::vector<std::string>;
  std::string space = "dimension = 3\n" + bodies;
  space.replace(space.find("[false, false], size = [10, 10]"), 31, "[false, false, false]");
  for (const char* place : {"[2, 2]", "[3, 2]", "[5, 5]"}) {
    const std::string position(place);
    space.replace(space.find(position), position.size(), position.substr(0, 5) + ", 2]");
  }
  const auto mistakes = [&](const std::string& entry) {
    return mistakes_of(space + "body = [{name = \"lid\", " + entry + "}]\n");
  };
  EXPECT_EQ(mistakes("free_rotation = [true, true, true]"), Mistakes{});
  EXPECT_EQ(mistakes("free_rotation = [true, true, false]"),
            (Mistakes{"7:40: body[0].free_rotation: a body turns freely about one axis or about all three, not about "
                      "two"}));
  EXPECT_EQ(mistakes("free_rotation = [false, false, true], spin = [1, 0, 2]"),
            (Mistakes{"7:69: body[0].spin: a body that turns freely about one axis can't have an imposed spin about "
                      "x"}));
  EXPECT_EQ(mistakes("free_rotation = [false, false, true], torque = [1, 0, 0]"),
            (Mistakes{"7:71: body[0].torque: the body does not turn freely about x, where its spin is imposed"}));
  EXPECT_EQ(mistakes("free_rotation = [true, true, true], inertia = [1, 1, 1, 2, 0, 0]"),
            (Mistakes{"7:70: body[0].inertia: every moment of inertia must be above 0"}));
}

TEST(SceneBodies, WhatTheyCanNotBeCombinedWithIsRefused) {
  using Mistakes = std::vector<std::string>;
  std::string soft = bodies + "body = [{name = \"lid\", spin = 1}]\nmaterial.normal_stiffness = 1e4\nmd.drag = 1\n";
  soft.replace(soft.find("cd"), 2, "md");
  EXPECT_EQ(mistakes_of(soft), (Mistakes{"8:11: md.drag is refused with [[body]] entries: it acts on grains alone"}));
}

/// Two disks at a distance of 1, and a third: by hand.
TEST(RigidBodies, MassCentreAndInertiaAreThoseOfTheGrains) {
  Scene scene = free_scene(2, 0.5, 0.5, 1e4);
  scene.bodies = {{.name = "clump", .free = {true, true}, .free_rotation = {true}}};
  Sample<2> sample;
  sample.cell = cube<2>(10, true);
  sample.resize(3);
  sample.position = {Vec<2>(9.8, 5), Vec<2>(0.8, 5), Vec<2>(4, 4)};  // 1 apart across the border
  sample.mass = {1, 3, 1};
  sample.body = {0, 0, -1};
  const RigidBodies<2> found = rigid_bodies<2>(scene, sample);
  ASSERT_EQ(found.body.size(), 1u);
  EXPECT_EQ(found.body[0].mass, 4);
  EXPECT_LT(lattice_distance<2>(sample.cell, found.body[0].centre, Vec<2>(0.55, 5)), 1e-14);
  EXPECT_NEAR(found.body[0].moments, 0.5 * 0.25 * 4 + 1 * 0.75 * 0.75 + 3 * 0.25 * 0.25, 1e-14);
  EXPECT_NEAR((found.offset[1] - found.offset[0]).x(), 1, 1e-14);
  EXPECT_EQ(found.member, (std::vector<int>{0, 1}));
  // Mean of 1/M + (r x n)^2 / I over directions n: half of r^2 / I.
  EXPECT_NEAR(found.contact_mass[0], 1 / (0.25 + 0.5 * 0.75 * 0.75 / found.body[0].moments), 1e-14);
  EXPECT_EQ(found.contact_mass[2], 1);
  EXPECT_TRUE(found.any_turning);
}

TEST(RigidBodies, PrincipalAxesInSpace) {
  Scene scene = free_scene(3, 0.5, 0.5, 1e4);
  scene.bodies = {{.name = "clump", .free_rotation = {true, true, true}}};
  Sample<3> sample;
  sample.cell = cube<3>(20, false);
  sample.resize(4);
  for (int k = 0; k < 4; ++k) sample.position[k] = Vec<3>(5 + 0.3 * k * k, 6 - 0.7 * k, 7 + (k == 2 ? 1.1 : 0));
  sample.body = {0, 0, 0, 0};
  const RigidBodies<3> found = rigid_bodies<3>(scene, sample);
  const RigidBody<3>& body = found.body[0];
  Mat<3> inertia = Mat<3>::Zero();
  for (const Vec<3>& x : sample.position) {
    const Vec<3> r = x - body.centre;
    inertia += (0.1 + r.squaredNorm()) * Mat<3>::Identity() - r * r.transpose();
  }
  const Mat<3> rotation = rotation_of(body);
  EXPECT_LT((rotation * body.moments.asDiagonal() * rotation.transpose() - inertia).norm(), 1e-13);
  for (int k = 0; k < 4; ++k)
    EXPECT_LT((body.centre + rotation * found.offset[k] - sample.position[k]).norm(), 1e-14) << k;
}

TEST(RigidBodies, OneThatReachesAroundTheCellCanNotTurn) {
  Scene scene = periodic_scene(2, 0.5, 0.5, 1e4);
  scene.bodies = {{.name = "bed", .spin = {1}}};
  Sample<2> sample;
  sample.cell = cube<2>(4, true);
  sample.resize(4);
  for (int k = 0; k < 4; ++k) sample.position[k] = Vec<2>(k + 0.5, 1);
  sample.body = {0, 0, 0, 0};
  try {
    rigid_bodies<2>(scene, sample);
    FAIL() << "it turns";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "error: body 'bed' reaches around the periodic direction x, so that it can't turn");
  }
  scene.bodies[0].spin.clear();
  EXPECT_EQ(rigid_bodies<2>(scene, sample).body.size(), 1u);
}

/// `compare` and tests make engines without a scene file's rules: what they can't do is refused there too.
TEST(SceneBodies, EnginesRefuseWhatTheyCanNotMove) {
  const auto refusal = [](EngineKind kind, const Scene& scene, const Sample<2>& sample) -> std::string {
    try {
      galet::make_engine<2>(kind, scene, derive(scene, grain_facts<2>(scene, sample)), sample);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  Scene scene = periodic_scene(2, 0.5, 0.5, 1e4);
  Sample<2> sample = gas_sample<2>(3, 0.3, 0, 5, 0);
  scene.bodies = {{.name = "rotor", .spin = {1}}};
  sample.body.assign(sample.count(), -1);
  sample.body[0] = 0;
  EXPECT_EQ(refusal(EngineKind::md, scene, sample), "");
  EXPECT_EQ(refusal(EngineKind::cd, scene, sample), "");
  Scene damped = scene;
  damped.md.drag = 1;
  EXPECT_EQ(refusal(EngineKind::md, damped, sample),
            "error: md.drag and md.acceleration_damping are refused with rigid bodies: they act on grains alone");
  Scene sheared = scene;
  sheared.loading.kind = LoadingKind::plane_shear;
  sheared.loading.shear_rate = 1;
  for (const EngineKind kind : both_engines) {
    EXPECT_EQ(refusal(kind, sheared, sample),
              "error: in a cell that moves rigid bodies must be free to move and turn in every way");
    Scene free = sheared;
    free.bodies = {{.name = "clump", .free = {true, true}, .free_rotation = {true}}};
    EXPECT_EQ(refusal(kind, free, sample), "");
  }
  sample.planes = {{Vec<2>(0, -1), Vec<2>(0, 1)}};
  sample.planes[0].inverse_mass = 1;
  EXPECT_NE(refusal(EngineKind::md, scene, sample).find("planes with a mass need engine cd"), std::string::npos);
}

}  // namespace
}  // namespace galet::test::scene_bodies_test
