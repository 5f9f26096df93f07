// Flows whose stress is not uniform, between rough boundaries made by shapes: down an inclined plane, and in an
// annulus. What the balances of momentum and of moments say holds for any material; the engines are judged by that.
#include <gtest/gtest.h>

#include "src/simulation.hpp"
#include "tests/support/scenes.hpp"
#include "tests/unit/scene_mistakes.hpp"

namespace galet::test::gradient_flows_test {
namespace {

Scene scene_of(const std::string& text) { return parse_scene(text, "test.toml"); }

/// Least-squares slope of y against x over the mean of y: how far y is from uniform, per unit of x.
double relative_slope(const std::vector<double>& x, const std::vector<double>& y) {
  double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (std::size_t k = 0; k < x.size(); ++k) n += 1, sx += x[k], sy += y[k], sxx += x[k] * x[k], sxy += x[k] * y[k];
  return (n * sxy - sx * sy) / (n * sxx - sx * sx) / (sy / n);
}

void check_inclined_plane(EngineKind kind) {
  SCOPED_TRACE(to_string(kind));
  Scene scene = scene_of(R"(
grains = {count = 160, diameter = {distribution = "uniform", mean = 1, spread = 0.2}}
material = {friction = 0.4, restitution = 0.1, normal_stiffness = 1e4}
initial.kind = "gas"
cell = {size = [12, 30], periodic = [true, false]}
body = [{name = "floor", shape = "wall", at = 0.5}]
loading = {gravity = [0, -1], inclination = 19}
md.steps_per_contact = 30
cd = {dt = 0.02, tolerance = 1e-3}
run = {duration = 480, average_from = 0.7, samples = 4000}
output = {measures = ["profile"], profile_layers = 30}
)");
  const RunResult result = Simulation<2>(scene, kind).run();
  ASSERT_EQ(result.ending, Ending::finished) << result.failure;
  // The bulk: from two grains above the floor (row at 0.5) to two below the surface, which is where 160 grains of area
  // 0.797 at Phi = 0.8 reach: 13.3 above the floor.
  std::vector<double> height, density, number;
  for (const ProfileRow& row : result.measures.profile) {
    if (row.position < 3 || row.position > 11) continue;
    const double mu = -row.stress(0, 1) / row.stress(1, 1);
    // The flow takes 300 to get steady. Momentum along the slope then changes by at most some tenths of its mean (2 per
    // grain) in the 140 of the average, against an impulse of 0.33 * 140 = 46: a per cent; stresses of a layer
    // fluctuate by some per cent.
    EXPECT_NEAR(mu, std::tan(19 * pi / 180), 0.05 * mu) << "y = " << row.position;
    height.push_back(row.position), density.push_back(row.solid_fraction);
    number.push_back(row.shear_rate.x() / std::sqrt(row.stress(1, 1)));
  }
  double phi = 0, inertial = 0;
  for (std::size_t k = 0; k < height.size(); ++k)
    phi += density[k] / height.size(), inertial += number[k] / height.size();
  ::testing::Test::RecordProperty(to_string(kind) + "_permille_Phi", static_cast<int>(1000 * phi));
  ::testing::Test::RecordProperty(to_string(kind) + "_permille_I", static_cast<int>(1000 * inertial));
  // Uniform in depth: over the 8 diameters Phi changes by less than 3 %, I by less than 40 % (shear rates of layers of
  // 12 grains, near a floor that holds them).
  EXPECT_LT(std::abs(relative_slope(height, density)) * 8, 0.03);
  EXPECT_LT(std::abs(relative_slope(height, number)) * 8, 0.4);
  // The laws of plane shear, mu* = 0.26 + 1.1 I and Phi = 0.82 - 0.37 I: I = 0.077, Phi = 0.79. Shallow flows between
  // a rough floor and a surface are somewhat slower than unbounded ones: a third is left for I.
  EXPECT_NEAR(inertial, 0.077, 0.026);
  EXPECT_NEAR(phi, 0.79, 0.015);
}

TEST(InclinedPlaneFlow, HasTheStressRatioOfTheSlopeMd) { check_inclined_plane(EngineKind::md); }
TEST(InclinedPlaneFlow, HasTheStressRatioOfTheSlopeCd) { check_inclined_plane(EngineKind::cd); }

void check_annulus(EngineKind kind) {
  SCOPED_TRACE(to_string(kind));
  Scene scene = scene_of(R"(
grains = {count = 280, diameter = {distribution = "uniform", mean = 1, spread = 0.2}}
material = {friction = 0.4, restitution = 0.1, stiffness_level = 1e3}
initial.kind = "dense"
cell = {size = [26, 26], periodic = [false, false]}
loading.pressure = 1
md.steps_per_contact = 30
cd = {dt = 0.02, tolerance = 1e-3}
run = {duration = 200, average_from = 0.25, samples = 2000}
output = {measures = ["profile"], profile_layers = 5, profile_centre = [13, 13], profile_radii = [6, 11]}
[[body]]
name = "inner"
shape = "ring"
centre = [13, 13]
radius = 6
grains = "outside"
spin = 0.05
[[body]]
name = "outer"
shape = "ring"
centre = [13, 13]
radius = 12
segments = 12
pressure = 1
mass = 10
)");
  const RunResult result = Simulation<2>(scene, kind).run();
  ASSERT_EQ(result.ending, Ending::finished) << result.failure;
  std::vector<double> moment;
  for (const ProfileRow& row : result.measures.profile) {
    moment.push_back(row.stress(1, 0) * row.position * row.position);
    // The radial stress is held at P outside, and differs inside by hoop stresses and 1/r: not by much.
    EXPECT_NEAR(row.stress(0, 0), 1, 0.3) << "r = " << row.position;
  }
  double mean = 0;
  for (const double one : moment) mean += one / moment.size();
  // sigma_theta,r: the force along theta through a circle. Moment of contact forces only: what grains carry with them
  // is I^2 of P, a per cent or two next to the inner ring; fluctuations of some 40 forces per ring add some per cent.
  for (std::size_t k = 0; k < moment.size(); ++k)
    EXPECT_NEAR(moment[k] / mean, 1, 0.12) << "ring " << k << ", mean " << mean;
  // At the inner ring the material yields: mu*_min = 0.26 at least, and not more than at I = 0.25.
  const std::vector<ProfileRow>& rows = result.measures.profile;
  const double inner = std::abs(rows[0].stress(1, 0)) / rows[0].stress(0, 0);
  ::testing::Test::RecordProperty(to_string(kind) + "_permille_mu_inner", static_cast<int>(1000 * inner));
  EXPECT_GT(inner, 0.26);
  EXPECT_LT(inner, 0.53);
  // Shear decays outwards: the outer layer hardly moves.
  EXPECT_GT(rows[0].velocity[1], 0.05);
  EXPECT_LT(rows[4].velocity[1], 0.3 * rows[0].velocity[1]);
}

TEST(AnnularShear, MomentIsTheSameAtEachRadiusMd) { check_annulus(EngineKind::md); }
TEST(AnnularShear, MomentIsTheSameAtEachRadiusCd) { check_annulus(EngineKind::cd); }

}  // namespace
}  // namespace galet::test::gradient_flows_test
