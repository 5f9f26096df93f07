// Distributions of diameters by number and by volume, against sums over many equal shares of the grains.
#include "common/scene/size_distribution.hpp"

#include <gtest/gtest.h>

#include "common/scene/packing.hpp"
#include "tests/support/scenes.hpp"
#include "tests/unit/scene_mistakes.hpp"

namespace galet::test::size_distribution_test {
namespace {

Scene scene_of(const std::string& text) { return parse_scene(text, "test.toml"); }

SizeDistribution equal(double diameter) {
  SizeDistribution sizes;
  sizes.mean = diameter;
  return sizes;
}
SizeDistribution spread(double width, bool by_volume) {
  SizeDistribution sizes;
  sizes.kind = SizeKind::uniform, sizes.spread = width, sizes.by_volume = by_volume;
  return sizes;
}
SizeDistribution discrete(const std::vector<double>& diameters, const std::vector<double>& fractions, bool by_volume) {
  SizeDistribution sizes;
  sizes.kind = SizeKind::discrete, sizes.diameters = diameters, sizes.fractions = fractions,
  sizes.by_volume = by_volume;
  return sizes;
}

constexpr int shares = 20000;

/// Mean of x^power by the midpoint rule over the quantiles.
double sum_of_powers(const SizeDistribution& sizes, int dimension, int power) {
  double sum = 0;
  for (int k = 0; k < shares; ++k) sum += std::pow(diameter_at(sizes, dimension, (k + 0.5) / shares), power);
  return sum / shares;
}

TEST(SizeDistribution, MeansAreThoseOfTheGrainsDrawn) {
  const std::vector<SizeDistribution> all = {equal(2), spread(0.4, false), spread(0.4, true),
                                             discrete({1, 1.4, 3}, {0.25, 0.5, 0.25}, false),
                                             discrete({1, 1.4, 3}, {0.25, 0.5, 0.25}, true)};
  for (const SizeDistribution& sizes : all)
    for (const int dimension : {2, 3})
      for (const int power : {1, 2, 3})
        // Where the diameter jumps the rule is wrong by up to one grain's part; else by order 1 / shares^2.
        EXPECT_NEAR(sum_of_powers(sizes, dimension, power), mean_power(sizes, dimension, power),
                    std::pow(largest_diameter(sizes), power) / shares)
            << static_cast<int>(sizes.kind) << sizes.by_volume << " D = " << dimension << ", x^" << power;
}

/// The volume of the grains below a diameter grows evenly with it.
TEST(SizeDistribution, UniformByVolumeSharesTheVolumeEvenly) {
  const SizeDistribution sizes = spread(0.5, true);
  for (const int dimension : {2, 3}) {
    double below = 0, total = 0;
    for (int k = 0; k < shares; ++k) {
      const double x = diameter_at(sizes, dimension, (k + 0.5) / shares), volume = std::pow(x, dimension);
      EXPECT_GE(x, 0.5);
      EXPECT_LE(x, 1.5);
      total += volume;
      if (x < 0.75) below += volume;
    }
    EXPECT_NEAR(below / total, 0.25, 3.0 / shares);
  }
}

TEST(SizeDistribution, DiscreteByVolume) {
  // Half of the area each: four small disks of diameter 1 for each one of diameter 2.
  const SizeDistribution sizes = discrete({1, 2}, {0.5, 0.5}, true);
  EXPECT_EQ(diameter_at(sizes, 2, 0.79), 1);
  EXPECT_EQ(diameter_at(sizes, 2, 0.81), 2);
  EXPECT_NEAR(mean_power(sizes, 2, 1), 1.2, 1e-15);
  EXPECT_EQ(diameter_at(sizes, 3, 0.88), 1);
  EXPECT_EQ(diameter_at(sizes, 3, 0.89), 2);
  EXPECT_EQ(largest_diameter(sizes), 2);
}

/// d is the mean by number, and the mass of [grains] that of a grain of this diameter.
TEST(SizeDistribution, ReachesTheSample) {
  const Scene scene = scene_of(sound + R"(grains.mass = 3
grains.diameter = {distribution = "discrete", values = [1.0, 2.0], fractions = [0.5, 0.5], by = "volume"}
)");
  EXPECT_NEAR(mean_diameter(scene, {}), 1.2, 1e-15);
  const Sample<2> sample = initial_sample<2>(scene);
  for (int i = 0; i < sample.count(); ++i)
    EXPECT_NEAR(sample.mass[i], 3 * std::pow(2 * sample.radius[i] / 1.2, 2), 1e-12);
}

TEST(SizeDistribution, ByVolumeNeedsSomethingToShare) {
  EXPECT_EQ(mistakes_of(sound + "grains.diameter = {distribution = \"monodisperse\", by = \"volume\"}\n"),
            (std::vector<std::string>{"5:56: grains.diameter.by needs distribution = \"uniform\" or \"discrete\""}));
}

}  // namespace
}  // namespace galet::test::size_distribution_test
