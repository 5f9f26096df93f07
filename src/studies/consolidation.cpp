// Consolidation of cohesive disks in isotropic compression: 1/Phi against ln P*, without and with a little rolling
// resistance, and unloading. Forces are in units of F0, so that P* = 1 / eta is the pressure itself.
#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "src/engines.hpp"
#include "src/line_fit.hpp"
#include "src/studies/estimates.hpp"
#include "src/studies/scene_head.hpp"
#include "src/studies/studies.hpp"
#include "src/studies/templates.hpp"

namespace galet::consolidation {

namespace {

constexpr std::array engines = {EngineKind::md, EngineKind::cd};
constexpr double first_pressure = 0.01, last_pressure = 10;
constexpr double fit_from = 0.02, fit_to = 3;  ///< P* of the linear part
constexpr double stiffness = 1e5;              ///< K_N d / F0: kappa = 1e4 at P* = 10

std::string pressure_name(double pressure) { return fmt::format("P* {}", plain_number(pressure)); }

/// A ramp of the pressure and a rest under it; slow where the pressure is low (I_a: the time unit is sqrt(m d / F0)).
std::string pressure_stages(const std::string& name, double from, double to) {
  const double time = 20 / std::sqrt(std::min(1.0, std::max(from, to)));
  return fmt::format(
      "\n[[stage]]\nname = \"to {0}\"\nduration = {1:.6g}\n"
      "loading = {{kind = \"isotropic\", pressure = {2}, pressure_to = {3}}}\n"
      "\n[[stage]]\nname = \"{0}\"\nduration = {1:.6g}\nloading = {{kind = \"isotropic\", pressure = {3}}}\n",
      name, time, from, to);
}

std::vector<double> pressures(bool quick) {
  return quick ? std::vector{0.03, 0.1, 0.3, 1.0, 3.0, last_pressure}
               : std::vector{0.017, 0.03, 0.055, 0.1, 0.17, 0.3, 0.55, 1.0, 1.7, 3.0, 5.5, last_pressure};
}

std::string consolidation_scene(EngineKind engine, double rolling, int seed, bool quick, const std::string& title) {
  const SceneHead head{title,
                       engine,
                       2,
                       seed,
                       "d = m = F0 = 1",
                       quick ? 200 : 1400,
                       R"({distribution = "uniform", mean = 1.0, spread = 0.3333})",
                       0.5,
                       0.2};
  std::string text =
      scene_head(head) + fmt::format(R"(stiffness_level = {}
cohesion_force = 1.0
cohesion_range = 0.01
{}
[initial]
kind = "gas"
solid_fraction = 0.4
speed = 0.1

[loading]
pressure = 1.0  # the unit of stress: F0 / d

[run]
samples = 50
)",
                                     stiffness, rolling > 0 ? fmt::format("rolling_friction = {}\n", rolling) : "");
  text += "\n[[stage]]\nname = \"aggregation\"\nduration = 100\nloading = {kind = \"none\"}\n";
  text += fmt::format("\n[[stage]]\nname = \"{}\"\nduration = 300\nloading = {{kind = \"isotropic\", pressure = {}}}\n",
                      pressure_name(first_pressure), first_pressure);
  double from = first_pressure;
  for (const double to : pressures(quick)) {
    text += pressure_stages(pressure_name(to), from, to);
    from = to;
  }
  return text + pressure_stages("unloaded", last_pressure, 0.1);
}

/// (ln P*, 1/Phi) at the ends of the stages of one run, within [least, most].
std::vector<LinePoint> course(const StudyRow& row, double least, double most) {
  std::vector<LinePoint> points;
  for (const StageReport& stage : row.run.stages) {
    if (!stage.name.starts_with("P* ")) continue;
    const double pressure = std::stod(stage.name.substr(3));
    if (pressure < least || pressure > most) continue;
    points.push_back({std::log(pressure), {1 / stage.last[Observable::solid_fraction], 0}});
  }
  return points;
}

double at_end(const StudyRow& row, const std::string& stage) {
  const StageReport* report = stage_of(row, stage);
  return report ? 1 / report->last[Observable::solid_fraction] : std::nan("");
}

Estimate over_seeds(const std::vector<StudyRow>& rows, EngineKind engine, double rolling,
                    const std::function<double(const StudyRow&)>& number) {
  return mean_over(rows_with(rows, engine, {{"mu_R", rolling}}), number);
}

void report_engine(StudyReport& report, const std::vector<StudyRow>& rows, EngineKind engine) {
  const std::string of = " (" + engine_name(engine) + ")";
  const auto slope = [](const StudyRow& row) {
    const auto points = course(row, fit_from, fit_to);
    return points.size() > 1 ? fit_line(points).slope.value : std::nan("");
  };
  const auto recovered = [](const StudyRow& row) {
    const double dense = at_end(row, pressure_name(last_pressure));
    return (at_end(row, "unloaded") - dense) / (at_end(row, pressure_name(0.1)) - dense);
  };
  for (const double rolling : {0.0, 0.01}) {
    const std::string with = fmt::format(", mu_R/d = {:g}{}", rolling, of);
    report.add("slope of 1/Phi against ln P*" + with, over_seeds(rows, engine, rolling, slope), "consolidation.slope");
    report.add("change of 1/Phi from P* = 10 back to 0.1 over that from 0.1 to 10" + with,
               over_seeds(rows, engine, rolling, recovered), "consolidation.unloading");
  }
  const auto difference = over_seeds(rows, engine, 0.01, slope) - over_seeds(rows, engine, 0, slope);
  report.add("|slope with mu_R/d = 0.01 minus without|" + of, {std::abs(difference.value), difference.error},
             "consolidation.rolling");
  const auto loosest = [](const StudyRow& row) { return at_end(row, pressure_name(first_pressure)); };
  report.add("1/Phi at P* = 0.01, mu_R/d = 0.01 minus 0" + of,
             over_seeds(rows, engine, 0.01, loosest) - over_seeds(rows, engine, 0, loosest), "consolidation.looser");
}

}  // namespace

