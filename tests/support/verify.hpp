// The cases of `galet verify` of one length, one test each.
#pragma once

#include <gtest/gtest.h>

#include "src/verify/output.hpp"

namespace galet::test {

inline std::vector<const verify::Case*> cases_of(verify::Effort effort) {
  std::vector<const verify::Case*> cases;
  for (const verify::Case& each : verify::all_cases())
    if (each.effort == effort) cases.push_back(&each);
  return cases;
}

inline std::string name_of_case(const testing::TestParamInfo<const verify::Case*>& info) { return info.param->name; }

inline void expect_pass(const verify::Case& which) {
  const auto outcomes = verify::run_cases({&which}, {EngineKind::md, EngineKind::cd});
  EXPECT_TRUE(verify::all_pass(outcomes)) << verify::to_text(outcomes);
}

}  // namespace galet::test
