#include "src/verify/registry.hpp"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>

#include "common/core/clock.hpp"
#include "common/core/error.hpp"
#include "common/core/near_match.hpp"
#include "src/engines.hpp"

namespace galet::verify {

const std::vector<Case>& all_cases() {
  static const std::vector<Case> cases = [] {
    std::vector<Case> all;
    for (const auto family :
         {statics_cases, pile_cases, impact_cases, slope_cases, gas_cases, lattice_cases, packing_cases, extreme_cases})
      for (Case& each : family()) all.push_back(std::move(each));
    return all;
  }();
  return cases;
}

namespace {

bool tagged(const Case& which, const std::string& tag) {
  return std::find(which.tags.begin(), which.tags.end(), tag) != which.tags.end();
}

/// Names and tags, each once.
std::vector<std::string> known_names() {
  std::vector<std::string> known;
  const auto add = [&](const std::string& name) {
    if (std::find(known.begin(), known.end(), name) == known.end()) known.push_back(name);
  };
  for (const Case& which : all_cases()) add(which.name);
  for (const Case& which : all_cases())
    for (const std::string& tag : which.tags) add(tag);
  return known;
}

}  // namespace

std::vector<const Case*> select_cases(const std::vector<std::string>& names, Effort effort) {
  const std::vector<std::string> known = known_names();
  std::vector<Mistake> mistakes;
  for (const std::string& name : names)
    if (std::find(known.begin(), known.end(), name) == known.end())
      mistakes.push_back({"", 0, 0,
                          fmt::format("there is no case or tag called {}{}; galet verify --list shows them",
                                      in_quotes(name), suggestion(name, known))});
  if (!mistakes.empty()) throw InputError(mistakes);
  std::vector<const Case*> chosen;
  for (const Case& which : all_cases()) {
    const bool named = std::find(names.begin(), names.end(), which.name) != names.end();
    const bool meant = names.empty() || std::any_of(names.begin(), names.end(),
                                                    [&](const std::string& name) { return tagged(which, name); });
    if (named || (meant && which.effort <= effort)) chosen.push_back(&which);
  }
  return chosen;
}

std::string to_string(Verdict verdict) {
  switch (verdict) {
    case Verdict::pass:
      return "pass";
    case Verdict::fail:
      return "FAIL";
    case Verdict::refused:
      return "refused";
    case Verdict::absent:
      return "none";
  }
  return "";
}

namespace {

/// What an engine that stopped makes of the case.
void judge_stop(const Part& part, const std::string& said, Outcome& outcome) {
  const bool expected = part.stance == Stance::refuses && said.find(part.why) != std::string::npos;
  outcome.verdict = expected ? Verdict::refused : Verdict::fail;
  outcome.reason = said;
}

}  // namespace

Outcome run_case(const Case& which, EngineKind engine) {
  const Part& part = which.part(engine);
  Outcome outcome{.of = &which, .engine = engine, .verdict = Verdict::absent, .reason = part.why, .checks = {}};
  if (part.stance == Stance::absent) return outcome;
  outcome.reason.clear();
  Report report;
  const double start = thread_seconds();
  try {
    which.run(engine, report);
    const std::vector<Check>& checks = report.checks();
    const bool pass =
        !checks.empty() && std::all_of(checks.begin(), checks.end(), [](const Check& check) { return check.pass(); });
    outcome.verdict = pass ? Verdict::pass : Verdict::fail;
    if (part.stance == Stance::refuses) {
      outcome.verdict = Verdict::fail;
      outcome.reason = fmt::format("{} should have refused this: {}", engine_name(engine), part.why);
    }
  } catch (const InputError& error) {
    judge_stop(part, error.mistakes().empty() ? error.what() : error.mistakes().front().message, outcome);
  } catch (const std::exception& error) {
    judge_stop(part, error.what(), outcome);
  }
  outcome.seconds = thread_seconds() - start;
  outcome.checks = report.checks();
  outcome.steps = report.steps();
  return outcome;
}

std::vector<Outcome> run_cases(const std::vector<const Case*>& cases, const std::vector<EngineKind>& engines,
                               const Progress& progress) {
  std::vector<Outcome> outcomes;
  for (const Case* which : cases)
    for (const EngineKind engine : engines) {
      if (progress) progress(outcomes.size(), *which, engine);
      outcomes.push_back(run_case(*which, engine));
    }
  return outcomes;
}

bool all_pass(const std::vector<Outcome>& outcomes) {
  return std::none_of(outcomes.begin(), outcomes.end(),
                      [](const Outcome& outcome) { return outcome.verdict == Verdict::fail; });
}

}  // namespace galet::verify