std::vector<StudyRun> plan(StudySize size) {
  const bool quick = size == StudySize::quick;
  std::vector<StudyRun> runs;
  for (const EngineKind engine : engines)
    for (const double rolling : {0.0, 0.01})
      for (const int seed : quick ? std::vector{1, 2} : std::vector{1, 2, 3, 4}) {
        const std::string name = fmt::format("{}_mu_R_{:g}_seed_{}", engine_name(engine), rolling, seed);
        runs.push_back({name,
                        engine,
                        {{"mu_R", rolling}, {"seed", seed}},
                        consolidation_scene(engine, rolling, seed, quick, "consolidation: " + name)});
      }
  return runs;
}

StudyReport report(const std::vector<StudyRow>& rows) {
  StudyReport report;
  for (const EngineKind engine : engines) report_engine(report, rows, engine);
  Figure figure{"Consolidation of cohesive disks", "reduced pressure P*", "1 / Phi", true, false, {}};
  for (const EngineKind engine : engines)
    for (const double rolling : {0.0, 0.01}) {
      const StudyRow* row = row_with(rows, engine, {{"mu_R", rolling}, {"seed", 1}});
      if (!row) continue;
      Series series;
      series.label = fmt::format("{}, mu_R/d = {:g}", engine_name(engine), rolling);
      series.line = true;
      for (const LinePoint& point : course(*row, 0, 2 * last_pressure)) {
        series.x.push_back(std::exp(point.x));
        series.y.push_back(point.y.value);
      }
      series.x.push_back(0.1), series.y.push_back(at_end(*row, "unloaded"));
      figure.series.push_back(series);
    }
  report.figures.push_back({"consolidation", figure});
  report.remarks.emplace_back(
      "the figure shows seed 1, its last point after unloading to P* = 0.1; findings are means over "
      "the seeds, with the error of their scatter");
  return report;
}

}  // namespace galet::consolidation
