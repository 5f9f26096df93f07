// Flow laws of cohesive disks: md with the published law of attraction, sqrt(4 K_N F0 h), and rigid grains with a
// constant attraction F0 beside it.
#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "src/engines.hpp"
#include "src/studies/estimates.hpp"
#include "src/studies/flow_fit.hpp"
#include "src/studies/scene_head.hpp"
#include "src/studies/studies.hpp"
#include "src/studies/templates.hpp"

namespace galet::cohesive_flow {

namespace {

constexpr double stiffness = 1e5;
constexpr double weak = 10, slight = 2;
constexpr double fast = 0.2;  ///< I at which Phi(eta) is published for mu = 0 and 0.4
constexpr double fit_from = 0.02, fit_to = 0.25;

/// kappa h*/d in equilibrium under a force P d: the positive root of x^2 - 2 sqrt(eta) x - 1 = 0, squared.
double deflection(double eta) { return 1 + 2 * eta + 2 * std::sqrt(eta + eta * eta); }

FlowFit fit_of(const std::vector<StudyRow>& rows, EngineKind engine, double eta) {
  return fit_flow(rows_with(rows, engine, {{"eta", eta}, {"mu", 0.4}}), fit_from, fit_to);
}

void report_engine(StudyReport& report, const std::vector<StudyRow>& rows, EngineKind engine) {
  const std::string of = " (" + engine_name(engine) + ")";
  const std::vector<double> numbers = values_of(rows, "eta");
  if (numbers.empty()) return;
  const double strong = *std::max_element(numbers.begin(), numbers.end());
  const FlowFit none = fit_of(rows, engine, 0), little = fit_of(rows, engine, slight),
                some = fit_of(rows, engine, weak), much = fit_of(rows, engine, strong);
  report.add("Phi_max, eta = 2 minus 0" + of, little.solid_fraction_max - none.solid_fraction_max, "cohesive.falls");
  report.add(fmt::format("Phi_max, eta = {:g} minus 2{}", strong, of),
             much.solid_fraction_max - little.solid_fraction_max, "cohesive.falls");
  report.add(fmt::format("a, eta = {:g} minus 0{}", strong, of), much.a - none.a, "cohesive.falls");
  report.add("mu*_min, eta = 2 minus 0" + of, little.mu_min - none.mu_min, "cohesive.mu_min_weak");
  report.add("mu*_min, eta = 10 minus 0" + of, some.mu_min - none.mu_min, "cohesive.mu_min_weak",
             "the threshold itself, where the strong regime begins");
  report.add(fmt::format("mu*_min, eta = {:g} minus 10{}", strong, of), much.mu_min - some.mu_min, "cohesive.rises");
  const auto z = [&](double eta) {
    return value_of(row_with(rows, engine, {{"eta", eta}, {"mu", 0.4}, {"I", fast}}), Observable::z);
  };
  report.add(fmt::format("z at I = 0.2, eta = {:g} minus 0{}", strong, of), z(strong) - z(0), "cohesive.rises");
}

Figure law_figure(const std::vector<StudyRow>& rows, Observable observable) {
  const bool friction = observable == Observable::mu_star;
  Figure figure{friction ? "Friction law of cohesive disks" : "Dilatancy law of cohesive disks",
                "inertial number {/:Italic I}",
                friction ? "mu*" : "Phi",
                true,
                false,
                {}};
  for (const double eta : values_of(rows, "eta"))
    for (const EngineKind engine : {EngineKind::md, EngineKind::cd}) {
      const auto found = rows_with(rows, engine, {{"eta", eta}, {"mu", 0.4}});
      if (!found.empty())
        figure.series.push_back(
            series_of(fmt::format("eta = {:g}, {}", eta, engine_name(engine)), found, "I", observable));
    }
  return figure;
}

/// Phi at I = 0.2 against eta, by the friction of contacts.
Figure fraction_figure(const std::vector<StudyRow>& rows) {
  Figure figure{"Solid fraction at I = 0.2", "cohesion number eta", "Phi", false, false, {}};
  for (const double friction : {0.0, 0.4})
    for (const EngineKind engine : {EngineKind::md, EngineKind::cd}) {
      const auto found = rows_with(rows, engine, {{"mu", friction}, {"I", fast}});
      if (found.empty()) continue;
      Series series = series_of(fmt::format("mu = {:g}, {}", friction, engine_name(engine)), found, "eta",
                                Observable::solid_fraction);
      series.line = true;
      figure.series.push_back(series);
    }
  return figure;
}

StudyRun cohesive_run(EngineKind engine, bool quick, double friction, double eta, double inertial_number) {
  ShearScene scene;
  scene.engine = engine;
  scene.grains = quick ? 200 : full_size_disks;
  scene.contact_steps = quick ? 0 : sparing_steps;
  scene.friction = friction;
  scene.stiffness_level = stiffness;
  scene.inertial_number = inertial_number;
  scene.strain = std::clamp((quick ? 200 : 400) * inertial_number, 12.0, 40.0);
  scene.settling = 3;
  if (eta > 0)
    scene.material = fmt::format("cohesion_number = {}\ncohesion_law = \"{}\"\n", eta,
                                 engine == EngineKind::md ? "square_root" : "constant");
  const std::string state = fmt::format("mu_{:g}_eta_{:g}_I_{}", friction, eta, plain_number(inertial_number));
  scene.title = fmt::format("cohesive-flow: {}, mu = {:g}, eta = {:g}, I = {}", engine_name(engine), friction, eta,
                            plain_number(inertial_number));
  return {engine_name(engine) + "_" + state,
          engine,
          {{"mu", friction}, {"eta", eta}, {"I", inertial_number}},
          shear_scene(scene)};
}

}  // namespace

std::vector<StudyRun> plan(StudySize size) {
  const bool quick = size == StudySize::quick;
  const std::vector<double> numbers =
      quick ? std::vector{0.0, slight, weak, 50.0} : std::vector{0.0, 0.5, 1.0, slight, 5.0, weak, 20.0, 50.0, 80.0};
  const std::vector<double> states = quick ? std::vector{0.05, 0.1, fast} : std::vector{0.01, 0.02, 0.05, 0.1, fast};
  std::vector<StudyRun> runs;
  for (const EngineKind engine : {EngineKind::md, EngineKind::cd})
    for (const double eta : numbers) {
      for (const double inertial_number : states)
        runs.push_back(cohesive_run(engine, quick, 0.4, eta, inertial_number));
      runs.push_back(cohesive_run(engine, quick, 0, eta, fast));
    }
  return runs;
}

StudyReport report(const std::vector<StudyRow>& rows) {
  StudyReport report;
  for (const EngineKind engine : {EngineKind::md, EngineKind::cd}) report_engine(report, rows, engine);
  for (const double eta : values_of(rows, "eta")) {
    const StudyRow* row = row_with(rows, EngineKind::md, {{"eta", eta}, {"mu", 0.4}, {"I", 0.1}});
    report.add(fmt::format("kappa h*/d over H(eta), eta = {:g}, I = 0.1 (md)", eta),
               (stiffness / deflection(eta)) * value_of(row, Observable::mean_overlap), "cohesive.deflection");
  }
  report.figures.push_back({"mu_star", law_figure(rows, Observable::mu_star)});
  report.figures.push_back({"Phi", law_figure(rows, Observable::solid_fraction)});
  report.figures.push_back({"Phi_eta", fraction_figure(rows)});
  report.remarks.emplace_back("lines are fitted over all I of the study");
  return report;
}

}  // namespace galet::cohesive_flow
