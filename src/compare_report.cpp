#include "src/compare_report.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "src/engines.hpp"
#include "src/text_table.hpp"

namespace galet {

namespace {

std::string optional_number(const std::optional<double>& value) { return value ? short_number(*value) : "-"; }

const StateLimit* limit_of(const CompareRow& row, const Comparison& comparison) {
  for (const StateLimit& state : comparison.limits)
    if (state.inertial_number == row.plan.inertial_number) return &state;
  return nullptr;
}

const char* cost_unit(const Comparison& comparison) { return comparison.shear ? "s/strain" : "s/time"; }

std::vector<std::string> cells(const CompareRow& row, const Comparison& comparison) {
  const auto off = deviation_of(row, comparison);
  return {engine_name(row.plan.engine),
          optional_number(row.plan.stiffness_level),
          short_number(row.dt, 3),
          optional_number(row.plan.tolerance),
          with_error(row.mu_star),
          with_error(row.solid_fraction),
          with_error(row.z),
          short_number(row.peak_penetration, 2),
          short_number(row.cost, 3),
          off ? with_error(*off) : "-"};
}

std::string state_name(const std::optional<double>& inertial_number) {
  return inertial_number ? fmt::format("I = {:g}", *inertial_number) : "the scene's state";
}

/// "mu*   md 0.3871 ±0.0012   cd ...   both ...   agree".
void add_limit(TextTable& table, const std::string& name, const RigidLimit& limit) {
  const auto engine = [](const std::optional<EngineLimit>& of) {
    if (!of) return std::string("-");
    if (!of->on_line) return std::string("not on a line");
    return with_error(of->value) + (of->runs == 1 ? " *" : "");
  };
  const bool no_line = (limit.md && !limit.md->on_line) || (limit.cd && !limit.cd->on_line);
  const std::string verdict = no_line ? "no limit" : !limit.agree ? "-" : *limit.agree ? "agree" : "DIFFER";
  const bool judged = limit.difference && !no_line;
  table.add({name, engine(limit.md), engine(limit.cd), judged ? with_error(*limit.difference) : "-", verdict,
             no_line ? "-" : with_error(limit.combined)});
}

std::string limits_text(const StateLimit& state) {
  TextTable table({"rigid limit", "md (1/kappa -> 0)", "cd (dt -> 0)", "md - cd", "within 2 errors", "both"});
  add_limit(table, "mu*", state.mu_star);
  add_limit(table, "Phi", state.solid_fraction);
  add_limit(table, "z", state.z);
  std::string text = table.text("  ");
  const auto single = [](const std::optional<EngineLimit>& limit) { return limit && limit->runs == 1; };
  if (single(state.mu_star.md) || single(state.mu_star.cd)) text += "  * a single run, not extrapolated\n";
  return text;
}

/// Is the result still sensitive to kappa? The slope of the md line, and what it means at the softest level.
std::string sensitivity_text(const StateLimit& state, const Comparison& comparison) {
  const Judged quantity = judged(comparison);
  const auto& md = (state.*quantity.limit).md;
  if (!md || md->runs < 2 || !(md->slope.error > 0)) return "";
  double softest = INFINITY;
  for (const CompareRow& row : comparison.rows)
    if (row.plan.inertial_number == state.inertial_number && row.plan.stiffness_level)
      softest = std::min(softest, *row.plan.stiffness_level);
  const Estimate effect{md->slope.value / softest, md->slope.error / softest};
  const bool visible = std::abs(effect.value) > 2 * effect.error;
  return fmt::format("  stiffness: at kappa = {:g} {} is off by {}: {}\n", softest, quantity.name, with_error(effect),
                     visible ? "the result is still sensitive to kappa there" : "no effect of kappa beyond the noise");
}

std::string cheapest_text(const StateLimit& state, const Comparison& comparison) {
  std::string text;
  const auto line = [&](const CompareRow* row, const std::string& parameters) {
    if (!row) return;
    text += fmt::format("  cheapest {} row within 2 errors of the limit: {} ({} off by {}), {} {}\n",
                        engine_name(row->plan.engine), parameters, judged(comparison).name,
                        with_error(*deviation_of(*row, comparison)), short_number(row->cost, 3), cost_unit(comparison));
  };
  const CompareRow* md = cheapest_within_error(comparison, state, EngineKind::md);
  const CompareRow* cd = cheapest_within_error(comparison, state, EngineKind::cd);
  if (md) line(md, "kappa = " + short_number(md->plan.stiffness_level.value_or(md->stiffness_level)));
  if (cd) line(cd, fmt::format("dt = {}, tolerance {}", short_number(cd->dt, 3), optional_number(cd->plan.tolerance)));
  if (md && cd && md->cost > 0 && cd->cost > 0)
    text += fmt::format("  of these two, {} is {:.1f} times cheaper\n", md->cost < cd->cost ? "md" : "cd",
                        std::max(md->cost, cd->cost) / std::min(md->cost, cd->cost));
  return text;
}

std::string state_text(const std::optional<double>& inertial_number, const Comparison& comparison) {
  TextTable table({"engine", "kappa", "dt", "tolerance", "mu*", "Phi", "z", "penetration/d", cost_unit(comparison),
                   fmt::format("{} - limit", judged(comparison).name)});
  std::string failures;
  for (const CompareRow& row : comparison.rows) {
    if (row.plan.inertial_number != inertial_number) continue;
    table.add(cells(row, comparison));
    const std::string label =
        fmt::format("{} {}", engine_name(row.plan.engine),
                    row.plan.engine == EngineKind::md ? "kappa " + optional_number(row.plan.stiffness_level)
                                                      : "dt " + short_number(row.dt, 3));
    if (row.ending == Ending::failed) failures += fmt::format("  FAILED  {}: {}\n", label, row.failure);
    for (const std::string& note : row.notes) failures += fmt::format("  note  {}: {}\n", label, note);
  }
  return fmt::format("{}\n{}{}", state_name(inertial_number), table.text("  "), failures);
}

}  // namespace

Judged judged(const Comparison& comparison) {
  if (comparison.shear) return {"mu*", &CompareRow::mu_star, &StateLimit::mu_star};
  return {"Phi", &CompareRow::solid_fraction, &StateLimit::solid_fraction};
}

std::optional<Estimate> deviation_of(const CompareRow& row, const Comparison& comparison) {
  const StateLimit* state = limit_of(row, comparison);
  const Judged quantity = judged(comparison);
  if (!state || !row.usable() || !std::isfinite((row.*quantity.value).value)) return std::nullopt;
  return deviation(row.*quantity.value, (state->*quantity.limit).combined);
}

const CompareRow* cheapest_within_error(const Comparison& comparison, const StateLimit& state, EngineKind engine) {
  const CompareRow* cheapest = nullptr;
  for (const CompareRow& row : comparison.rows) {
    if (row.plan.engine != engine || row.plan.inertial_number != state.inertial_number) continue;
    const auto off = deviation_of(row, comparison);
    if (!off || std::abs(off->value) > 2 * off->error) continue;
    if (!cheapest || row.cost < cheapest->cost) cheapest = &row;
  }
  return cheapest;
}

std::string compare_text(const Comparison& comparison) {
  std::string text;
  if (comparison.shortened)
    text += "SHORTENED comparison (--short): few grains, short averages, one state. A first look, not a result.\n\n";
  std::vector<std::optional<double>> states;
  for (const CompareRow& row : comparison.rows)
    if (std::find(states.begin(), states.end(), row.plan.inertial_number) == states.end())
      states.push_back(row.plan.inertial_number);
  for (const auto& inertial_number : states) {
    text += state_text(inertial_number, comparison) + '\n';
    for (const StateLimit& state : comparison.limits)
      if (state.inertial_number == inertial_number)
        text += limits_text(state) + sensitivity_text(state, comparison) + cheapest_text(state, comparison) + '\n';
  }
  for (const std::string& note : comparison.notes) text += "note: " + note + '\n';
  text += fmt::format("{}: processor seconds of one thread, measures excluded, {} row(s) side by side.\n",
                      cost_unit(comparison), comparison.jobs);
  return text;
}

CsvTable compare_table(const Comparison& comparison) {
  CsvTable table;
  table.comments = {
      fmt::format("mu_star, Phi, z: means with standard errors; deviation: {} minus the rigid limit of its state",
                  judged(comparison).name),
      "penetration: largest overlap in units of d; cost: processor seconds per unit strain (or time)"};
  for (const char* name : {"engine",
                           "I",
                           "kappa",
                           "dt",
                           "dt_factor",
                           "tolerance",
                           "mu_star",
                           "mu_star_error",
                           "Phi",
                           "Phi_error",
                           "z",
                           "z_error",
                           "deviation",
                           "deviation_error",
                           "I_realised",
                           "kappa_realised",
                           "pressure",
                           "penetration",
                           "penetration_mean",
                           "cost",
                           "seconds",
                           "steps",
                           "missed",
                           "ending"})
    table.columns.push_back({name, ""});
  const auto maybe = [](const std::optional<double>& value) {
    return value && std::isfinite(*value) ? CsvCell(*value) : CsvCell();
  };
  for (const CompareRow& row : comparison.rows) {
    const auto off = deviation_of(row, comparison);
    table.rows.push_back({engine_name(row.plan.engine),
                          maybe(row.plan.inertial_number),
                          maybe(row.plan.stiffness_level),
                          row.dt,
                          maybe(row.plan.dt_factor),
                          maybe(row.plan.tolerance),
                          maybe(row.mu_star.value),
                          row.mu_star.error,
                          maybe(row.solid_fraction.value),
                          row.solid_fraction.error,
                          maybe(row.z.value),
                          row.z.error,
                          off ? CsvCell(off->value) : CsvCell(),
                          off ? CsvCell(off->error) : CsvCell(),
                          maybe(row.inertial_number),
                          maybe(row.stiffness_level),
                          maybe(row.pressure),
                          maybe(row.peak_penetration),
                          maybe(row.mean_penetration),
                          maybe(row.cost),
                          row.seconds,
                          std::int64_t{row.steps},
                          std::int64_t{row.solver.missed},
                          to_string(row.ending)});
  }
  return table;
}

}  // namespace galet
