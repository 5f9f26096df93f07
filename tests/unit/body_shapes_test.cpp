// Walls, rings and clumps that a scene gives by their shape, and grains that are placed between them.
#include "common/scene/body_shapes.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "common/scene/packing.hpp"
#include "common/scene/rigid_bodies.hpp"
#include "tests/support/scenes.hpp"
#include "tests/unit/scene_mistakes.hpp"

namespace galet::test::body_shapes_test {
namespace {

Scene scene_of(const std::string& text) { return parse_scene(text, "test.toml"); }

using Mistakes = std::vector<std::string>;

const std::string material = R"(material = {restitution = 0.5, normal_stiffness = 1e4, friction = 0.4}
run.duration = 1
)";

std::vector<int> members(const std::vector<int>& of, int body) {
  std::vector<int> found;
  for (std::size_t i = 0; i < of.size(); ++i)
    if (of[i] == body) found.push_back(static_cast<int>(i));
  return found;
}

template <int D>
double least_gap_of_free_grains(const Sample<D>& sample) {
  double least = INFINITY;
  for (int i = 0; i < sample.count(); ++i)
    for (int j = 0; j < i; ++j)
      if (sample.body[i] < 0 || sample.body[j] < 0)
        least = std::min(least, lattice_distance<D>(sample.cell, sample.position[i], sample.position[j]) -
                                    sample.radius[i] - sample.radius[j]);
  return least;
}

TEST(BodyShapes, WallsStandAcrossTheCellAndGrainsLieBetweenThem) {
  const Scene scene = scene_of(material + R"(
grains = {count = 60, diameter = {distribution = "uniform", mean = 1, spread = 0.2}}
cell = {size = [10.4, 20], periodic = [true, false]}
initial.kind = "gas"
body = [{name = "floor", shape = "wall", at = 3}, {name = "lid", shape = "wall", at = 15, velocity = [2, 0]}]
)");
  const Sample<2> sample = initial_sample<2>(scene);
  ASSERT_EQ(sample.count(), 60 + 2 * 10);  // 10 places at least one diameter apart
  for (int i = 0; i < 60; ++i) {
    EXPECT_EQ(sample.body[i], -1);
    EXPECT_GT(sample.position[i].y(), 3 + sample.radius[i] - 1e-6);
    EXPECT_LT(sample.position[i].y(), 15 - sample.radius[i] + 1e-6);
  }
  for (int k = 0; k < 10; ++k) {
    EXPECT_EQ(sample.body[60 + k], 0);
    EXPECT_EQ(sample.body[70 + k], 1);
    EXPECT_NEAR(sample.position[60 + k].x(), 1.04 * (k + 0.5), 1e-12);
    EXPECT_EQ(sample.position[60 + k].y(), 3);
    EXPECT_EQ(sample.position[70 + k].y(), 15);
    EXPECT_EQ(sample.velocity[70 + k], Vec<2>(2, 0));
    EXPECT_GE(sample.radius[60 + k], 0.4);
    EXPECT_LE(sample.radius[60 + k], 0.6);
  }
  EXPECT_NE(sample.radius[60], sample.radius[61]) << "diameters are drawn";
  EXPECT_NE(sample.radius[60], sample.radius[70]) << "from streams of their own";
  EXPECT_GE(least_gap_of_free_grains(sample), 0);
}

TEST(BodyShapes, WallOfSpheresIsALayer) {
  const Scene scene = scene_of("dimension = 3\n" + material + R"(
grains.count = 20
cell = {size = [5, 4, 9], periodic = [true, true, false]}
initial.kind = "gas"
body = [{name = "floor", shape = "wall", at = 0.5, across = "z", spacing = 0.9}]
)");
  const Sample<3> sample = initial_sample<3>(scene);
  ASSERT_EQ(sample.count(), 20 + 5 * 4);
  for (const int i : members(sample.body, 0)) EXPECT_EQ(sample.position[i].z(), 0.5);
}

const std::string annulus = material + R"(
grains.count = 40
cell = {size = [24, 24], periodic = [false, false]}
initial.kind = "gas"
)";

