// The rigid limit: closed forms of weighted least squares, and how limits are combined and judged.
#include "src/rigid_limit.hpp"

#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

namespace galet::test::rigid_limit_test {
namespace {

constexpr double exact = 1e-13;  // rounding of a few operations on numbers of order 1

TEST(FitLine, PassesThroughPointsOnALine) {
  const std::vector<LinePoint> points = {
      {1e-3, {0.30 + 2e-3, 0.01}}, {1e-4, {0.30 + 2e-4, 0.002}}, {1e-5, {0.30 + 2e-5, 0.005}}};
  const LineFit fit = fit_line(points);
  EXPECT_NEAR(fit.intercept.value, 0.30, exact);
  EXPECT_NEAR(fit.slope.value, 2.0, 1e-9);
  EXPECT_NEAR(fit.chi_square, 0, exact);
}

TEST(FitLine, ErrorOfTheInterceptOfTwoPoints) {
  // Through (1, a) and (2, b) the intercept is 2 a - b: its variance is 4 e_a^2 + e_b^2; the slope's e_a^2 + e_b^2.
  const LineFit fit = fit_line(std::vector<LinePoint>{{1, {5, 0.3}}, {2, {4, 0.4}}});
  EXPECT_NEAR(fit.intercept.value, 6, exact);
  EXPECT_NEAR(fit.intercept.error, std::sqrt(4 * 0.09 + 0.16), exact);
  EXPECT_NEAR(fit.slope.error, 0.5, exact);
}

TEST(FitLine, WeightsAreInverseVariances) {
  // Two measures at the same x: the weighted mean and its error.
  const LineFit fit = fit_line(std::vector<LinePoint>{{1, {1, 1}}, {1, {4, 2}}});
  EXPECT_NEAR(fit.intercept.value, (1 + 4 * 0.25) / 1.25, exact);
  EXPECT_NEAR(fit.intercept.error, 1 / std::sqrt(1.25), exact);
  EXPECT_EQ(fit.slope.value, 0);
}

TEST(FitLine, OnePointIsItsOwnLimit) {
  const LineFit fit = fit_line(std::vector<LinePoint>{{1e-4, {0.37, 0.01}}});
  EXPECT_EQ(fit.intercept.value, 0.37);
  EXPECT_NEAR(fit.intercept.error, 0.01, exact);
}

TEST(FitLine, UnknownErrorsFollowFromTheScatter) {
  // y = 1 + x with residuals (+1, -2, +1) * r: orthogonal to 1 and x, so the line stays and s^2 = 6 r^2 / 1.
  const double r = 0.01;
  const LineFit fit = fit_line(std::vector<LinePoint>{{1, {2 + r, 0}}, {2, {3 - 2 * r, 0}}, {3, {4 + r, 0}}});
  EXPECT_NEAR(fit.intercept.value, 1, exact);
  // Variance of the intercept for unit weights: 1/n + mean_x^2 / sum (x - mean_x)^2 = 1/3 + 4/2.
  EXPECT_NEAR(fit.intercept.error, std::sqrt(6 * r * r * (1.0 / 3 + 2)), exact);
}

TEST(FitLine, NeedsAPoint) { EXPECT_THROW(fit_line({}), std::invalid_argument); }

TEST(RigidLimit, RunsOffTheLineGiveNoLimitAndNoVerdict) {
  // z falling by the same amount per decade of kappa: no power law, no limit.
  const std::vector<MdRun> md{{1e3, {2.0, 0.01}}, {1e4, {1.5, 0.01}}, {1e5, {1.0, 0.01}}};
  const std::vector<CdRun> cd{{0.01, 1e-4, {1.0, 0.01}}, {0.02, 1e-4, {1.2, 0.01}}};
  EXPECT_FALSE(md_limit(md, 0.5)->on_line);
  EXPECT_TRUE(cd_limit(cd)->on_line) << "two runs always lie on a line";
  EXPECT_FALSE(rigid_limit(md, cd, 0.5).agree.has_value());
}

TEST(RigidLimit, CoordinationGoesWithTheRootOfKappa) {
  // z = 1.2 + 30 kappa^-1/2 exactly: the line in kappa^-1/2 finds 1.2, the line in 1/kappa does not.
  std::vector<MdRun> runs;
  for (const double kappa : {1e3, 1e4, 1e5}) runs.push_back({kappa, {1.2 + 30 / std::sqrt(kappa), 0.01}});
  EXPECT_NEAR(md_limit(runs, 0.5)->value.value, 1.2, 1e-12);
  EXPECT_GT(md_limit(runs, 1)->value.value, 1.3);
}

TEST(MdLimit, ExtrapolatesInInverseStiffness) {
  const auto limit = md_limit(std::vector<MdRun>{{1e3, {0.40 + 5e-3, 1e-3}}, {1e4, {0.40 + 5e-4, 1e-3}}});
  ASSERT_TRUE(limit);
  EXPECT_NEAR(limit->value.value, 0.40, exact);
  EXPECT_NEAR(limit->slope.value, 5, 1e-9);
  EXPECT_EQ(limit->runs, 2);
}

TEST(CdLimit, UsesTheTightestTolerance) {
  const std::vector<CdRun> runs = {{0.01, 1e-3, {99, 1e-3}},
                                   {0.02, 1e-3, {99, 1e-3}},
                                   {0.01, 1e-5, {0.37 + 0.01, 1e-3}},
                                   {0.02, 1e-5, {0.37 + 0.02, 1e-3}}};
  const auto limit = cd_limit(runs);
  ASSERT_TRUE(limit);
  EXPECT_NEAR(limit->value.value, 0.37, exact);
  EXPECT_EQ(limit->runs, 2);
}

TEST(CdLimit, ToleranceIsASystematicErrorBeyondTheNoise) {
  // One time step: limits are the values. Difference 0.05, noise sqrt(0.03^2 + 0.03^2).
  const auto limit = cd_limit(std::vector<CdRun>{{0.01, 1e-3, {0.45, 0.03}}, {0.01, 1e-4, {0.40, 0.03}}});
  ASSERT_TRUE(limit);
  EXPECT_NEAR(limit->systematic, std::sqrt(0.05 * 0.05 - 2 * 0.03 * 0.03), exact);
  EXPECT_NEAR(limit->value.error, std::sqrt(0.03 * 0.03 + limit->systematic * limit->systematic), exact);
}

TEST(CdLimit, NoSystematicErrorWithinTheNoise) {
  const auto limit = cd_limit(std::vector<CdRun>{{0.01, 1e-3, {0.41, 0.03}}, {0.01, 1e-4, {0.40, 0.03}}});
  ASSERT_TRUE(limit);
  EXPECT_EQ(limit->systematic, 0);
  EXPECT_NEAR(limit->value.error, 0.03, exact);
}

TEST(RigidLimit, CombinesByInverseVariance) {
  const RigidLimit limit =
      rigid_limit(std::vector<MdRun>{{1e4, {0.40, 0.01}}}, std::vector<CdRun>{{0.01, 1e-4, {0.43, 0.02}}});
  EXPECT_NEAR(limit.combined.value, (4 * 0.40 + 0.43) / 5, exact);
  EXPECT_NEAR(limit.combined.error, 0.02 / std::sqrt(5.0), exact);
  ASSERT_TRUE(limit.difference && limit.agree);
  EXPECT_NEAR(limit.difference->value, -0.03, exact);
  EXPECT_NEAR(limit.difference->error, std::sqrt(0.0005), exact);
  EXPECT_TRUE(*limit.agree);  // 0.03 <= 2 * 0.0224
}

TEST(RigidLimit, SaysWhenTheEnginesDiffer) {
  const RigidLimit limit =
      rigid_limit(std::vector<MdRun>{{1e4, {0.40, 0.01}}}, std::vector<CdRun>{{0.01, 1e-4, {0.43, 0.01}}});
  ASSERT_TRUE(limit.agree);
  EXPECT_FALSE(*limit.agree);  // 0.03 > 2 * 0.0141
}

TEST(RigidLimit, OneEngineAlone) {
  const RigidLimit limit = rigid_limit({}, std::vector<CdRun>{{0.01, 1e-4, {0.43, 0.01}}});
  EXPECT_FALSE(limit.md);
  EXPECT_FALSE(limit.agree);
  EXPECT_EQ(limit.combined.value, 0.43);
}

TEST(RigidLimit, LeavesOutRunsWithoutAValue) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const RigidLimit limit = rigid_limit(std::vector<MdRun>{{1e3, {nan, 0}}, {1e4, {0.4, 0.01}}}, {});
  EXPECT_EQ(limit.combined.value, 0.4);
  EXPECT_EQ(limit.md->runs, 1);
  EXPECT_TRUE(std::isnan(rigid_limit(std::vector<MdRun>{{1e3, {nan, 0}}}, {}).combined.value));
}

TEST(Deviation, AddsErrorsInSquares) {
  const Estimate off = deviation({0.5, 0.3}, {0.1, 0.4});
  EXPECT_NEAR(off.value, 0.4, exact);
  EXPECT_NEAR(off.error, 0.5, exact);
}

}  // namespace
}  // namespace galet::test::rigid_limit_test
