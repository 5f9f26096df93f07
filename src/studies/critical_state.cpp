// The critical state in simple shear: mu*_c and Phi_c against the friction of contacts, in 2D and 3D, in both engines,
// from loose and from dense starts.
#include <cmath>

#include <fmt/format.h>

#include "src/engines.hpp"
#include "src/studies/estimates.hpp"
#include "src/studies/published.hpp"
#include "src/studies/scene_head.hpp"
#include "src/studies/studies.hpp"
#include "src/studies/templates.hpp"

namespace galet::critical_state {

namespace {

constexpr double rolling_example = 0.05;                 ///< mu_R / d
constexpr double densest_2d = 0.85, densest_3d = 0.639;  ///< Phi* of random packings (chapter, fig. critiq)

const StudyRow* state_of(const std::vector<StudyRow>& rows, EngineKind engine, int dimension, double friction,
                         bool dense) {
  return row_with(rows, engine, {{"D", dimension}, {"mu", friction}, {"mu_R", 0}, {"dense", dense ? 1.0 : 0.0}});
}

void report_3d(StudyReport& report, const std::vector<StudyRow>& rows, EngineKind engine) {
  const std::string of = " (" + engine_name(engine) + ")";
  for (const double friction : values_of(rows, "mu")) {
    const StudyRow* row = state_of(rows, engine, 3, friction, false);
    if (!row) continue;
    report.add(fmt::format("Phi_c, 3D, mu = {:g}{}", friction, of), (*row)[Observable::solid_fraction],
               fmt::format("critical.Phi_3D_{:g}", friction));
    if (friction == 0) report.add("mu*_c, 3D, mu = 0" + of, (*row)[Observable::mu_star], "critical.mu_star_3D_0");
    if (friction == 0.3) report.add("mu*_c, 3D, mu = 0.3" + of, (*row)[Observable::mu_star], "critical.mu_star_3D_0.3");
    if (friction == 0.5) report.add("mu*_c, 3D, mu = 0.5" + of, (*row)[Observable::mu_star], "critical.mu_star_3D_0.5");
  }
}

void report_2d(StudyReport& report, const std::vector<StudyRow>& rows, EngineKind engine) {
  const std::string of = " (" + engine_name(engine) + ")";
  const StudyRow* reference = state_of(rows, engine, 2, 0.4, false);
  report.add("mu*_c, 2D, mu = 0.4" + of, value_of(reference, Observable::mu_star), "critical.mu_star_2D");
  report.add("Phi_c, 2D, mu = 0.4" + of, value_of(reference, Observable::solid_fraction), "critical.Phi_2D");
  const StudyRow* smooth = state_of(rows, engine, 2, 0.1, false);
  report.add("mu*_c, 2D, mu = 0.4 minus 0.1" + of,
             value_of(reference, Observable::mu_star) - value_of(smooth, Observable::mu_star), "critical.grows");
  report.add("Phi_c, 2D, mu = 0.4 minus 0.1" + of,
             value_of(reference, Observable::solid_fraction) - value_of(smooth, Observable::solid_fraction),
             "critical.falls");
  const StudyRow* rolling = row_with(rows, engine, {{"D", 2}, {"mu", 0.4}, {"mu_R", rolling_example}});
  report.add(fmt::format("mu*_c, 2D, mu_R/d = {:g} minus 0{}", rolling_example, of),
             value_of(rolling, Observable::mu_star) - value_of(reference, Observable::mu_star),
             "critical.rolling_grows");
  report.add(fmt::format("Phi_c, 2D, mu_R/d = {:g} minus 0{}", rolling_example, of),
             value_of(rolling, Observable::solid_fraction) - value_of(reference, Observable::solid_fraction),
             "critical.rolling_falls");
}

void report_starts(StudyReport& report, const std::vector<StudyRow>& rows, EngineKind engine) {
  for (const StudyRow* dense : rows_with(rows, engine, {{"mu_R", 0}, {"dense", 1}})) {
    const double friction = dense->plan.parameter("mu");
    const int dimension = static_cast<int>(dense->plan.parameter("D"));
    const StudyRow* loose = state_of(rows, engine, dimension, friction, false);
    const std::string of =
        fmt::format(", dense over loose start, - 1, {}D, mu = {:g} ({})", dimension, friction, engine_name(engine));
    const Estimate one{1, 0};
    report.add("mu*_c" + of, ratio((*dense)[Observable::mu_star], value_of(loose, Observable::mu_star)) - one,
               "critical.start_mu_star");
    report.add("Phi_c" + of,
               ratio((*dense)[Observable::solid_fraction], value_of(loose, Observable::solid_fraction)) - one,
               "critical.start_Phi");
  }
}

Figure friction_figure(const std::vector<StudyRow>& rows, Observable observable) {
  const bool stress = observable == Observable::mu_star;
  Figure figure{stress ? "Internal friction in the critical state" : "Solid fraction in the critical state",
                "friction of contacts mu",
                stress ? "mu*_c" : "Phi_c / Phi*",
                false,
                false,
                {}};
  if (stress) {
    const Published& frictionless = published("critical.mu_star_3D_0");
    figure.series.push_back({"3D, mu = 0: Peyneau and Roux 2008",
                             {0, 0.05},
                             {frictionless.value, frictionless.value},
                             {frictionless.uncertainty, frictionless.uncertainty},
                             false,
                             true});
  }
  for (const int dimension : {2, 3})
    for (const EngineKind engine : {EngineKind::md, EngineKind::cd})
      for (const bool dense : {false, true}) {
        const auto found = rows_with(rows, engine, {{"D", dimension}, {"mu_R", 0}, {"dense", dense ? 1.0 : 0.0}});
        if (found.empty()) continue;
        Series series =
            series_of(fmt::format("{}D, {}, from {}", dimension, engine_name(engine), dense ? "dense" : "loose"), found,
                      "mu", observable);
        if (!stress)
          for (std::size_t k = 0; k < series.y.size(); ++k) {
            series.y[k] /= dimension == 2 ? densest_2d : densest_3d;
            series.y_error[k] /= dimension == 2 ? densest_2d : densest_3d;
          }
        figure.series.push_back(series);
      }
  return figure;
}

StudyRun critical_run(EngineKind engine, int dimension, double friction, double rolling, bool dense, bool quick) {
  ShearScene scene;
  scene.engine = engine;
  scene.dimension = dimension;
  scene.grains = quick ? (dimension == 2 ? 200 : 300) : (dimension == 2 ? full_size_disks : 2000);
  scene.friction = friction;
  scene.stiffness_level = quick || dimension == 3 ? 3000 : 1e4;
  scene.contact_steps = quick ? 0 : sparing_steps;
  scene.inertial_number = quick ? (dimension == 2 ? 5e-3 : 0.02) : 1e-3;
  scene.strain = quick ? 5 : dimension == 2 ? 10 : 6;
  scene.settling = 2;
  scene.dense_strain = dense ? 2 : 0;
  if (rolling > 0) scene.material = fmt::format("rolling_friction = {}\n", rolling);
  const std::string state = fmt::format("{}D_mu_{:g}{}{}", dimension, friction,
                                        rolling > 0 ? fmt::format("_mu_R_{:g}", rolling) : "", dense ? "_dense" : "");
  scene.title = fmt::format("critical-state: {}, {}D, mu = {:g}, {} start, I = {}", engine_name(engine), dimension,
                            friction, dense ? "dense" : "loose", plain_number(scene.inertial_number));
  return {engine_name(engine) + "_" + state,
          engine,
          {{"D", dimension}, {"mu", friction}, {"mu_R", rolling}, {"dense", dense ? 1 : 0}},
          shear_scene(scene)};
}

}  // namespace

std::vector<StudyRun> plan(StudySize size) {
  const bool quick = size == StudySize::quick;
  std::vector<StudyRun> runs;
  for (const EngineKind engine : {EngineKind::md, EngineKind::cd}) {
    const std::vector<double> frictions_2d = quick ? std::vector{0.1, 0.4} : std::vector{0.0, 0.1, 0.2, 0.4, 0.8};
    const std::vector<double> frictions_3d = quick ? std::vector{0.0, 0.3} : std::vector{0.0, 0.1, 0.3, 0.5, 1.0};
    for (const double friction : frictions_2d) runs.push_back(critical_run(engine, 2, friction, 0, false, quick));
    runs.push_back(critical_run(engine, 2, 0.4, 0, true, quick));
    runs.push_back(critical_run(engine, 2, 0.4, rolling_example, false, quick));
    for (const double friction : frictions_3d) runs.push_back(critical_run(engine, 3, friction, 0, false, quick));
    if (!quick) runs.push_back(critical_run(engine, 3, 0.3, 0, true, quick));
  }
  return runs;
}

StudyReport report(const std::vector<StudyRow>& rows) {
  StudyReport report;
  for (const EngineKind engine : {EngineKind::md, EngineKind::cd}) {
    report_2d(report, rows, engine);
    report_3d(report, rows, engine);
    report_starts(report, rows, engine);
  }
  report.figures.push_back({"mu_star", friction_figure(rows, Observable::mu_star)});
  report.figures.push_back({"Phi", friction_figure(rows, Observable::solid_fraction)});
  report.remarks.emplace_back(
      "sheared at I = 1e-3; the quick size at 5e-3 (2D) and 0.02 (3D), where mu* is above and Phi below the critical "
      "values "
      "by about 1.1 I and 0.4 I in 2D");
  return report;
}

}  // namespace galet::critical_state