TEST(BodyShapes, RingsHoldGrainsInsideAndOutside) {
  const Scene scene = scene_of(annulus + R"(
body = [{name = "in", shape = "ring", centre = [12, 12], radius = 5, grains = "outside", spin = 0.1}, {name = "out", shape = "ring", centre = [12, 12], radius = 11}]
)");
  const Sample<2> sample = initial_sample<2>(scene);
  const Vec<2> centre(12, 12);
  EXPECT_EQ(members(sample.body, 0).size(), 31u);  // 2 pi 5 = 31.4
  EXPECT_EQ(members(sample.body, 1).size(), 69u);
  for (const int i : members(sample.body, 0)) {
    EXPECT_NEAR((sample.position[i] - centre).norm(), 5, 1e-12);
    EXPECT_NEAR((sample.velocity[i] - cross(0.1, Vec<2>(sample.position[i] - centre))).norm(), 0, 1e-14);
  }
  for (int i = 0; i < 40; ++i) {
    const double r = (sample.position[i] - centre).norm();
    EXPECT_GT(r, 5.5 - 1e-5);
    EXPECT_LT(r, 10.5 + 1e-5);
  }
  EXPECT_GE(least_gap_of_free_grains(sample), 0);
}

TEST(BodyShapes, SegmentsOfARingAreBodiesUnderThePressure) {
  const Scene scene = scene_of(annulus + R"(
body = [{name = "out", shape = "ring", centre = [12, 12], radius = 11, segments = 4, pressure = 2, mass = 7}]
)");
  ASSERT_EQ(scene.bodies.size(), 4u);
  EXPECT_EQ(scene.bodies[2].name, "out 3");
  const Sample<2> sample = initial_sample<2>(scene);
  const RigidBodies<2> bodies = rigid_bodies<2>(scene, sample);
  std::size_t grains = 0;
  for (int b = 0; b < 4; ++b) {
    grains += members(sample.body, b).size();
    const RigidBody<2>& body = bodies.body[b];
    const Vec<2> along = Vec<2>(std::cos(pi / 4 + b * pi / 2), std::sin(pi / 4 + b * pi / 2));
    // Towards the centre, a quarter of the circle long; free along that line, with its mass.
    EXPECT_LT((body.force + 2 * (2 * pi * 11 / 4) * along).norm(), 1e-12);
    EXPECT_LT((body.mobility - along * along.transpose() / 7).norm(), 1e-15);
    for (const int i : members(sample.body, b)) EXPECT_GT((sample.position[i] - Vec<2>(12, 12)).dot(along), 0);
  }
  EXPECT_EQ(grains, 69u);
  // Arcs that touch each other don't act on each other.
  for (const int i : members(bodies.of, 3)) EXPECT_EQ(bodies.group[i], 0);
  EXPECT_EQ(with_bodies_apart(scene).bodies.size(), 4u) << "no second time";
}

TEST(BodyShapes, ClumpsArePlacedAndTurnedAtRandom) {
  for (const std::string shape : {"chain", "polygon"}) {
    const Scene scene = scene_of(annulus + "body = [{name = \"c\", copies = 9, size = 3, spacing = 0.6, shape = \"" +
                                 shape + "\", free = [true, true], free_rotation = [true]}]\n");
    const Sample<2> sample = initial_sample<2>(scene);
    ASSERT_EQ(sample.count(), 40 + 27);
    ASSERT_EQ(scene.bodies.size(), 9u);
    std::vector<double> angles;
    for (int b = 0; b < 9; ++b) {
      const std::vector<int> grain = members(sample.body, b);
      ASSERT_EQ(grain.size(), 3u);
      const Vec<2> first = sample.position[grain[1]] - sample.position[grain[0]],
                   second = sample.position[grain[2]] - sample.position[grain[1]];
      EXPECT_NEAR(first.norm(), 0.6, 1e-12);
      EXPECT_NEAR(second.norm(), 0.6, 1e-12);
      // In line, or turning by a third of a circle.
      EXPECT_NEAR(first.dot(second) / 0.36, shape == "chain" ? 1 : -0.5, 1e-12);
      angles.push_back(std::atan2(first.y(), first.x()));
    }
    std::sort(angles.begin(), angles.end());
    for (std::size_t k = 1; k < angles.size(); ++k) EXPECT_GT(angles[k], angles[k - 1]);
    EXPECT_GE(least_gap_of_free_grains(sample), 0);
  }
}

