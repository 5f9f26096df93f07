// Triaxial compression of spheres: peak friction angle and dilatancy against the friction of contacts, and what a
// stiffness level does to the states A and C. What leads to the peak and what is left on the way, in
// triaxial_parts.hpp.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include <fmt/format.h>

#include "src/engines.hpp"
#include "src/line_fit.hpp"
#include "src/studies/estimates.hpp"
#include "src/studies/published.hpp"
#include "src/studies/solid_templates.hpp"
#include "src/studies/studies.hpp"
#include "src/studies/templates.hpp"
#include "src/studies/triaxial_curve.hpp"
#include "src/studies/triaxial_parts.hpp"

namespace galet::triaxial {

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();
constexpr std::array other_levels = {39000.0, 18000.0, 3900.0, 1800.0};  ///< of P = 10, 32, 320 and 1000 kPa

/// q/P at the peak and dilatancy D = -d eps_v / d eps_a there, from means over windows of 0.01 in strain: single rows
/// fluctuate, and the largest of many noisy values is above the peak.
struct Peak {
  double deviator = none, dilatancy = none, strain = none;
};

Peak peak_of(const TriaxialCurve& curve) {
  constexpr double window = 0.01;
  Peak peak;
  for (std::size_t k = 0; k < curve.strain.size(); ++k) {
    std::vector<LinePoint> points;
    double sum = 0;
    for (std::size_t l = 0; l < curve.strain.size(); ++l)
      if (std::abs(curve.strain[l] - curve.strain[k]) <= 0.5 * window) {
        sum += curve.deviator[l];
        points.push_back({curve.strain[l], {curve.volume[l], 0}});
      }
    const bool whole = curve.strain[k] >= 0.5 * window && curve.strain[k] <= curve.strain.back() - 0.5 * window;
    const double mean = sum / static_cast<double>(points.size());
    if (!whole || points.size() < 3 || mean <= peak.deviator) continue;  // nothing compares with NaN, the start
    peak = {mean, -fit_line(points).slope.value, curve.strain[k]};
  }
  return peak;
}

/// phi in degrees with q/P = 2 sin phi / (1 - sin phi).
double friction_angle(double deviator) { return std::asin(deviator / (2 + deviator)) * 180 / std::numbers::pi; }

std::vector<const StudyRow*> rows_of(const std::vector<StudyRow>& rows, EngineKind engine, char state, double friction,
                                     double level) {
  return rows_with(rows, engine, {{"state", state}, {"mu", friction}, {"kappa", level}});
}

void report_peaks(StudyReport& report, const std::vector<StudyRow>& rows) {
  for (const double friction : values_of(rows, "mu")) {
    const auto found = rows_of(rows, EngineKind::md, 'A', friction, reference_level);
    report.add(fmt::format("phi, degrees, mu = {:g}, A (md)", friction),
               over_seeds(found, [](const TriaxialCurve& curve) { return friction_angle(peak_of(curve).deviator); }),
               fmt::format("triaxial.phi_{:g}", friction));
    report.add(fmt::format("dilatancy at the peak, mu = {:g}, A (md)", friction),
               over_seeds(found, [](const TriaxialCurve& curve) { return peak_of(curve).dilatancy; }),
               fmt::format("triaxial.dilatancy_{:g}", friction));
  }
  const auto deviator = [&](EngineKind engine, char state, double level) {
    return over_seeds(rows_of(rows, engine, state, 0.3, level),
                      [](const TriaxialCurve& curve) { return peak_of(curve).deviator; });
  };
  const Estimate one{1, 0}, reference = deviator(EngineKind::md, 'A', reference_level);
  report.add("peak q/P of C over A, - 1, mu = 0.3 (md)",
             ratio(deviator(EngineKind::md, 'C', reference_level), reference) - one, "triaxial.same_peak");
  for (const char state : {'A', 'C'})
    for (const double level : other_levels)
      if (!rows_of(rows, EngineKind::md, state, 0.3, level).empty())
        report.add(
            fmt::format("peak q/P at kappa = {:g} over 8400, - 1, {} (md)", level, state),
            ratio(deviator(EngineKind::md, state, level), deviator(EngineKind::md, state, reference_level)) - one,
            "triaxial.same_peak");
  report.add("peak q/P of rigid grains over md, - 1, A", ratio(deviator(EngineKind::cd, 'A', 0), reference) - one,
             "triaxial.same_peak");
}

/// Strains of type II come from rearrangement and don't depend on kappa; A resists, C yields.
void report_states(StudyReport& report, const std::vector<StudyRow>& rows) {
  const auto at = [&](char state, double level, double strain) {
    return over_seeds(rows_of(rows, EngineKind::md, state, 0.3, level),
                      [&](const TriaxialCurve& curve) { return deviator_at(curve, strain); });
  };
  constexpr double late = 0.005;
  const Estimate one{1, 0};
  for (const double level : other_levels)
    if (!rows_of(rows, EngineKind::md, 'C', 0.3, level).empty())
      report.add(fmt::format("C: q/P at strain 0.005, kappa = {:g} over 8400, - 1", level),
                 ratio(at('C', level, late), at('C', reference_level, late)) - one, "triaxial.type_II");
  report.add("q/P of A minus C at strain 0.001, kappa = 8400",
             at('A', reference_level, 1e-3) - at('C', reference_level, 1e-3), "triaxial.stiffer");
}

/// Curves of seed 1 of the rows that `shown` picks, with their names.
Figure curve_figure(const std::string& title, const std::vector<StudyRow>& rows, bool deviator,
                    const std::function<std::string(const StudyRun&)>& shown) {
  Figure figure{title, "axial strain", deviator ? "q / P" : "volume strain", false, false, {}};
  for (const StudyRow& row : rows) {
    if (row.plan.parameter("seed") != 1 || std::isnan(row.plan.parameter("mu"))) continue;
    const TriaxialCurve curve = triaxial_curve(row);
    const std::string label = shown(row.plan);
    if (label.empty() || curve.strain.empty()) continue;
    figure.series.push_back({label, curve.strain, deviator ? curve.deviator : curve.volume, {}, true, false});
  }
  return figure;
}

/// Friction of contacts, the two states and the two engines, at one kappa.
std::string friction_label(const StudyRun& run) {
  const double level = run.parameter("kappa");
  if (run.engine == EngineKind::md && level != reference_level) return "";
  return fmt::format("{}, {}, mu = {:g}", engine_name(run.engine), static_cast<char>(run.parameter("state")),
                     run.parameter("mu"));
}

/// The stiffness levels of a state with mu = 0.3.
std::string level_label(const StudyRun& run, char state) {
  const bool one = run.engine == EngineKind::md && run.parameter("state") == state && run.parameter("mu") == 0.3;
  return one ? fmt::format("kappa = {:g}", run.parameter("kappa")) : "";
}

void add_figures(StudyReport& report, const std::vector<StudyRow>& rows) {
  for (const bool deviator : {true, false})
    report.figures.push_back(
        {deviator ? "deviator" : "volume",
         curve_figure("Triaxial compression of spheres, kappa = 8400 or rigid", rows, deviator, friction_label)});
  for (const char state : {'A', 'C'})
    report.figures.push_back({fmt::format("kappa_{}", state),
                              curve_figure(fmt::format("Stiffness levels of state {} (md, mu = 0.3)", state), rows,
                                           true, [state](const StudyRun& run) { return level_label(run, state); })});
  report.figures.push_back({"type_I", ramp_figure(rows)});
}

}  // namespace

