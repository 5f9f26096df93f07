// Flow down a rough inclined plane in both engines: the stress ratio that the slope imposes, I and Phi in depth, the
// local law beside homogeneous shear, stop and flow, and what the step of cd does.
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/format.h>

#include "src/engines.hpp"
#include "src/line_fit.hpp"
#include "src/studies/estimates.hpp"
#include "src/studies/flow_fit.hpp"
#include "src/studies/gradient_templates.hpp"
#include "src/studies/published.hpp"
#include "src/studies/scene_head.hpp"
#include "src/studies/studies.hpp"
#include "src/studies/templates.hpp"

namespace galet::inclined_plane {

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();
constexpr std::array engines = {EngineKind::md, EngineKind::cd};
constexpr double coarse = 0.01;       ///< cd's step over sqrt(d / g), where it is not varied
constexpr double still = 1e-3;        ///< I of the bulk below which a layer has stopped: cd creeps within its tolerance
constexpr double from_floor = 3.5;    ///< layers that the floor orders, its grains included
constexpr double from_surface = 3;    ///< layers that the free surface lets fluctuate
constexpr double refined_angle = 20;  ///< of the runs at finer steps

double slope_of(double angle) { return std::tan(angle * std::numbers::pi / 180); }

std::vector<LocalState> bulk_of(const StudyRow& row) {
  const std::vector<LocalState> all = layer_states(row.run.measures.profile);
  double surface = 0;
  for (const LocalState& layer : all)
    if (layer.solid_fraction > 0.5) surface = layer.position + 0.5;
  std::vector<LocalState> bulk;
  for (const LocalState& layer : all)
    if (layer.position > from_floor && layer.position < surface - from_surface) bulk.push_back(layer);
  return bulk;
}

bool flows(const StudyRow& row) { return mean_over(bulk_of(row), &LocalState::inertial_number).value > still; }

/// Change from the lowest to the highest layer of the bulk along the fitted line, over the mean.
Estimate change_in_depth(const std::vector<LocalState>& bulk, double LocalState::*quantity) {
  if (bulk.size() < 4) return {none, none};
  std::vector<LinePoint> points;
  for (const LocalState& layer : bulk) points.push_back({layer.position, {layer.*quantity, 0}});
  const double scale = (bulk.back().position - bulk.front().position) / mean_over(bulk, quantity).value;
  return scale * fit_line(points).slope;
}

std::vector<const StudyRow*> slopes(const std::vector<StudyRow>& rows, EngineKind engine) {
  return rows_with(rows, engine, {{"dt", engine == EngineKind::cd ? coarse : 0}});
}

void report_flow(StudyReport& report, const StudyRow& row, const std::vector<const StudyRow*>& homogeneous) {
  const double angle = row.plan.parameter("theta");
  const std::string of = fmt::format(", theta = {:g} ({})", angle, engine_name(row.plan.engine));
  const std::vector<LocalState> bulk = bulk_of(row);
  const Estimate mu = mean_over(bulk, &LocalState::mu_star), number = mean_over(bulk, &LocalState::inertial_number),
                 fraction = mean_over(bulk, &LocalState::solid_fraction), slope{slope_of(angle), 0}, one{1, 0};
  report.add("mu* of the bulk over tan theta, - 1" + of, ratio(mu, slope) - one, "slope.ratio");
  report.add("I, relative change through the bulk" + of, change_in_depth(bulk, &LocalState::inertial_number),
             "slope.uniform_I");
  report.add("Phi, relative change through the bulk" + of, change_in_depth(bulk, &LocalState::solid_fraction),
             "slope.uniform_Phi");
  const FlowFit law = fit_flow(homogeneous);
  const Estimate friction = homogeneous_at(homogeneous, number.value, Observable::mu_star);
  report.add("mu* minus that of homogeneous shear at the same I" + of,
             mu - Estimate{friction.value, std::hypot(friction.error, law.b.value * number.error)}, "slope.local_mu");
  const Estimate there = homogeneous_at(homogeneous, number.value, Observable::solid_fraction);
  report.add("Phi minus that of homogeneous shear at the same I" + of,
             fraction - Estimate{there.value, std::hypot(there.error, law.a.value * number.error)}, "slope.local_Phi",
             fmt::format("I = {:.4f} +- {:.4f}", number.value, number.error));
}

void report_stop(StudyReport& report, const std::vector<StudyRow>& rows, EngineKind engine, const FlowFit& law) {
  double stopped = none, flowing = none;
  for (const StudyRow* row : slopes(rows, engine)) {
    const double angle = row->plan.parameter("theta");
    if (flows(*row) && !(flowing < angle)) flowing = angle;
    if (!flows(*row) && !(stopped > angle)) stopped = angle;
  }
  report.add("tan of the least slope that flows, minus mu*_min of homogeneous shear (" + engine_name(engine) + ")",
             Estimate{slope_of(flowing), 0} - law.mu_min, "slope.flows_above",
             fmt::format("stops at {:g} degrees, flows at {:g}", stopped, flowing));
}

/// I on a slope is (tan theta - mu*_min) / b: mu* of cd at md's I exceeds md's by b (I_md - I_cd).
void report_steps(StudyReport& report, const std::vector<StudyRow>& rows, const FlowFit& law) {
  const StudyRow* soft = row_with(rows, EngineKind::md, {{"theta", refined_angle}});
  for (const StudyRow* row : rows_with(rows, EngineKind::cd, {{"theta", refined_angle}})) {
    if (!soft) break;
    const Estimate difference = mean_over(bulk_of(*soft), &LocalState::inertial_number) -
                                mean_over(bulk_of(*row), &LocalState::inertial_number);
    report.add(fmt::format("mu* of cd over md at the same I, - 1, theta = {:g}, dt = {:g} sqrt(d / g)", refined_angle,
                           row->plan.parameter("dt")),
               law.b.value / slope_of(refined_angle) * difference, "flow.engines");
  }
}

Figure law_figure(const std::vector<StudyRow>& rows, Observable observable, double LocalState::*quantity) {
  const bool friction = observable == Observable::mu_star;
  Figure figure{friction ? "Friction law: slopes and homogeneous shear" : "Dilatancy law: slopes and homogeneous shear",
                "inertial number {/:Italic I}",
                friction ? "mu*" : "Phi",
                true,
                false,
                {}};
  for (const EngineKind engine : engines) {
    Series shear = series_of(engine_name(engine) + ", homogeneous shear", shear_rows(rows, engine), "I", observable);
    shear.line = true;
    if (!shear.x.empty()) figure.series.push_back(shear);
    Series layers{engine_name(engine) + ", bulk of a slope", {}, {}, {}, false, false};
    for (const StudyRow* row : slopes(rows, engine)) {
      if (!flows(*row)) continue;
      const auto bulk = bulk_of(*row);
      layers.x.push_back(mean_over(bulk, &LocalState::inertial_number).value);
      layers.y.push_back(mean_over(bulk, quantity).value);
      layers.y_error.push_back(mean_over(bulk, quantity).error);
    }
    if (!layers.x.empty()) figure.series.push_back(layers);
  }
  return figure;
}

Figure depth_figure(const std::vector<StudyRow>& rows) {
  Figure figure{"Inertial number through a layer that flows down a slope",
                "height above the floor / d",
                "inertial number {/:Italic I}",
                false,
                false,
                {}};
  for (const EngineKind engine : engines)
    for (const StudyRow* row : slopes(rows, engine)) {
      const double angle = row->plan.parameter("theta");
      if (!flows(*row) || angle < 18 || angle == 19) continue;  // more lines than colours otherwise
      Series series{fmt::format("{}, {:g} degrees", engine_name(engine), angle), {}, {}, {}};
      series.line = true;
      for (const LocalState& layer : layer_states(row->run.measures.profile)) {
        if (layer.solid_fraction < 0.5 || layer.position < 1) continue;
        series.x.push_back(layer.position), series.y.push_back(layer.inertial_number);
      }
      figure.series.push_back(series);
    }
  return figure;
}

void add_slope(std::vector<StudyRun>& runs, EngineKind engine, double angle, double dt, bool quick) {
  SlopeScene scene;
  scene.engine = engine;
  scene.angle = angle;
  scene.cd_dt_factor = dt;
  if (quick) scene.grains = 240, scene.length = 16, scene.stiffness = 2e4, scene.duration = 500;
  const std::string name =
      fmt::format("{}_theta_{:g}{}", engine_name(engine), angle, dt != coarse ? "_dt_" + plain_number(dt) : "");
  scene.title = "inclined-plane: " + name;
  runs.push_back(
      {name, engine, {{"theta", angle}, {"dt", engine == EngineKind::cd ? dt : 0}}, slope_scene(scene), false, true});
}

}  // namespace