TEST(BodyShapes, ClumpsAlone) {
  const Scene scene = scene_of("dimension = 3\n" + material + R"(
cell.size = [9, 9, 9]
body = [{name = "rod", shape = "chain", size = 4, copies = 12, spacing = 0.5, free = [true, true, true], free_rotation = [true, true, true]}]
)");
  const Sample<3> sample = initial_sample<3>(scene);
  ASSERT_EQ(sample.count(), 48);
  const RigidBodies<3> bodies = rigid_bodies<3>(scene, sample);
  for (const RigidBody<3>& body : bodies.body) {
    // Four spheres of mass 1 in line, half a diameter apart: about the line 4 (2/5) (1/4), across it plus 5/4.
    Vec<3> moments = body.moments;
    std::sort(moments.begin(), moments.end());
    EXPECT_NEAR(moments[0], 0.4, 1e-12);
    EXPECT_NEAR(moments[1], 1.65, 1e-12);
    EXPECT_NEAR(moments[2], 1.65, 1e-12);
  }
}

TEST(BodyShapes, WhatDoesNotFitTogetherIsRefused) {
  const std::string cell = material + "grains.count = 9\ncell = {size = [9, 9], periodic = [true, false]}\n";
  const auto refused = [&](const std::string& body) {
    return mistakes_of(cell + "body = [{name = \"b\", " + body + "}]\n");
  };
  EXPECT_EQ(refused("shape = \"wall\", at = 1"), Mistakes{});
  EXPECT_EQ(refused("shape = \"wall\""),
            (Mistakes{"5:9: body[0].at is needed with shape = \"wall\": where it stands"}));
  EXPECT_EQ(refused("shape = \"wall\", at = 11"),
            (Mistakes{"5:43: body[0].at: 11 is outside the cell, whose size is 9 along y"}));
  EXPECT_EQ(
      refused("shape = \"wall\", at = 1, across = \"x\""),
      (Mistakes{"5:55: body[0].across: x is a periodic direction, in which grains would pass the wall from behind; "
                "set cell.periodic to false there"}));
  EXPECT_EQ(
      refused("shape = \"ring\", radius = 2, centre = [4, 4]"),
      (Mistakes{"5:30: body[0].shape: the ring crosses the periodic direction x; set cell.periodic to false there"}));
  EXPECT_EQ(refused("shape = \"wall\", at = 1, segments = 4"),
            (Mistakes{"5:57: body[0].segments needs shape = \"ring\""}));
  EXPECT_EQ(refused("shape = \"polygon\", size = 2"),
            (Mistakes{"5:48: body[0].size is needed: the number of grains, at least 3"}));
  EXPECT_EQ(refused("shape = \"chain\", size = 2, guide = [1, 0], free = [true, true]"),
            (Mistakes{"5:57: body[0].guide and body[0].free exclude each other"}));
  EXPECT_EQ(
      mistakes_of(material + "grains.count = 9\ninitial.kind = \"lattice\"\ncell = {size = [9, 9], periodic = [true, "
                             "false]}\nbody = [{name = \"b\", shape = \"wall\", at = 1}]\n"),
      (Mistakes{"6:30: body[0].shape needs initial.kind = \"gas\", \"dense\" or \"listed\""}));
  EXPECT_EQ(mistakes_of(cell + "initial.kind = \"gas\"\ngrain = [{position = [1, 1]}]\n"),
            (Mistakes{"5:16: [[grain]] entries need initial.kind = \"listed\": other kinds make their own grains"}));
}

/// Listed grains of a body, beside drawn ones.
TEST(BodyShapes, AListedBodyStandsAmongDrawnGrains) {
  const Scene scene = scene_of(material + R"(
grains.count = 30
cell.size = [10, 10]
initial.kind = "gas"
body = [{name = "post"}]
grain = [{position = [5, 5], diameter = 3, body = "post"}, {position = [6, 6], diameter = 2, body = "post"}]
)");
  const Sample<2> sample = initial_sample<2>(scene);
  ASSERT_EQ(sample.count(), 32);
  EXPECT_EQ(sample.radius[30], 1.5);
  EXPECT_EQ(sample.body[29], -1);
  EXPECT_EQ(sample.body[31], 0);
  EXPECT_GE(least_gap_of_free_grains(sample), 0);
}

}  // namespace
}  // namespace galet::test::body_shapes_test
