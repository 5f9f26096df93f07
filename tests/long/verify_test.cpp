// The quick cases of `galet verify`.
#include "tests/support/verify.hpp"

namespace galet::test::verify_test {
namespace {

class QuickCases : public testing::TestWithParam<const verify::Case*> {};

TEST_P(QuickCases, HaveTheKnownAnswer) { expect_pass(*GetParam()); }

INSTANTIATE_TEST_SUITE_P(Verify, QuickCases, testing::ValuesIn(cases_of(verify::Effort::quick)), name_of_case);

}  // namespace
}  // namespace galet::test::verify_test
