// Advice from comparisons whose rows are made up, so that the answer is known.
#include "src/advice.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "common/core/error.hpp"

namespace galet::test::advice_test {
namespace {

CompareRow row_of(EngineKind engine, double parameter, double mu_star, double noise, double cost) {
  CompareRow row;
  row.plan.engine = engine;
  row.plan.inertial_number = 0.1;
  row.mu_star = {mu_star, noise};
  row.solid_fraction = {0.8, 1e-3};
  row.z = {2, 1e-2};
  row.cost = cost;
  if (engine == EngineKind::md)
    row.plan.stiffness_level = row.stiffness_level = parameter, row.dt = 1e-3;
  else
    row.plan.tolerance = 1e-4, row.plan.dt_factor = row.dt = parameter;
  return row;
}

/// mu* = 0.4 (1 - 40 / kappa) in md, whose cost is sqrt(kappa / 1e4); 0.4 (1 + dt) in cd, whose cost is 0.01 / dt.
Comparison made_up(double noise) {
  Comparison comparison;
  comparison.shear = true;
  for (const double kappa : {1e3, 1e4, 1e5})
    comparison.rows.push_back(row_of(EngineKind::md, kappa, 0.4 * (1 - 40 / kappa), noise, std::sqrt(kappa / 1e4)));
  for (const double dt : {0.04, 0.02, 0.01})
    comparison.rows.push_back(row_of(EngineKind::cd, dt, 0.4 * (1 + dt), noise, 0.01 / dt));
  comparison.limits = state_limits(comparison.rows);
  return comparison;
}

TEST(Advice, TakesTheCheapestRunThatIsNearEnough) {
  const Comparison comparison = made_up(1e-5);
  const auto all = advise(comparison, 0.045);
  ASSERT_EQ(all.size(), 1u);
  ASSERT_TRUE(all[0].md && all[0].cd);
  EXPECT_EQ(all[0].md->parameter, 1e3);  // off by 4 %
  EXPECT_EQ(all[0].cd->parameter, 0.04);
  EXPECT_FALSE(all[0].md->extrapolated);
  EXPECT_EQ(all[0].chosen()->engine, EngineKind::cd);  // 0.25 against 0.32
  const auto finer = advise(comparison, 0.005);
  EXPECT_EQ(finer[0].md->parameter, 1e4);
  EXPECT_EQ(finer[0].chosen()->engine, EngineKind::md);  // cd needs dt = 0.005, at twice the cost
}

TEST(Advice, ExtrapolatesWhereNoRunIsFineEnough) {
  const Comparison comparison = made_up(1e-5);
  const Advice advice = advise(comparison, 0.005)[0];
  ASSERT_TRUE(advice.cd && advice.cd->extrapolated);
  EXPECT_NEAR(advice.cd->parameter, 0.005, 1e-5);  // the noise of the slope
  EXPECT_NEAR(advice.cd->cost, 2, 5e-3);
  const Advice finest = advise(comparison, 1e-4)[0];
  ASSERT_TRUE(finest.md && finest.md->extrapolated);
  EXPECT_NEAR(finest.md->parameter, 4e5, 2e3);
  EXPECT_NEAR(finest.md->cost, std::sqrt(40.0), 0.02);
  EXPECT_NE(advice_text({finest}, comparison).find("extrapolated"), std::string::npos);
}

TEST(Advice, SaysWhenNoiseHidesTheError) {
  const Comparison comparison = made_up(0.02);
  const Advice advice = advise(comparison, 0.01)[0];
  EXPECT_FALSE(advice.md || advice.cd);
  EXPECT_EQ(advice.chosen(), nullptr);
  EXPECT_GT(advice.least_noise, 0.1);  // two errors of 5 % each
  EXPECT_NE(advice_text({advice}, comparison).find("times as long"), std::string::npos);
}

TEST(Advice, WantsAShare) {
  const Comparison comparison = made_up(1e-5);
  for (const double error : {0.0, -0.1, 1.0, std::nan("")}) EXPECT_THROW(advise(comparison, error), InputError);
}

}  // namespace
}  // namespace galet::test::advice_test
