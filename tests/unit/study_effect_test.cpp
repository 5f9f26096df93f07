// The test of the study of regimes: intervals against thresholds, Student's quantiles, and how often it is wrong.
#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "common/core/random.hpp"
#include "src/studies/effect.hpp"

namespace galet::test::study_effect_test {
namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

Effect effect(double change, double error, double threshold = 0.05, double quantile = 2) {
  return {{change, error}, threshold, quantile};
}

TEST(StudyEffect, LetterFollowsTheInterval) {
  EXPECT_EQ(letter_of(effect(0.08, 0.014)), 'Y');
  EXPECT_EQ(letter_of(effect(-0.08, 0.014)), 'Y');  // either way
  EXPECT_EQ(letter_of(effect(0.08, 0.016)), '?');
  EXPECT_EQ(letter_of(effect(0.02, 0.014)), 'N');
  EXPECT_EQ(letter_of(effect(-0.02, 0.016)), '?');
  EXPECT_EQ(letter_of(effect(0.02, 0.014, 0.05, 4.303)), '?');  // three samples
  EXPECT_EQ(letter_of(effect(nothing, 0.01)), '?');
  EXPECT_EQ(letter_of(effect(0.01, nothing)), '?');
}

TEST(StudyEffect, OneQuantityIsEnoughForYesAndAllAreNeededForNo) {
  const Effect yes = effect(0.2, 0.01), no = effect(0, 0.01), open = effect(0.05, 0.01);
  EXPECT_EQ(letter_of(std::vector{no, yes}), 'Y');
  EXPECT_EQ(letter_of(std::vector{open, yes}), 'Y');
  EXPECT_EQ(letter_of(std::vector{no, no}), 'N');
  EXPECT_EQ(letter_of(std::vector{no, open}), '?');
  EXPECT_EQ(letter_of(std::vector<Effect>{}), '?');
  EXPECT_EQ(decisive_effect(std::vector{no, yes, open}).change.value, 0.2);
  EXPECT_EQ(decisive_effect(std::vector{no, open}).change.value, 0.05);
  // The letter can be read off the size in thresholds and two of its errors.
  const Estimate size = in_thresholds(effect(-0.2, 0.01, 0.05, 4));
  EXPECT_DOUBLE_EQ(size.value, 4);
  EXPECT_DOUBLE_EQ(2 * size.error, 4 * 0.01 / 0.05);
}

TEST(StudyEffect, ChangesOfAveragesAndOfPairs) {
  const Effect averages = effect_of_averages({2, 0.02}, {3, 0.03}, 0.05);
  EXPECT_DOUBLE_EQ(averages.change.value, 0.5);
  EXPECT_NEAR(averages.change.error, 1.5 * std::hypot(0.01, 0.01), 1e-15);
  // Samples differ by much, and their pairs by little: 10 %, 20 % and 30 %.
  const std::vector<double> before = {1, 10, 100}, after = {1.1, 12, 130};
  const Effect pairs = effect_of_pairs(before, after, 0.05);
  EXPECT_NEAR(pairs.change.value, 0.2, 1e-15);
  EXPECT_NEAR(pairs.change.error, 0.1 / std::sqrt(3), 1e-15);
  EXPECT_EQ(pairs.quantile, student_quantile(2));
  EXPECT_EQ(letter_of(effect_of_pairs(std::vector{1.0}, std::vector{2.0}, 0.05)), '?');
}

/// Distribution function of Student's law from -infinity to t by Simpson's rule on its density; the constant is that of
/// the normalised one.
double student_distribution(double t, int n) {
  const double constant = std::exp(std::lgamma(0.5 * (n + 1)) - std::lgamma(0.5 * n)) / std::sqrt(n * 3.14159265358979);
  constexpr int intervals = 2000;
  double sum = 0;
  for (int k = 0; k <= intervals; ++k) {
    const double x = t * k / intervals, weight = k == 0 || k == intervals ? 1 : k % 2 == 1 ? 4 : 2;
    sum += weight * constant * std::pow(1 + x * x / n, -0.5 * (n + 1));
  }
  return 0.5 + sum * t / intervals / 3;
}

TEST(StudyEffect, QuantilesAreThoseOfStudent) {
  // Table of three decimals, expansion of error below 1e-3; the density at the quantile is below 0.06.
  for (int n = 1; n < 60; ++n) EXPECT_NEAR(student_distribution(student_quantile(n), n), 0.975, 1e-4) << n;
  EXPECT_THROW(student_quantile(0), std::invalid_argument);
}

TEST(StudyEffect, IsRarelyWrongWhereTheTruthIsTheThreshold) {
  // A true change of exactly the threshold is called Y in 2.5 % of the samples and N in as many. 4000 samples: the
  // standard error is 0.25 %, four of them are 1 %.
  constexpr int samples = 4000, size = 4;
  int yes = 0, no = 0;
  for (int k = 0; k < samples; ++k) {
    RandomStream random(7, k);
    std::vector<double> before, after;
    for (int s = 0; s < size; ++s) before.push_back(1), after.push_back(1.05 + 0.01 * random.normal());
    const char letter = letter_of(effect_of_pairs(before, after, 0.05));
    yes += letter == 'Y', no += letter == 'N';
  }
  EXPECT_NEAR(yes / double(samples), 0.025, 0.01);
  EXPECT_NEAR(no / double(samples), 0.025, 0.01);
}

}  // namespace
}  // namespace galet::test::study_effect_test