std::vector<StudyRun> plan(StudySize size) {
  const bool quick = size == StudySize::quick;
  std::vector<StudyRun> runs;
  for (const EngineKind engine : engines) {
    for (const double angle :
         quick ? std::vector<double>{15, 17, 18, 20, 22} : std::vector<double>{13, 14, 15, 16, 17, 18, 19, 20, 22, 24})
      add_slope(runs, engine, angle, coarse, quick);
    if (engine == EngineKind::cd)
      for (const int finer : {2, 4}) add_slope(runs, engine, refined_angle, coarse / finer, quick);
    for (const double state :
         quick ? std::vector{0.02, 0.05, 0.1, 0.2} : std::vector{0.01, 0.02, 0.05, 0.1, 0.15, 0.2}) {
      ShearScene scene;
      scene.engine = engine;
      scene.grains = quick ? 400 : full_size_disks;
      scene.contact_steps = quick ? 0 : sparing_steps;
      scene.stiffness_level = quick ? 1e3 : 1e4;
      scene.inertial_number = state;
      scene.strain = quick ? 20 : 60;
      runs.push_back(shear_row("inclined-plane", scene));
    }
  }
  return runs;
}

StudyReport report(const std::vector<StudyRow>& rows) {
  StudyReport report;
  for (const EngineKind engine : engines) {
    const auto shear = shear_rows(rows, engine);
    const FlowFit law = fit_flow(shear);
    for (const StudyRow* row : slopes(rows, engine))
      if (flows(*row)) report_flow(report, *row, shear);
    report_stop(report, rows, engine, law);
    if (engine == EngineKind::cd) report_steps(report, rows, law);
  }
  report.figures.push_back({"mu_star", law_figure(rows, Observable::mu_star, &LocalState::mu_star)});
  report.figures.push_back({"Phi", law_figure(rows, Observable::solid_fraction, &LocalState::solid_fraction)});
  report.figures.push_back({"depth", depth_figure(rows)});
  report.remarks.emplace_back(
      "the bulk: from 3.5 d above the cell's bottom (the floor's grains are at 0.5 d) to 3 d below the surface; errors "
      "of its means are the scatter of its layers");
  return report;
}

}  // namespace galet::inclined_plane
