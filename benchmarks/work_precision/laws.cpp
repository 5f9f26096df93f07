// Cost laws and orders of convergence, as straight lines through logarithms.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "benchmarks/work_precision/evaluation.hpp"
#include "src/line_fit.hpp"
#include "src/text_table.hpp"

namespace galet::precision {

namespace {

/// Exponent of y ~ x^p with its error, from the scatter about the line.
Estimate exponent(const std::vector<std::pair<double, double>>& points) {
  std::vector<LinePoint> logs;
  for (const auto& [x, y] : points) logs.push_back({std::log(x), {std::log(y), 0}});
  return fit_line(logs).slope;
}

/// Costs of the rows of one engine that `take` gives an abscissa > 0.
template <class Take>
std::vector<std::pair<double, double>> costs(const std::vector<JudgedRow>& rows, const Take& take) {
  std::vector<std::pair<double, double>> points;
  for (const JudgedRow& each : rows)
    if (const double x = take(each.row.setting); x > 0) points.emplace_back(x, each.cost);
  return points;
}

void add_law(CsvTable& table, const std::string& name, const std::string& law,
             const std::vector<std::pair<double, double>>& points, const std::string& expected) {
  if (points.size() < 2) return;
  table.rows.push_back({name, law, static_cast<std::int64_t>(points.size()), with_error(exponent(points)), expected});
}

const std::vector<JudgedRow>* rows_of(const std::vector<JudgedClass>& judged, const std::string& name) {
  for (const auto& [which, rows] : judged)
    if (which.name == name) return &rows;
  return nullptr;
}

/// Cost per strain at I = 0.01 over that at I = 0.1, setting by setting: exponent of I.
void add_inertial_law(CsvTable& table, const std::vector<JudgedClass>& judged, EngineKind engine) {
  const auto *fast = rows_of(judged, "flow_0.1"), *slow = rows_of(judged, "flow_0.01");
  if (!fast || !slow) return;
  std::vector<double> exponents;
  for (const JudgedRow& a : *fast)
    for (const JudgedRow& b : *slow)
      if (a.row.setting.engine == engine && a.row.setting == b.row.setting)
        exponents.push_back(std::log10(a.cost / b.cost));
  if (exponents.size() < 2) return;
  double mean = 0, square = 0;
  const auto n = static_cast<double>(exponents.size());
  for (const double e : exponents) mean += e / n;
  for (const double e : exponents) square += (e - mean) * (e - mean) / (n - 1) / n;
  table.rows.push_back({std::string("flow_0.1 and flow_0.01"),
                        std::string(engine == EngineKind::md ? "md: I" : "cd: I"),
                        static_cast<std::int64_t>(exponents.size()), with_error({mean, std::sqrt(square)}),
                        std::string("-1 per strain: steps")});
}

/// The steps per contact at which a class has most stiffness levels.
double usual_steps(const std::vector<JudgedRow>& rows) {
  std::map<double, int> counts;
  for (const JudgedRow& each : rows)
    if (each.row.setting.engine == EngineKind::md) ++counts[each.row.setting.steps_per_contact];
  double best = 0;
  for (const auto& [steps, count] : counts)
    if (best == 0 || count >= counts[best]) best = steps;
  return best;
}

/// Power of 1/kappa with which a quantity is expected to tend to its limit: see docs/theory.md, "Rigid limit".
double power_of(const SceneClass& which, const std::string& quantity) { return quantity == "z" ? 0.5 : which.power; }

void add_order(CsvTable& table, const SceneClass& which, const std::vector<JudgedRow>& rows, std::size_t quantity) {
  std::vector<Row> plain;
  for (const JudgedRow& each : rows) plain.push_back(each.row);
  const std::string name = plain[0].quantities[quantity].name;
  const bool exact = which.truth == Truth::exact;
  const std::vector<Estimate> values = estimates(plain, quantity);
  RigidLimit limit;
  if (!exact) limit = limit_of(plain, quantity, power_of(which, name));
  const double steps = usual_steps(rows);
  std::map<double, Estimate> off;
  std::vector<std::pair<double, double>> points;
  for (std::size_t k = 0; k < plain.size(); ++k) {
    const Setting& s = plain[k].setting;
    if (s.engine != EngineKind::md || s.steps_per_contact != steps) continue;
    const Estimate found = exact ? values[k] : deviation(values[k], limit.combined);
    off[s.kappa] = found;
    // What is below its noise, or no more than rounding, says nothing of an order.
    if (std::abs(found.value) > std::max(2 * found.error, 1e-11)) points.emplace_back(s.kappa, std::abs(found.value));
  }
  std::vector<CsvCell> cells{which.name, name, exact ? std::string("exact") : with_error(limit.combined)};
  for (const double kappa : {1e2, 1e3, 1e4, 1e5, 1e6, 1e7}) {
    const auto at = off.find(kappa);
    cells.push_back(at == off.end() ? CsvCell()
                    : exact         ? CsvCell(short_number(at->second.value, 2))
                                    : CsvCell(with_error(at->second)));
  }
  // Two points make a line whatever they are.
  cells.push_back(points.size() > 2    ? CsvCell(with_error(exponent(points)))
                  : points.size() == 0 ? CsvCell(std::string("no effect seen"))
                                       : CsvCell(std::string("too few above noise")));
  const auto engine = [](const std::optional<EngineLimit>& of) {
    return !of ? std::string("-") : of->on_line ? with_error(of->value) : std::string("not on a line");
  };
  cells.push_back(exact ? std::string("-") : engine(limit.md));
  cells.push_back(exact ? std::string("-") : engine(limit.cd));
  table.rows.push_back(cells);
}

}  // namespace

CsvTable cost_laws(const std::vector<JudgedClass>& judged) {
  CsvTable table;
  for (const char* name : {"class", "against", "rows", "exponent", "expected"}) table.columns.push_back({name, ""});
  for (const auto& [which, rows] : judged) {
    const double usual = usual_steps(rows);
    // A column at rest costs the time that its dashpots need, which falls as kappa^-1/2.
    const std::string of_kappa =
        which.name == "column" ? "0 and a logarithm" : "1/2: steps of tau_c / n (less where grains fly free)";
    add_law(table, which.name, "md: kappa",
            costs(rows, [&](const Setting& s) { return s.steps_per_contact == usual ? s.kappa : 0; }), of_kappa);
    double tightest = 1, finest = 1e9;
    for (const JudgedRow& each : rows)
      if (each.row.setting.engine == EngineKind::cd) tightest = std::min(tightest, each.row.setting.tolerance);
    const double middle = which.truth == Truth::limit && which.name != "gas" ? 1e-3 : tightest;
    const bool steady = which.name == "column" || which.name == "packing";  // rest takes so many steps, whatever dt
    if (!steady)
      add_law(table, which.name, "cd: dt",
              costs(rows, [&](const Setting& s) { return s.tolerance == middle ? s.dt : 0; }),
              "-1 by steps; less by sweeps");
    for (const JudgedRow& each : rows)
      if (each.row.setting.engine == EngineKind::cd && each.row.setting.tolerance == 1e-2)
        finest = std::min(finest, each.row.setting.dt);
    add_law(table, which.name, "cd: tolerance",
            costs(rows, [&](const Setting& s) { return s.dt == finest ? s.tolerance : 0; }), "none known");
  }
  add_inertial_law(table, judged, EngineKind::md);
  add_inertial_law(table, judged, EngineKind::cd);
  return table;
}

CsvTable limit_orders(const std::vector<JudgedClass>& judged) {
  CsvTable table;
  for (const char* name : {"class", "quantity", "limit", "1e2", "1e3", "1e4", "1e5", "1e6", "1e7", "order in kappa",
                           "limit of md", "limit of cd"})
    table.columns.push_back({name, ""});
  for (const auto& [which, rows] : judged)
    for (std::size_t k = 0; k < rows[0].row.quantities.size(); ++k) add_order(table, which, rows, k);
  return table;
}

}  // namespace galet::precision
