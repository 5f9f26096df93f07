// Ten thousand small random contact problems against what enumeration says of them (tests/support/contact_oracle.hpp).
#include <gtest/gtest.h>

#include "tests/support/oracle_check.hpp"

namespace galet::cd::contact_oracle_test {
namespace {

void check_many(int block) {
  const OracleCount count = check_random_problems(block, 2400, 10);
  std::printf("%s\n", text_of(count).c_str());
  expect_sound(count);
}

TEST(ContactOracle, ManyRandomProblems2D) { check_many(2); }
TEST(ContactOracle, ManyRandomProblems3D) { check_many(3); }
TEST(ContactOracle, ManyRandomProblemsWithRolling) { check_many(5); }

// W is then singular to eight digits beside what is truly singular, so that errS says less of the impulses: no answer
// to a problem without one, no wrong blame, no NaN, no endless loop (all in check_problem) is what remains.
TEST(ContactOracle, ManyRandomProblemsWithUnlikeMasses) {
  OracleCount count;
  for (const int block : {2, 3, 5}) count += check_random_problems(block, 940, 1e8);
  std::printf("%s\n", text_of(count).c_str());
  SCOPED_TRACE(text_of(count));
  EXPECT_GE(count.solved + count.none, count.asked * 97 / 100);
  EXPECT_GE(count.blamed, count.proved * 95 / 100);
  EXPECT_GE(count.near, count.solved * 99 / 100);
}

}  // namespace
}  // namespace galet::cd::contact_oracle_test
