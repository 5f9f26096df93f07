#include "src/verify/output.hpp"

#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "src/engines.hpp"
#include "src/text_table.hpp"

namespace galet::verify {

namespace {

using Json = nlohmann::ordered_json;

std::string number(double value) { return short_number(value, 6); }
std::string small_number(double value) { return value == 0 ? "0" : fmt::format("{:.1e}", value); }

const char* name_of(Effort effort) {
  return effort == Effort::brief ? "brief" : effort == Effort::quick ? "quick" : "full";
}

/// "12 passed, 1 failed, 2 refused, 1 without meaning".
std::string counts(const std::vector<Outcome>& outcomes) {
  int of[4] = {0, 0, 0, 0};
  double seconds = 0;
  for (const Outcome& outcome : outcomes) ++of[static_cast<int>(outcome.verdict)], seconds += outcome.seconds;
  return fmt::format("{} passed, {} failed, {} refused as they must, {} without meaning for the engine; {}", of[0],
                     of[1], of[2], of[3], duration_text(seconds));
}

std::string cost(const Outcome& outcome) { return fmt::format("{:.2f}", outcome.seconds); }

}  // namespace

std::string to_text(const std::vector<Outcome>& outcomes) {
  TextTable table({"case", "engine", "value", "exact", "error", "bound", "seconds", "steps", "result", "quantity"});
  std::string remarks;
  for (const Outcome& outcome : outcomes) {
    const std::string engine = engine_name(outcome.engine), verdict = to_string(outcome.verdict);
    if (outcome.checks.empty())
      table.add(
          {outcome.of->name, engine, "-", "-", "-", "-", cost(outcome), fmt::format("{}", outcome.steps), verdict, ""});
    bool first = true;
    for (const Check& check : outcome.checks) {
      table.add({first ? outcome.of->name : "", first ? engine : "", number(check.value), number(check.exact),
                 small_number(check.error), small_number(check.bound), first ? cost(outcome) : "",
                 first ? fmt::format("{}", outcome.steps) : "", check.pass() ? "pass" : "FAIL", check.quantity});
      first = false;
      if (!check.pass())
        remarks += fmt::format("{} {}: {}: error {:.2e} above {:.2e} ({})\n", outcome.of->name, engine, check.quantity,
                               check.error, check.bound, check.reason);
    }
    if (!outcome.reason.empty())
      remarks += fmt::format("{} {} {}: {}\n", outcome.of->name, engine, verdict, outcome.reason);
  }
  return table.text() + "\n" + remarks + (remarks.empty() ? "" : "\n") + counts(outcomes) + "\n";
}

std::string to_json(const std::vector<Outcome>& outcomes) {
  Json json;
  json["cases"] = Json::array();
  for (const Outcome& outcome : outcomes) {
    const bool pass = outcome.verdict != Verdict::fail;
    const auto entry = [&](const Check* check) {
      Json row{{"case", outcome.of->name}, {"engine", engine_name(outcome.engine)}};
      row["quantity"] = check ? Json(check->quantity) : Json(nullptr);
      row["value"] = check ? Json(check->value) : Json(nullptr);
      row["exact"] = check ? Json(check->exact) : Json(nullptr);
      row["error"] = check ? Json(check->error) : Json(nullptr);
      row["tolerance"] = check ? Json(check->bound) : Json(nullptr);
      row["reason"] = check ? check->reason : outcome.reason;
      row["pass"] = check ? check->pass() : pass;
      row["verdict"] = to_string(outcome.verdict);
      row["seconds"] = outcome.seconds, row["steps"] = outcome.steps;
      json["cases"].push_back(row);
    };
    for (const Check& check : outcome.checks) entry(&check);
    // A stop after some checks, too, must be seen.
    if (outcome.checks.empty() || (!pass && !outcome.reason.empty())) entry(nullptr);
  }
  json["pass"] = all_pass(outcomes);
  return json.dump(2);
}

std::string to_markdown(const std::vector<Outcome>& outcomes) {
  std::string text = counts(outcomes) + ".\n";
  const Case* shown = nullptr;
  for (const Outcome& outcome : outcomes) {
    const Case& of = *outcome.of;
    if (shown != &of) {
      shown = &of;
      text += fmt::format("\n## {}\n\n{}. Exact: {}. Trouble would be: {}. Tags: {}.\n\n", of.name, of.scene, of.exact,
                          of.trouble, fmt::join(of.tags, ", "));
      text +=
          "| engine | quantity | value | exact | error | bound | why this bound | result "
          "|\n|---|---|---|---|---|---|---|---|\n";
    }
    const std::string engine = engine_name(outcome.engine);
    for (const Check& check : outcome.checks)
      text += fmt::format("| {} | {} | {} | {} | {} | {} | {} | {} |\n", engine, check.quantity, number(check.value),
                          number(check.exact), small_number(check.error), small_number(check.bound), check.reason,
                          check.pass() ? "pass" : "**FAIL**");
    if (!outcome.reason.empty())
      text += fmt::format("| {} | | | | | | {} | {} |\n", engine, outcome.reason, to_string(outcome.verdict));
    if (outcome.steps > 0)
      text += fmt::format("| {} | cost: {} s, {} steps | | | | | | |\n", engine, cost(outcome), outcome.steps);
  }
  return text;
}

std::string list_text(const std::vector<const Case*>& cases) {
  TextTable table({"case", "length", "engines", "tags", "scene"});
  for (const Case* each : cases) {
    std::string engines;
    for (const EngineKind kind : {EngineKind::md, EngineKind::cd}) {
      const Stance stance = each->part(kind).stance;
      if (stance == Stance::absent) continue;
      engines += fmt::format("{}{}{}", engines.empty() ? "" : " ", engine_name(kind),
                             stance == Stance::refuses ? " (refuses)" : "");
    }
    table.add({each->name, name_of(each->effort), engines, fmt::format("{}", fmt::join(each->tags, " ")), each->scene});
  }
  return table.text();
}

std::string list_json(const std::vector<const Case*>& cases) {
  Json json;
  json["cases"] = Json::array();
  for (const Case* each : cases)
    json["cases"].push_back({{"case", each->name},
                             {"length", name_of(each->effort)},
                             {"tags", each->tags},
                             {"scene", each->scene},
                             {"exact", each->exact},
                             {"trouble", each->trouble}});
  return json.dump(2);
}

}  // namespace galet::verify
