#include "src/advice.hpp"

#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "common/core/error.hpp"
#include "src/compare_report.hpp"
#include "src/engines.hpp"
#include "src/text_table.hpp"

namespace galet {

namespace {

double level_of(const CompareRow& row) { return row.plan.stiffness_level.value_or(row.stiffness_level); }

/// The row's deviation and its error, over the limit.
std::optional<Estimate> relative_deviation(const CompareRow& row, const Comparison& comparison, const Estimate& limit) {
  const auto off = deviation_of(row, comparison);
  if (!off || !(std::abs(limit.value) > 0)) return std::nullopt;
  return Estimate{off->value / limit.value, off->error / std::abs(limit.value)};
}

bool belongs(const CompareRow& row, EngineKind engine, const StateLimit& state) {
  return row.usable() && row.plan.engine == engine && row.plan.inertial_number == state.inertial_number &&
         std::isfinite(row.cost);
}

/// The cheapest row of the engine that reaches the error.
std::optional<Offer> measured_offer(const Comparison& comparison, const Advice& advice, EngineKind engine,
                                    const Estimate& limit) {
  std::optional<Offer> best;
  for (const CompareRow& row : comparison.rows) {
    if (!belongs(row, engine, *advice.state)) continue;
    const auto off = relative_deviation(row, comparison, limit);
    if (!off || std::abs(off->value) > advice.error || 2 * off->error > advice.error) continue;
    if (!best || row.cost < best->cost)
      best = Offer{engine, &row, engine == EngineKind::md ? level_of(row) : row.dt, row.cost, false};
  }
  return best;
}

/// From the engine's line, where it asks for more than its finest row; that row is the cheapest of its kind.
std::optional<Offer> extrapolated_offer(const Comparison& comparison, const Advice& advice, EngineKind engine,
                                        const std::optional<EngineLimit>& line, const Estimate& limit) {
  if (!line || !line->on_line || line->runs < 2 || !(std::abs(line->slope.value) > 2 * line->slope.error)) return {};
  const bool md = engine == EngineKind::md;
  const double allowed = advice.error * std::abs(limit.value);
  const double parameter = md ? std::abs(line->slope.value) / allowed : allowed / std::abs(line->slope.value);
  const CompareRow* finest = nullptr;
  for (const CompareRow& row : comparison.rows) {
    if (!belongs(row, engine, *advice.state)) continue;
    const double fineness = md ? level_of(row) : 1 / row.dt;
    const double other = !finest ? 0 : md ? level_of(*finest) : 1 / finest->dt;
    if (!finest || fineness > other || (fineness == other && row.cost < finest->cost)) finest = &row;
  }
  if (!finest) return {};
  const double factor = md ? std::sqrt(parameter / level_of(*finest)) : finest->dt / parameter;
  if (!(factor > 1)) return {};
  return Offer{engine, finest, parameter, factor * finest->cost, true};
}

std::string setting(const Offer& offer) {
  if (offer.engine == EngineKind::md) return fmt::format("kappa = {}", short_number(offer.parameter, 3));
  return fmt::format("dt = {}, tolerance {}", short_number(offer.parameter, 3),
                     short_number(offer.row->plan.tolerance.value_or(0)));
}

std::string offer_text(const Offer& offer, const Advice& advice, const Comparison& comparison) {
  const Judged quantity = judged(comparison);
  const Estimate& limit = (advice.state->*quantity.limit).combined;
  const std::string cost = fmt::format("{} {}", short_number(offer.cost, 3), comparison.shear ? "s/strain" : "s/time");
  if (offer.extrapolated)
    return fmt::format("{} with {}, {} (extrapolated: no run was so fine)", engine_name(offer.engine), setting(offer),
                       cost);
  const Estimate off = *relative_deviation(*offer.row, comparison, limit);
  return fmt::format("{} with {}, {} (a run of it is off by {} %)", engine_name(offer.engine), setting(offer), cost,
                     with_error({100 * off.value, 100 * off.error}));
}

std::string one_text(const Advice& advice, const Comparison& comparison) {
  const Judged quantity = judged(comparison);
  const RigidLimit& limit = advice.state->*quantity.limit;
  const std::string state =
      advice.state->inertial_number ? fmt::format(" at I = {:g}", *advice.state->inertial_number) : "";
  std::string text =
      fmt::format("advice for {} of rigid grains within {:g} %{}\n", quantity.name, 100 * advice.error, state);
  const Offer* chosen = advice.chosen();
  if (!chosen)
    text += fmt::format(
        "  none: {}\n",
        advice.least_noise > advice.error
            ? fmt::format("noise (two standard errors) is {:.2g} % at least; runs {:.1f} times as long can tell",
                          100 * advice.least_noise, std::pow(advice.least_noise / advice.error, 2))
            : std::string("no run is that near the limit, and none lies on a line that says what is needed"));
  for (const std::optional<Offer>* offer : {&advice.md, &advice.cd})
    if (*offer)
      text += fmt::format("  {}{}\n", &**offer == chosen ? "take " : "or   ", offer_text(**offer, advice, comparison));
  int rows = 0;
  for (const CompareRow& row : comparison.rows)
    rows += belongs(row, EngineKind::md, *advice.state) || belongs(row, EngineKind::cd, *advice.state);
  text += fmt::format("  evidence: {} runs; limit {}{}\n", rows, with_error(limit.combined),
                      !limit.agree   ? ", of one engine only"
                      : *limit.agree ? ", in which both engines agree"
                                     : ", in which the engines DIFFER by more than two errors");
  return text;
}

}  // namespace

const Offer* Advice::chosen() const {
  if (md && cd) return md->cost < cd->cost ? &*md : &*cd;
  return md ? &*md : cd ? &*cd : nullptr;
}

std::vector<Advice> advise(const Comparison& comparison, double error) {
  if (!(error > 0 && error < 1)) throw InputError("the wanted error is a share of the value, between 0 and 1");
  const Judged quantity = judged(comparison);
  std::vector<Advice> all;
  for (const StateLimit& state : comparison.limits) {
    const RigidLimit& limit = state.*quantity.limit;
    if (!std::isfinite(limit.combined.value)) continue;
    Advice advice{&state, error, {}, {}, std::numeric_limits<double>::infinity()};
    for (const EngineKind engine : {EngineKind::md, EngineKind::cd}) {
      auto& offer = engine == EngineKind::md ? advice.md : advice.cd;
      offer = measured_offer(comparison, advice, engine, limit.combined);
      if (!offer)
        offer = extrapolated_offer(comparison, advice, engine, engine == EngineKind::md ? limit.md : limit.cd,
                                   limit.combined);
      for (const CompareRow& row : comparison.rows)
        if (belongs(row, engine, state))
          if (const auto off = relative_deviation(row, comparison, limit.combined))
            advice.least_noise = std::min(advice.least_noise, 2 * off->error);
    }
    all.push_back(advice);
  }
  return all;
}

std::string advice_text(const std::vector<Advice>& all, const Comparison& comparison) {
  std::string text;
  for (const Advice& advice : all) text += one_text(advice, comparison);
  return text;
}

}  // namespace galet
