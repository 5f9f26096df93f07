// Small random contact problems in every dimension against what enumeration says of them; more of them: tests/long.
#include <gtest/gtest.h>

#include "tests/support/oracle_check.hpp"

namespace galet::cd::contact_oracle_test {
namespace {

TEST(ContactOracle, AnswersHaveAnExactSolutionBesideThem) {
  for (const int block : {2, 3, 5}) expect_sound(check_random_problems(block, 60, 10));
}

// Where friction is small and W regular there is one solution: that of the enumeration.
TEST(ContactOracle, EnumerationFindsTheAnswer) {
  std::mt19937 random(5);
  for (const int block : {2, 3, 5})
    for (int k = 0; k < 6; ++k) {
      RandomContacts kind;
      kind.block = block;
      kind.contacts = block == 5 ? 1 : 2;
      kind.freedoms = 4 * block * kind.contacts;
      kind.mu = 0.05, kind.mu_r = 0.02;
      const DiscreteProblem problem = random_contacts(kind, random);
      const ContactOracle oracle(problem);
      const auto found = oracle.enumerate(block == 2 ? 2 : 4, 1e-13L);
      ASSERT_EQ(found.size(), 1u) << "block " << block;
      DiscreteOptions options;
      options.error = 1e-11;
      const DiscreteSolution solution = solve(problem, options);
      ASSERT_TRUE(solution.converged);
      // The condition of such W is below 100.
      EXPECT_LT(static_cast<double>((oracle.scaled(solution.r) - found[0]).norm()), 1e-8);
    }
}

// One contact and W = I: the enumeration against the closed form.
TEST(ContactOracle, EnumeratesOneContact) {
  DiscreteProblem problem;
  problem.block = 3;
  problem.mu = {0.5};
  problem.start = {0, 1, 2, 3}, problem.column = {0, 1, 2}, problem.value = {1, 1, 1};
  const auto only = [&](std::vector<double> q) {
    problem.q = std::move(q);
    const auto found = ContactOracle(problem).enumerate(4, 1e-13L);
    EXPECT_EQ(found.size(), 1u);
    return found.empty() ? ContactOracle::VectorX(3) : found[0];
  };
  EXPECT_EQ(only({1, 2, 3}).norm(), 0);                                                                  // open
  EXPECT_LT((only({-1, 0.3, -0.2}) - Eigen::Vector3d(1, -0.3, 0.2).cast<long double>()).norm(), 1e-15);  // held
  EXPECT_LT((only({-1, 3, 4}) - Eigen::Vector3d(1, -0.3, -0.4).cast<long double>()).norm(), 1e-15);      // sliding
}

}  // namespace
}  // namespace galet::cd::contact_oracle_test
