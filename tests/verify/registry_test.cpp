// The registry of `galet verify`: names, selection, verdicts and outputs. (The cases themselves:
// tests/verify/brief_cases_test.cpp and tests/long/verify_test.cpp.)
#include <set>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "common/core/error.hpp"
#include "src/verify/output.hpp"

namespace galet::test::registry_test {
namespace {

using namespace verify;

TEST(Verify, CasesAreNamedOnceAndSayWhatTheyAre) {
  std::set<std::string> names;
  for (const Case& each : all_cases()) {
    SCOPED_TRACE(each.name);
    EXPECT_TRUE(names.insert(each.name).second);
    EXPECT_FALSE(each.tags.empty());
    EXPECT_FALSE(each.scene.empty() || each.exact.empty() || each.trouble.empty());
    for (const Part& part : {each.md, each.cd}) EXPECT_EQ(part.stance == Stance::runs, part.why.empty());
  }
  for (const Case& each : all_cases())
    for (const std::string& tag : each.tags) EXPECT_FALSE(names.contains(tag)) << tag << " is a case and a tag";
}

TEST(Verify, SelectsByNameTagAndLength) {
  EXPECT_EQ(select_cases({}, Effort::full).size(), all_cases().size());
  const auto columns = select_cases({"column"}, Effort::full), brief = select_cases({"column"}, Effort::brief);
  ASSERT_GE(columns.size(), 3u);
  EXPECT_LT(brief.size(), columns.size());
  const auto named = select_cases({"column_1000"}, Effort::brief);
  ASSERT_EQ(named.size(), 1u) << "a case that is named is meant, whatever its length";
  EXPECT_EQ(named[0]->name, "column_1000");
  EXPECT_EQ(select_cases({"cradle_3", "cradle"}, Effort::full).size(), select_cases({"cradle"}, Effort::full).size());
}

TEST(Verify, UnknownNamesAreReportedTogetherWithNearOnes) {
  try {
    select_cases({"colunm_10", "cradel", "groove"}, Effort::full);
    FAIL() << "nothing was refused";
  } catch (const InputError& error) {
    ASSERT_EQ(error.mistakes().size(), 2u);
    EXPECT_NE(error.mistakes()[0].message.find("did you mean \"column_10\"?"), std::string::npos);
    EXPECT_NE(error.mistakes()[1].message.find("did you mean \"cradle\"?"), std::string::npos);
  }
}

Case one_check(double value) {
  Case made{.name = "made", .tags = {"test"}, .scene = "none", .exact = "1", .trouble = "none", .run = {}};
  made.run = [value](EngineKind, Report& report) { report.near("value", value, 1, 0.1, "by hand"); };
  return made;
}

TEST(Verify, Verdicts) {
  EXPECT_EQ(run_case(one_check(1.05), EngineKind::md).verdict, Verdict::pass);
  EXPECT_EQ(run_case(one_check(1.2), EngineKind::md).verdict, Verdict::fail);
  EXPECT_EQ(run_case(one_check(NAN), EngineKind::md).verdict, Verdict::fail);
  Case empty = one_check(1);
  empty.run = [](EngineKind, Report&) {};
  EXPECT_EQ(run_case(empty, EngineKind::cd).verdict, Verdict::fail) << "a case without a check shows nothing";
  Case stops = one_check(1);
  stops.run = [](EngineKind, Report&) { throw RunError("grain 3 overlaps"); };
  EXPECT_EQ(run_case(stops, EngineKind::md).verdict, Verdict::fail);
  stops.md = {Stance::refuses, "overlap"};
  const Outcome refused = run_case(stops, EngineKind::md);
  EXPECT_EQ(refused.verdict, Verdict::refused);
  EXPECT_EQ(refused.reason, "grain 3 overlaps");
  stops.md.why = "restitution";
  EXPECT_EQ(run_case(stops, EngineKind::md).verdict, Verdict::fail) << "refused for another reason";
  Case goes_on = one_check(1);
  goes_on.md = {Stance::refuses, "overlap"};
  EXPECT_EQ(run_case(goes_on, EngineKind::md).verdict, Verdict::fail) << "was to refuse";
  goes_on.md = {Stance::absent, "no meaning"};
  EXPECT_EQ(run_case(goes_on, EngineKind::md).verdict, Verdict::absent);
}

TEST(Verify, JsonHasAnEntryPerCheck) {
  const Case good = one_check(1.05), bad = one_check(3);
  const std::vector<Outcome> outcomes{run_case(good, EngineKind::md), run_case(bad, EngineKind::cd)};
  EXPECT_FALSE(all_pass(outcomes));
  const nlohmann::json json = nlohmann::json::parse(to_json(outcomes));
  ASSERT_EQ(json["cases"].size(), 2u);
  EXPECT_EQ(json["pass"], false);
  const nlohmann::json& first = json["cases"][0];
  EXPECT_EQ(first["case"], "made");
  EXPECT_EQ(first["engine"], "md");
  EXPECT_EQ(first["quantity"], "value");
  EXPECT_DOUBLE_EQ(first["value"].get<double>(), 1.05);
  EXPECT_DOUBLE_EQ(first["error"].get<double>(), 1.05 - 1);
  EXPECT_EQ(first["exact"], 1.0);
  EXPECT_EQ(first["tolerance"], 0.1);
  EXPECT_EQ(first["pass"], true);
  EXPECT_TRUE(first["seconds"].is_number());
  EXPECT_EQ(json["cases"][1]["pass"], false);
  EXPECT_NE(to_text(outcomes).find("1 passed, 1 failed"), std::string::npos);
  EXPECT_NE(to_markdown(outcomes).find("**FAIL**"), std::string::npos);
}

}  // namespace
}  // namespace galet::test::registry_test
