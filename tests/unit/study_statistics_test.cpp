// Verdicts, estimates and fits of the studies: closed forms, and synthetic data whose law and errors are known.
#include <cmath>
#include <limits>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "common/core/random.hpp"
#include "src/studies/estimates.hpp"
#include "src/studies/flow_fit.hpp"
#include "src/studies/published.hpp"
#include "src/studies/verdict.hpp"

namespace galet::test::study_statistics_test {
namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

TEST(StudyVerdict, WithinTheStatedUncertaintyOrTwoErrors) {
  const Published number{"k", Claim::equal, 1.0, 0.1, "s", ""};
  EXPECT_EQ(judge({1.09, 0.001}, number), Verdict::agrees);
  EXPECT_EQ(judge({0.91, 0.001}, number), Verdict::agrees);
  EXPECT_EQ(judge({1.19, 0.1}, number), Verdict::within_errors);
  EXPECT_EQ(judge({1.21, 0.1}, number), Verdict::differs);
  EXPECT_EQ(judge({0.79, 0.1}, number), Verdict::differs);
  EXPECT_EQ(judge({1.2, 0}, number), Verdict::differs);
  EXPECT_EQ(judge({nothing, 0.1}, number), Verdict::open);
  EXPECT_EQ(judge({1.0, nothing}, number), Verdict::open);
}

TEST(StudyVerdict, TrendsMustShowThroughTheNoise) {
  const Published rises{"k", Claim::at_least, 0.5, 0, "s", ""}, falls{"k", Claim::at_most, 0.5, 0, "s", ""};
  EXPECT_EQ(judge({0.71, 0.1}, rises), Verdict::agrees);
  EXPECT_EQ(judge({0.6, 0.1}, rises), Verdict::within_errors);
  EXPECT_EQ(judge({0.4, 0.1}, rises), Verdict::within_errors);
  EXPECT_EQ(judge({0.2, 0.1}, rises), Verdict::differs);
  EXPECT_EQ(judge({0.2, 0.1}, falls), Verdict::agrees);
  EXPECT_EQ(judge({0.4, 0.1}, falls), Verdict::within_errors);
  EXPECT_EQ(judge({0.8, 0.1}, falls), Verdict::differs);
}

TEST(StudyVerdict, TableHasASourceForEachNumber) {
  std::set<std::string_view> keys;
  for (const Published& number : published_table()) {
    EXPECT_TRUE(keys.insert(number.key).second) << number.key;
    EXPECT_FALSE(number.source.empty()) << number.key;
    EXPECT_FALSE(number.basis.empty()) << number.key;
    if (number.claim == Claim::equal) {
      EXPECT_GT(number.uncertainty, 0) << number.key;
    }
  }
  EXPECT_THROW(published("no such key"), std::invalid_argument);
}

TEST(StudyEstimates, ErrorsAddInQuadrature) {
  const Estimate a{3, 0.3}, b{2, 0.4};
  EXPECT_DOUBLE_EQ((a - b).value, 1);
  EXPECT_DOUBLE_EQ((a - b).error, 0.5);
  EXPECT_DOUBLE_EQ(ratio(a, b).value, 1.5);
  // Relative errors 0.1 and 0.2.
  EXPECT_NEAR(ratio(a, b).error, 1.5 * std::sqrt(0.05), 1e-15);
  EXPECT_DOUBLE_EQ((-2.0 * a).value, -6);
  EXPECT_DOUBLE_EQ((-2.0 * a).error, 0.6);
}

TEST(StudyEstimates, MeanByWeightsOrByScatter) {
  const std::vector<Estimate> known = {{1, 1}, {4, 2}};
  EXPECT_DOUBLE_EQ(weighted_mean(known).value, (1 + 4 * 0.25) / 1.25);
  EXPECT_DOUBLE_EQ(weighted_mean(known).error, 1 / std::sqrt(1.25));
  const std::vector<Estimate> unknown = {{1, 0}, {2, 0}, {3, 0}};
  EXPECT_DOUBLE_EQ(weighted_mean(unknown).value, 2);
  EXPECT_NEAR(weighted_mean(unknown).error, std::sqrt(2.0 / 6), 1e-15);  // sum of squares 2, n (n - 1) = 6
  EXPECT_TRUE(std::isnan(weighted_mean({}).value));
}

/// Rows that lie on the linear laws but for Gaussian errors.
std::vector<StudyRow> synthetic_rows(std::uint64_t seed, double error, double curvature) {
  std::vector<StudyRow> rows;
  RandomStream random(seed, 0);
  for (const double state : {0.001, 0.01, 0.02, 0.05, 0.1, 0.15, 0.2, 0.3}) {
    StudyRow row;
    row.run.averages.values[static_cast<int>(Observable::inertial_number)] = {state, 0};
    row.run.averages.values[static_cast<int>(Observable::mu_star)] = {
        0.26 + 1.1 * state + curvature * state * state + error * random.normal(), error};
    row.run.averages.values[static_cast<int>(Observable::solid_fraction)] = {
        0.82 - 0.37 * state + 0.1 * error * random.normal(), 0.1 * error};
    rows.push_back(row);
  }
  return rows;
}

std::vector<const StudyRow*> pointers(const std::vector<StudyRow>& rows) {
  std::vector<const StudyRow*> all;
  for (const StudyRow& row : rows) all.push_back(&row);
  return all;
}

TEST(StudyFit, ErrorsAreThoseOfTheScatterOverManySamples) {
  // Pulls (fit - truth) / error have variance 1, a little less where the scatter of 6 points widens the errors by
  // chance: over 400 samples the mean square lies within 0.2 of 0.75 to 1, its own standard error being sqrt(2 / 400) =
  // 0.07.
  constexpr int samples = 400;
  double intercept = 0, slope = 0, fraction = 0, dilatancy = 0;
  for (int k = 0; k < samples; ++k) {
    const std::vector<StudyRow> rows = synthetic_rows(k + 1, 0.004, 0);
    const FlowFit fit = fit_flow(pointers(rows));
    ASSERT_EQ(fit.points, 6);  // I = 0.001 and 0.3 are outside of the window
    intercept += std::pow((fit.mu_min.value - 0.26) / fit.mu_min.error, 2) / samples;
    slope += std::pow((fit.b.value - 1.1) / fit.b.error, 2) / samples;
    fraction += std::pow((fit.solid_fraction_max.value - 0.82) / fit.solid_fraction_max.error, 2) / samples;
    dilatancy += std::pow((fit.a.value - 0.37) / fit.a.error, 2) / samples;
  }
  for (const double pull : {intercept, slope, fraction, dilatancy}) {
    EXPECT_GT(pull, 0.55);
    EXPECT_LT(pull, 1.2);
  }
}

TEST(StudyFit, ScatterAboutTheLineWidensTheErrors) {
  const std::vector<StudyRow> straight = synthetic_rows(1, 1e-4, 0), bent = synthetic_rows(1, 1e-4, -1);
  EXPECT_GT(fit_flow(pointers(bent)).b.error, 10 * fit_flow(pointers(straight)).b.error);
  EXPECT_TRUE(std::isnan(fit_flow({}).b.value));
}

TEST(StudyFit, ScatterBelowTheErrorsChangesNothing) {
  const LineFit fit{{1, 0.5}, {2, 0.25}, 1.0};
  EXPECT_EQ(with_scatter(fit, 5).slope.error, 0.25);
  // chi^2 = 12 for 5 points: 3 spare, factor 2.
  EXPECT_DOUBLE_EQ(with_scatter({{1, 0.5}, {2, 0.25}, 12.0}, 5).slope.error, 0.5);
  EXPECT_DOUBLE_EQ(with_scatter({{1, 0.5}, {2, 0.25}, 12.0}, 2).slope.error, 0.25);
}

TEST(StudyFit, BandOfAPublishedLine) {
  const Series band = published_line("line", {0.26, 0.03}, {1.0, 0.4}, 0.01, 0.1);
  EXPECT_TRUE(band.band);
  EXPECT_DOUBLE_EQ(band.x.front(), 0.01);
  EXPECT_NEAR(band.y.back(), 0.36, 1e-12);
  EXPECT_NEAR(band.y_error.back(), 0.05, 1e-12);  // 0.03 and 0.4 * 0.1
}

}  // namespace
}  // namespace galet::test::study_statistics_test
