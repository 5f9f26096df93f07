// The brief cases of `galet verify`.
#include "tests/support/verify.hpp"

namespace galet::test::brief_cases_test {
namespace {

class BriefCases : public testing::TestWithParam<const verify::Case*> {};

TEST_P(BriefCases, HaveTheKnownAnswer) { expect_pass(*GetParam()); }

INSTANTIATE_TEST_SUITE_P(Verify, BriefCases, testing::ValuesIn(cases_of(verify::Effort::brief)), name_of_case);

}  // namespace
}  // namespace galet::test::brief_cases_test
