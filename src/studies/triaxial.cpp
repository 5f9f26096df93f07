// Triaxial compression of spheres: peak friction angle and dilatancy against the friction of contacts, and what a
// stiffness level does to the states A and C (strain intervals of type I and II).
#include <algorithm>
#include <cmath>
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

namespace galet::triaxial {

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();
constexpr double reference_level = 8400, stiff_level = 39000;

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

/// q/P at an axial strain, by linear interpolation.
double deviator_at(const TriaxialCurve& curve, double strain) {
  for (std::size_t k = 1; k < curve.strain.size(); ++k)
    if (curve.strain[k] >= strain && curve.strain[k - 1] < strain) {
      const double t = (strain - curve.strain[k - 1]) / (curve.strain[k] - curve.strain[k - 1]);
      return curve.deviator[k - 1] + t * (curve.deviator[k] - curve.deviator[k - 1]);
    }
  return none;
}

Estimate over_seeds(const std::vector<const StudyRow*>& rows,
                    const std::function<double(const TriaxialCurve&)>& number) {
  return mean_over(rows, [&](const StudyRow& row) { return number(triaxial_curve(row)); });
}

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
  report.add("peak q/P at kappa = 39000 over 8400, - 1, A (md)",
             ratio(deviator(EngineKind::md, 'A', stiff_level), reference) - one, "triaxial.same_peak");
  report.add("peak q/P of rigid grains over md, - 1, A", ratio(deviator(EngineKind::cd, 'A', 0), reference) - one,
             "triaxial.same_peak");
}

/// Strains of type I are those of the contacts and go as 1/kappa; those of type II come from rearrangement.
void report_types(StudyReport& report, const std::vector<StudyRow>& rows) {
  const auto at = [&](char state, double level, double strain) {
    return over_seeds(rows_of(rows, EngineKind::md, state, 0.3, level),
                      [&](const TriaxialCurve& curve) { return deviator_at(curve, strain); });
  };
  constexpr double early = 2, late = 0.005;
  const Estimate one{1, 0};
  report.add("A: q/P at kappa strain = 2, kappa = 39000 over 8400, - 1",
             ratio(at('A', stiff_level, early / stiff_level), at('A', reference_level, early / reference_level)) - one,
             "triaxial.type_I");
  report.add("C: q/P at strain 0.005, kappa = 39000 over 8400, - 1",
             ratio(at('C', stiff_level, late), at('C', reference_level, late)) - one, "triaxial.type_II");
  report.add("q/P of A minus C at strain 0.001, kappa = 8400",
             at('A', reference_level, 1e-3) - at('C', reference_level, 1e-3), "triaxial.stiffer");
}

Figure curve_figure(const std::vector<StudyRow>& rows, bool deviator) {
  Figure figure{
      "Triaxial compression of spheres", "axial strain", deviator ? "q / P" : "volume strain", false, false, {}};
  for (const StudyRow& row : rows) {
    if (row.plan.parameter("seed") != 1) continue;
    const TriaxialCurve curve = triaxial_curve(row);
    Series series;
    series.label = fmt::format("{}, {}, mu = {:g}", engine_name(row.plan.engine),
                               static_cast<char>(row.plan.parameter("state")), row.plan.parameter("mu"));
    if (row.plan.parameter("kappa") > 0) series.label += fmt::format(", kappa = {:g}", row.plan.parameter("kappa"));
    series.line = true;
    series.x = curve.strain;
    series.y = deviator ? curve.deviator : curve.volume;
    if (!series.x.empty()) figure.series.push_back(series);
  }
  return figure;
}

}  // namespace

std::vector<StudyRun> plan(StudySize size) {
  const bool quick = size == StudySize::quick;
  std::vector<StudyRun> runs;
  const auto add = [&](EngineKind engine, char state, double friction, double level) {
    for (const int seed : quick ? std::vector{1, 2} : std::vector{1, 2, 3}) {
      SolidScene scene;
      scene.engine = engine;
      scene.grains = quick ? 300 : 4000;
      scene.seed = seed;
      scene.friction = friction;
      scene.stiffness_level = level > 0 ? level : reference_level;
      scene.equilibrium = engine == EngineKind::md && !quick ? 1e-7 : 1e-6;
      const std::string name = fmt::format("{}_{}_mu_{:g}{}_seed_{}", engine_name(engine), state, friction,
                                           level > 0 ? "_kappa_" + plain_number(level) : "", seed);
      scene.title = "triaxial: " + name;
      runs.push_back({name,
                      engine,
                      {{"state", state}, {"mu", friction}, {"kappa", level}, {"seed", seed}},
                      assembly_scene(scene, state) + triaxial_stage(quick ? 0.06 : 0.1, quick ? 2e-3 : 5e-4),
                      true});
    }
  };
  for (const double friction : {0.0, 0.3, 0.5, 1.0}) add(EngineKind::md, 'A', friction, reference_level);
  add(EngineKind::md, 'A', 0.3, stiff_level);
  add(EngineKind::md, 'C', 0.3, reference_level);
  add(EngineKind::md, 'C', 0.3, stiff_level);
  add(EngineKind::cd, 'A', 0.3, 0);
  return runs;
}

StudyReport report(const std::vector<StudyRow>& rows) {
  StudyReport report;
  report_peaks(report, rows);
  report_types(report, rows);
  report.figures.push_back({"deviator", curve_figure(rows, true)});
  report.figures.push_back({"volume", curve_figure(rows, false)});
  report.remarks.emplace_back(
      "figures show seed 1; findings are means over the seeds, with the error of their scatter; "
      "kappa = 0 stands for rigid grains");
  return report;
}

}  // namespace galet::triaxial
