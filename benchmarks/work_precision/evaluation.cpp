#include "benchmarks/work_precision/evaluation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "common/core/error.hpp"
#include "common/io/figure.hpp"
#include "src/engines.hpp"
#include "src/text_table.hpp"

namespace galet::precision {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

double mean_of(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

/// The front of an engine, from the cheapest row on.
std::vector<const JudgedRow*> front_of(const std::vector<JudgedRow>& rows, EngineKind engine) {
  std::vector<const JudgedRow*> front;
  for (const JudgedRow& each : rows)
    if (each.front && each.row.setting.engine == engine) front.push_back(&each);
  std::sort(front.begin(), front.end(), [](const JudgedRow* a, const JudgedRow* b) { return a->cost < b->cost; });
  return front;
}

std::string words_of(const Setting& setting) {
  if (setting.engine == EngineKind::md)
    return fmt::format("kappa {:g}; tau_c/dt {:g}", setting.kappa, setting.steps_per_contact);
  return fmt::format("dt {:g}; tolerance {:g}", setting.dt, setting.tolerance);
}

CsvCell cell(double value) {
  return std::isfinite(value) ? CsvCell(std::stod(fmt::format("{:.3g}", value))) : CsvCell();
}

CsvTable work_table(const std::vector<JudgedClass>& judged) {
  CsvTable table;
  table.comments = {"error: see benchmarks/work_precision/evaluation.hpp; noise 1: no larger than its noise"};
  for (const char* name : {"class", "engine", "kappa", "steps_per_contact", "dt", "tolerance", "error", "uncertainty",
                           "noise", "cost", "seconds", "sweeps_per_step", "missed", "front"})
    table.columns.push_back({name, ""});
  for (const auto& [which, rows] : judged)
    for (const JudgedRow& each : rows) {
      const Setting& s = each.row.setting;
      const auto some = [](double value) { return value > 0 ? CsvCell(value) : CsvCell(); };
      table.rows.push_back({which.name, engine_name(s.engine), some(s.kappa), some(s.steps_per_contact), some(s.dt),
                            some(s.tolerance), cell(each.error), cell(each.uncertainty), std::int64_t{each.noise},
                            cell(each.cost), cell(each.row.seconds),
                            cell(static_cast<double>(each.row.sweeps) / static_cast<double>(each.row.steps)),
                            std::int64_t{each.row.missed}, std::int64_t{each.front}});
    }
  return table;
}

/// Cost of each engine at an error, and what reaches it.
CsvTable error_table(const std::vector<JudgedClass>& judged) {
  CsvTable table;
  for (const char* name : {"class", "per", "error", "md", "cd", "md/cd", "md_setting", "cd_setting"})
    table.columns.push_back({name, ""});
  for (const auto& [which, rows] : judged)
    for (const double error : {1e-1, 3e-2, 1e-2, 3e-3, 1e-3, 1e-4, 1e-5, 1e-6}) {
      const double md = cost_at(rows, EngineKind::md, error), cd = cost_at(rows, EngineKind::cd, error);
      const JudgedRow *soft = cheapest(rows, EngineKind::md, error), *rigid = cheapest(rows, EngineKind::cd, error);
      if (!soft && !rigid) continue;
      table.rows.push_back({which.name, which.extent, error, cell(md), cell(cd), cell(md / cd),
                            soft ? words_of(soft->row.setting) : "not reached",
                            rigid ? words_of(rigid->row.setting) : "not reached"});
    }
  return table;
}

/// Errors at which the cheaper engine changes, scanned from 1 downwards, 100 to a decade.
CsvTable crossover_table(const std::vector<JudgedClass>& judged) {
  CsvTable table;
  table.comments = {
      "from, to: range of errors; ratio: least and largest cost of the dearer engine over the cheaper's; noise: at "
      "`to` "
      "no row that is used is farther from the limit than its noise, and the end of the range says nothing"};
  for (const char* name : {"class", "cheaper", "from", "to", "least_ratio", "largest_ratio", "noise"})
    table.columns.push_back({name, ""});
  for (const auto& [which, rows] : judged) {
    std::string now;
    double from = 0, last = 0, least = 0, largest = 0;
    const auto close = [&] {
      if (now.empty()) return;
      const JudgedRow *soft = cheapest(rows, EngineKind::md, last), *rigid = cheapest(rows, EngineKind::cd, last);
      const bool noise = (!soft || soft->noise) && (!rigid || rigid->noise);
      const auto ratio = [](double value) { return value > 0 ? cell(value) : CsvCell(); };
      table.rows.push_back(
          {which.name, now, cell(from), cell(last), ratio(least), ratio(largest), std::string(noise ? "noise" : "")});
    };
    for (int k = 0; k <= 1200; ++k) {
      const double error = std::pow(10, -k / 100.0);
      const double md = cost_at(rows, EngineKind::md, error), cd = cost_at(rows, EngineKind::cd, error);
      const bool soft = std::isfinite(md), rigid = std::isfinite(cd);
      std::string name;
      if (soft && rigid)
        name = md < cd ? "md" : "cd";
      else if (soft || rigid)
        name = soft ? "md alone" : "cd alone";
      if (name != now) {
        close();
        now = name, from = error, least = INFINITY, largest = 0;
      }
      const double ratio = soft && rigid ? std::max(md / cd, cd / md) : nan;
      if (std::isfinite(ratio)) least = std::min(least, ratio), largest = std::max(largest, ratio);
      last = error;
    }
    close();
  }
  return table;
}

/// Name of a class in gnuplot's notation.
std::string title_of(const SceneClass& which) {
  const std::size_t mark = which.name.find('_');
  return mark == std::string::npos ? which.name
                                   : which.name.substr(0, mark) + ", {/:Italic I} = " + which.name.substr(mark + 1);
}

void draw(const SceneClass& which, const std::vector<JudgedRow>& rows, const std::string& folder) {
  Figure figure{.title = title_of(which),
                .x_label = fmt::format("processor seconds per {}", which.extent),
                .y_label = which.truth == Truth::exact ? "error" : "error / limit",
                .log_x = true,
                .log_y = true,
                .series = {}};
  for (const EngineKind engine : {EngineKind::md, EngineKind::cd}) {
    Series all{.label = engine_name(engine), .x = {}, .y = {}, .y_error = {}};
    for (const JudgedRow& each : rows) {
      if (each.row.setting.engine != engine) continue;
      all.x.push_back(each.cost), all.y.push_back(each.error);
      // Down to a tenth of the value: an error has no room below zero on this axis.
      if (which.truth == Truth::limit) all.y_error.push_back(std::min(each.uncertainty, 0.9 * each.error));
    }
    figure.series.push_back(all);
    Series front{.label = engine_name(engine) + ", front", .x = {}, .y = {}, .y_error = {}, .line = true};
    for (const JudgedRow* each : front_of(rows, engine)) front.x.push_back(each->cost), front.y.push_back(each->error);
    figure.series.push_back(front);
  }
  write_figure(folder + "/" + which.name, figure);
}

}  // namespace

std::vector<Estimate> estimates(const std::vector<Row>& rows, std::size_t quantity) {
  std::vector<Estimate> all;
  const std::size_t starts = rows[0].quantities[quantity].values.size();
  std::vector<double> of_start(starts, 0.0);
  double grand = 0;
  for (const Row& row : rows)
    for (std::size_t k = 0; k < starts; ++k) {
      const double share = row.quantities[quantity].values[k] / static_cast<double>(rows.size());
      of_start[k] += share, grand += share / static_cast<double>(starts);
    }
  for (const Row& row : rows) {
    const Quantity& found = row.quantities[quantity];
    Estimate estimate{mean_of(found.values), found.noise};
    if (starts > 1) {
      double sum = 0;
      for (std::size_t k = 0; k < starts; ++k)
        sum += std::pow(found.values[k] - of_start[k] - (estimate.value - grand), 2);
      const auto n = static_cast<double>(starts);
      estimate.error = std::sqrt(sum / (n - 1) / n);
    }
    all.push_back(estimate);
  }
  return all;
}

RigidLimit limit_of(const std::vector<Row>& rows, std::size_t quantity, double power) {
  const std::vector<Estimate> values = estimates(rows, quantity);
  std::vector<MdRun> md;
  std::vector<CdRun> cd;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const Setting& s = rows[k].setting;
    if (s.engine == EngineKind::md && s.kappa >= 1e3) md.push_back({s.kappa, values[k]});
    if (s.engine == EngineKind::cd && s.dt <= 0.05) cd.push_back({s.dt, s.tolerance, values[k]});
  }
  return rigid_limit(md, cd, power);
}

