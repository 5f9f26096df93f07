// Errors at which one engine overtakes the other, with error bars.
//
// The fronts are drawn again 400 times: each row's deviation from the limit moves by its standard error times a normal
// number (exact classes: not at all), and each cost by the scatter of processor times on a shared machine. An interval
// is that of the middle two thirds of the crossings found, each the nearest one of its direction; `share` says in how
// many draws there was one. What it leaves out: the settings that were not tried between two rows.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "benchmarks/work_precision/evaluation.hpp"
#include "common/core/random.hpp"

namespace galet::precision {

namespace {

/// Relative scatter of the processor time of one row: 49 rows run twice on a machine that others used gave 7 to 15 %.
constexpr double cost_scatter = 0.1;
constexpr int draws = 400;

/// Below `error` the other engine than above is the cheaper one.
struct Crossing {
  double error = 0;
  bool to_cd = false;
};

/// From large errors to small ones, 100 to a decade; where either engine does not get there is no crossing.
std::vector<Crossing> crossings_of(const std::vector<JudgedRow>& rows) {
  std::vector<Crossing> all;
  double before = 0;
  for (int k = 0; k <= 800; ++k) {
    const double error = std::pow(10, -k / 100.0);
    const double md = cost_at(rows, EngineKind::md, error), cd = cost_at(rows, EngineKind::cd, error);
    if (!std::isfinite(md) || !std::isfinite(cd)) {
      before = 0;
      continue;
    }
    const double now = md - cd;
    if (before * now < 0) all.push_back({error, now > 0});
    if (now != 0) before = now;
  }
  return all;
}

std::vector<JudgedRow> drawn_again(const std::vector<JudgedRow>& rows, int draw) {
  RandomStream stream(1, static_cast<std::uint64_t>(draw));
  std::vector<JudgedRow> moved = rows;
  for (JudgedRow& each : moved) {
    each.cost *= std::exp(cost_scatter * stream.normal());
    const double shift = each.uncertainty * stream.normal();
    each.error = std::max(std::abs(each.deviation + shift), each.uncertainty);
  }
  mark_front(moved);
  return moved;
}

/// Logarithm of the nearest crossing of the same direction, one per draw that has any; ascending.
std::vector<double> nearest_crossings(const Crossing& of, const std::vector<std::vector<Crossing>>& drawn) {
  std::vector<double> found;
  for (const std::vector<Crossing>& some : drawn) {
    double nearest = INFINITY;
    for (const Crossing& each : some) {
      const double far = std::log(each.error / of.error);
      if (each.to_cd == of.to_cd && std::abs(far) < std::abs(nearest)) nearest = far;
    }
    if (std::isfinite(nearest)) found.push_back(std::log(of.error) + nearest);
  }
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace

CsvTable crossings(const std::vector<JudgedClass>& judged) {
  CsvTable table;
  for (const char* name : {"class", "below_it_cheaper", "error", "low", "high", "share", "kappa", "dt", "tolerance"})
    table.columns.push_back({name, ""});
  const auto three = [](double value) { return CsvCell(std::stod(fmt::format("{:.3g}", value))); };
  for (const auto& [which, rows] : judged) {
    const std::vector<Crossing> all = crossings_of(rows);
    if (all.empty()) continue;
    std::vector<std::vector<Crossing>> drawn;
    for (int draw = 0; draw < draws; ++draw) drawn.push_back(crossings_of(drawn_again(rows, draw)));
    for (const Crossing& each : all) {
      const std::vector<double> found = nearest_crossings(each, drawn);
      const auto at = [&](double share) {
        if (found.empty()) return CsvCell();
        return three(std::exp(found[static_cast<std::size_t>(share * static_cast<double>(found.size() - 1))]));
      };
      const Setting soft = cheapest(rows, EngineKind::md, each.error)->row.setting;
      const Setting rigid = cheapest(rows, EngineKind::cd, each.error)->row.setting;
      table.rows.push_back({which.name, std::string(each.to_cd ? "cd" : "md"), three(each.error), at(1.0 / 6),
                            at(5.0 / 6), three(static_cast<double>(found.size()) / draws), soft.kappa, rigid.dt,
                            rigid.tolerance});
    }
  }
  return table;
}

}  // namespace galet::precision
