// The linear flow laws against the friction coefficient of contacts, both engines.
#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "src/engines.hpp"
#include "src/studies/estimates.hpp"
#include "src/studies/flow_fit.hpp"
#include "src/studies/scene_head.hpp"
#include "src/studies/studies.hpp"
#include "src/studies/templates.hpp"

namespace galet::flow_friction {

namespace {

constexpr std::array engines = {EngineKind::md, EngineKind::cd};

std::vector<const StudyRow*> states_of(const std::vector<StudyRow>& rows, EngineKind engine, double friction) {
  return rows_with(rows, engine, {{"mu", friction}});
}

void report_engine(StudyReport& report, const std::vector<StudyRow>& rows, EngineKind engine) {
  const std::string of = " (" + engine_name(engine) + ")";
  const std::vector<double> frictions = values_of(rows, "mu");
  double least = 1, most = 0;
  for (const double friction : frictions) {
    if (friction == 0) continue;
    least = std::min(least, friction), most = std::max(most, friction);
    const FlowFit fit = fit_flow(states_of(rows, engine, friction));
    report.add(fmt::format("a at mu = {:g}{}", friction, of), fit.a, "friction.a");
    report.add(fmt::format("b at mu = {:g}{}", friction, of), fit.b, "friction.b");
  }
  const FlowFit smooth = fit_flow(states_of(rows, engine, least)), rough = fit_flow(states_of(rows, engine, most));
  report.add(fmt::format("mu*_min, mu = {:g} minus {:g}{}", most, least, of), rough.mu_min - smooth.mu_min,
             "friction.mu_min_grows");
  report.add(fmt::format("Phi_max, mu = {:g} minus {:g}{}", most, least, of),
             rough.solid_fraction_max - smooth.solid_fraction_max, "friction.Phi_max_falls");
  const FlowFit none = fit_flow(states_of(rows, engine, 0)), reference = fit_flow(states_of(rows, engine, 0.4));
  report.add("mu*_min, mu = 0 over mu = 0.4" + of, ratio(none.mu_min, reference.mu_min), "friction.frictionless",
             "of the line over the linear window; without friction mu* bends down below I = 0.01");
}

Figure friction_figure(const std::vector<StudyRow>& rows, Observable observable) {
  const bool friction = observable == Observable::mu_star;
  Figure figure{
      friction ? "Friction law against the friction of contacts" : "Dilatancy law against the friction of contacts",
      "inertial number {/:Italic I}",
      friction ? "mu*" : "Phi",
      true,
      false,
      {}};
  const std::vector<double> frictions = values_of(rows, "mu");
  for (std::size_t k = 0; k < frictions.size(); ++k)
    for (const EngineKind engine : engines) {
      const auto states = states_of(rows, engine, frictions[k]);
      const std::string label = fmt::format("mu = {:g}, {}", frictions[k], engine_name(engine));
      if (!states.empty()) figure.series.push_back(with_look(series_of(label, states, "I", observable), k, engine));
    }
  return figure;
}

}  // namespace

std::vector<StudyRun> plan(StudySize size) {
  const bool quick = size == StudySize::quick;
  const std::vector<double> frictions =
      quick ? std::vector{0.0, 0.1, 0.4, 0.8} : std::vector{0.0, 0.1, 0.2, 0.3, 0.4, 0.6, 0.8};
  const std::vector<double> states =
      quick ? std::vector{0.03, 0.1, 0.2} : std::vector{2e-3, 5e-3, 0.01, 0.02, 0.05, 0.1, 0.2};
  std::vector<StudyRun> runs;
  for (const EngineKind engine : engines)
    for (const double friction : frictions)
      for (const double inertial_number : states) {
        ShearScene scene;
        scene.engine = engine;
        scene.grains = quick ? 200 : full_size_disks;
        scene.contact_steps = quick ? 0 : sparing_steps;
        scene.friction = friction;
        scene.inertial_number = inertial_number;
        scene.strain = std::clamp((quick ? 200 : 600) * inertial_number, 12.0, 60.0);
        const std::string state = fmt::format("mu_{:g}_I_{}", friction, plain_number(inertial_number));
        scene.title = fmt::format("flow-friction: {}, mu = {:g}, I = {}", engine_name(engine), friction,
                                  plain_number(inertial_number));
        runs.push_back({engine_name(engine) + "_" + state,
                        engine,
                        {{"mu", friction}, {"I", inertial_number}},
                        shear_scene(scene)});
      }
  return runs;
}

StudyReport report(const std::vector<StudyRow>& rows) {
  StudyReport report;
  for (const EngineKind engine : engines) report_engine(report, rows, engine);
  report.figures.push_back({"mu_star", friction_figure(rows, Observable::mu_star)});
  report.figures.push_back({"Phi", friction_figure(rows, Observable::solid_fraction)});
  return report;
}

}  // namespace galet::flow_friction