void mark_front(std::vector<JudgedRow>& rows) {
  for (JudgedRow& each : rows)
    each.front = std::none_of(rows.begin(), rows.end(), [&](const JudgedRow& other) {
      return &other != &each && other.row.setting.engine == each.row.setting.engine && other.cost <= each.cost &&
             other.error <= each.error;
    });
}

std::vector<JudgedClass> judge(const std::vector<SceneClass>& classes, const std::vector<Row>& rows) {
  std::vector<JudgedClass> all;
  for (const SceneClass& which : classes) {
    std::vector<Row> own;
    for (const Row& row : rows)
      if (row.scene == which.name) own.push_back(row);
    if (own.empty()) continue;
    std::vector<JudgedRow> judged;
    const std::vector<Estimate> values = estimates(own, 0);
    const Estimate limit = which.truth == Truth::limit ? limit_of(own, 0, which.power).combined : Estimate{};
    for (std::size_t k = 0; k < own.size(); ++k) {
      JudgedRow each{.row = own[k], .cost = own[k].seconds / own[k].extent, .error = values[k].value};
      each.deviation = each.error;
      if (which.truth == Truth::limit) {
        const Estimate off = deviation(values[k], limit);
        each.uncertainty = off.error / std::abs(limit.value);
        each.deviation = off.value / std::abs(limit.value);
        each.error = std::max(std::abs(off.value), off.error) / std::abs(limit.value);
        each.noise = std::abs(off.value) < 2 * off.error;
      }
      judged.push_back(each);
    }
    mark_front(judged);
    all.emplace_back(which, judged);
  }
  return all;
}

