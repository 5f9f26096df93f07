// Dense packings by geometry: no two grains overlap (all pairs), nor do grains and boundaries, at the density asked
// for.
#include "common/scene/dense_packing.hpp"

#include <gtest/gtest.h>

#include "common/scene/packing.hpp"
#include "tests/support/scenes.hpp"
#include "tests/unit/scene_mistakes.hpp"

namespace galet::test::dense_packing_test {
namespace {

Scene scene_of(const std::string& text) { return parse_scene(text, "test.toml"); }

const std::string material = R"(material = {restitution = 0.5, normal_stiffness = 1e4}
run.duration = 1
initial.kind = "dense"
)";

template <int D>
void expect_apart(const Sample<D>& sample) {
  double least = INFINITY;
  for (int i = 0; i < sample.count(); ++i) {
    for (const Plane<D>& plane : sample.planes)
      EXPECT_GE(distance_from<D>(plane, sample.position[i]), sample.radius[i] - 1e-12);
    for (int j = 0; j < i; ++j)
      least = std::min(least, lattice_distance<D>(sample.cell, sample.position[i], sample.position[j]) -
                                  sample.radius[i] - sample.radius[j]);
  }
  EXPECT_GT(least, 0) << "nothing touches";
  EXPECT_LT(least, 1e-2) << "but some grains nearly do";
}

TEST(DensePacking, DisksFarAboveWhatInsertionReaches) {
  const Sample<2> sample = initial_sample<2>(scene_of(material + R"(
grains = {count = 200, diameter = {distribution = "uniform", mean = 1, spread = 0.2}}
initial.solid_fraction = 0.81
)"));
  EXPECT_NEAR(sample.solid_fraction(), 0.81, 1e-12);
  expect_apart(sample);
}

TEST(DensePacking, Spheres) {
  const Sample<3> sample = initial_sample<3>(scene_of("dimension = 3\n" + material + R"(
grains.count = 150
initial.solid_fraction = 0.6
)"));
  EXPECT_NEAR(sample.solid_fraction(), 0.6, 1e-12);
  expect_apart(sample);
}

TEST(DensePacking, FillsACylinder) {
  // 100 disks of d = 1 within a circle of radius 5.75: 0.756, and 0.83 of what the room near the wall leaves.
  const Sample<2> sample = initial_sample<2>(scene_of(material + R"(
grains = {count = 100, diameter = {distribution = "uniform", mean = 1, spread = 0.2}}
cell = {size = [12, 12], periodic = [false, false]}
cylinder = [{point = [6, 6], radius = 5.75}]
)"));
  expect_apart(sample);
}

TEST(DensePacking, IsTheSameForTheSameSeed) {
  const std::string text = material + "grains.count = 50\ninitial.solid_fraction = 0.75\n";
  const Sample<2> a = initial_sample<2>(scene_of(text)), b = initial_sample<2>(scene_of(text)),
                  c = initial_sample<2>(parse_scene(text, "s", {{"seed", "2"}}));
  EXPECT_EQ(a.position, b.position);
  EXPECT_NE(a.position, c.position);
}

TEST(DensePacking, WhatDoesNotFitIsRefused) {
  EXPECT_EQ(mistakes_of(material + "grains.count = 50\ninitial.solid_fraction = 0.85\n"),
            (std::vector<std::string>{"5:26: initial.solid_fraction is 0.85: a dense packing in 2D reaches 0.83"}));
  // Too many for the circle, which the cell does not know.
  const Scene scene = scene_of(material + R"(
grains.count = 100
cell = {size = [12, 12], periodic = [false, false]}
cylinder = [{point = [6, 6], radius = 5}]
)");
  try {
    initial_sample<2>(scene);
    FAIL() << "it fits";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("was not found"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace galet::test::dense_packing_test