std::vector<StudyRun> plan(StudySize size) {
  const bool quick = size == StudySize::quick;
  std::vector<StudyRun> runs;
  const auto add = [&](EngineKind engine, char state, double friction, double level) {
    for (const int seed : seeds_of(quick)) {
      SolidScene scene = solid_sample(engine, level, seed, quick);
      scene.friction = friction;
      const std::string name = fmt::format("{}_{}_mu_{:g}{}_seed_{}", engine_name(engine), state, friction,
                                           level > 0 ? "_kappa_" + plain_number(level) : "", seed);
      scene.title = "triaxial: " + name;
      runs.push_back({name,
                      engine,
                      {{"state", state}, {"mu", friction}, {"kappa", level}, {"seed", seed}},
                      assembly_scene(scene, state) + triaxial_stage(quick ? 0.06 : 0.1, usual_rate(quick)),
                      true});
    }
  };
  for (const double friction : {0.0, 0.3, 0.5, 1.0}) add(EngineKind::md, 'A', friction, reference_level);
  for (const char state : {'A', 'C'}) {
    if (state == 'C') add(EngineKind::md, state, 0.3, reference_level);
    for (const double level : other_levels)
      if (!quick || level == stiff_level || level == other_levels.back()) add(EngineKind::md, state, 0.3, level);
  }
  add(EngineKind::cd, 'A', 0.3, 0);
  add_quasistatic_runs(runs, quick);
  add_creep_runs(runs, quick);
  add_ramp_runs(runs, quick);
  return runs;
}

StudyReport report(const std::vector<StudyRow>& rows) {
  StudyReport report;
  report_peaks(report, rows);
  report_states(report, rows);
  report_quasistatic(report, rows);
  report_creep(report, rows);
  report_ramps(report, rows);
  add_figures(report, rows);
  report.remarks.emplace_back(
      "figures show seed 1; findings are means over the seeds, with the error of their scatter; "
      "kappa = 0 stands for rigid grains");
  return report;
}

}  // namespace galet::triaxial