double cost_at(const std::vector<JudgedRow>& rows, EngineKind engine, double error) {
  const std::vector<const JudgedRow*> front = front_of(rows, engine);
  for (std::size_t k = 0; k < front.size(); ++k) {
    if (front[k]->error > error) continue;
    if (k == 0) return front[0]->cost;
    const JudgedRow &coarse = *front[k - 1], &fine = *front[k];
    // An error of exactly zero has no place on a logarithmic line.
    if (!(fine.error > 0)) return fine.cost;
    const double share = std::log(coarse.error / error) / std::log(coarse.error / fine.error);
    return coarse.cost * std::pow(fine.cost / coarse.cost, share);
  }
  return nan;
}

const JudgedRow* cheapest(const std::vector<JudgedRow>& rows, EngineKind engine, double error) {
  const JudgedRow* best = nullptr;
  for (const JudgedRow& each : rows)
    if (each.row.setting.engine == engine && each.error <= error && (!best || each.cost < best->cost)) best = &each;
  return best;
}

void evaluate(const std::vector<SceneClass>& classes, const std::vector<Row>& rows, const std::string& folder) {
  const std::vector<JudgedClass> judged = judge(classes, rows);
  write_csv(folder + "/work.csv", work_table(judged));
  write_csv(folder + "/at_error.csv", error_table(judged));
  write_csv(folder + "/crossover.csv", crossover_table(judged));
  write_csv(folder + "/crossings.csv", crossings(judged));
  write_csv(folder + "/cost.csv", cost_laws(judged));
  write_csv(folder + "/limit.csv", limit_orders(judged));
  for (const auto& [which, own] : judged) draw(which, own, folder);
}

}  // namespace galet::precision
