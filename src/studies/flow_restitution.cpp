// Restitution in flows with and without friction, and the collisional limit of frictionless grains, both engines.
#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "src/engines.hpp"
#include "src/studies/estimates.hpp"
#include "src/studies/published.hpp"
#include "src/studies/scene_head.hpp"
#include "src/studies/studies.hpp"
#include "src/studies/templates.hpp"

namespace galet::flow_restitution {

namespace {

constexpr std::array engines = {EngineKind::md, EngineKind::cd};
constexpr double least = 0.1, most = 0.9;  ///< the ends of the range of e
constexpr double fastest = 0.3;
/// cd's step where grains of e = 0.9 collide rather than press: with the default, 0.01, impacts that follow each other
/// fall into one step, and mu* of frictionless ones at I = 0.3 is 3 % too high (500 disks, two samples each: 0.2894(12)
/// and, with this, 0.2805(11); md at kappa = 1e6 0.2806(12)).
constexpr double collisional = 0.1, collisional_dt = 0.0025;

/// An observable at e = 0.9 over that at e = 0.1, - 1.
Estimate effect(const std::vector<StudyRow>& rows, EngineKind engine, double friction, double inertial_number,
                Observable observable) {
  const auto at = [&](double restitution) {
    return value_of(row_with(rows, engine, {{"mu", friction}, {"I", inertial_number}, {"e", restitution}}), observable);
  };
  return ratio(at(most), at(least)) - Estimate{1, 0};
}

void report_engine(StudyReport& report, const std::vector<StudyRow>& rows, EngineKind engine) {
  const std::string of = " (" + engine_name(engine) + ")";
  for (const double friction : {0.4, 0.0})
    for (const double state : values_of(rows, "I")) {
      if (state > 0.2) continue;
      const bool frictional = friction > 0;
      if (!frictional && state >= 0.1) continue;  // the published statement ends there
      const std::string where = fmt::format(", mu = {:g}, I = {:g}{}", friction, state, of);
      const char* key = frictional ? "restitution.frictional" : "restitution.frictionless";
      report.add("effect of e on mu*" + where, effect(rows, engine, friction, state, Observable::mu_star), key);
      report.add("effect of e on Phi" + where, effect(rows, engine, friction, state, Observable::solid_fraction), key);
    }
  report.add("effect of e on mu*, mu = 0, I = 0.3" + of, effect(rows, engine, 0, fastest, Observable::mu_star),
             "restitution.visible");
  report.add("mu*, mu = 0, e = 0.9, I = 0.3" + of,
             value_of(row_with(rows, engine, {{"mu", 0}, {"e", most}, {"I", fastest}}), Observable::mu_star),
             "restitution.collisional");
}

Figure restitution_figure(const std::vector<StudyRow>& rows, double friction, Observable observable) {
  Figure figure{fmt::format("Effect of restitution, mu = {:g}", friction),
                "inertial number {/:Italic I}",
                observable == Observable::mu_star ? "mu*" : "Phi",
                true,
                false,
                {}};
  if (friction == 0 && observable == Observable::mu_star) {
    const Published& limit = published("restitution.collisional");
    Series band{"collisional limit, e = 0.9", {0.1, 0.3}, {limit.value, limit.value}, {0.01, 0.01}, false, true, 6};
    figure.series.push_back(band);
  }
  // All five would be ten series on top of each other.
  const std::array restitutions = {least, 0.5, most};
  for (std::size_t k = 0; k < restitutions.size(); ++k)
    for (const EngineKind engine : engines) {
      const auto states = rows_with(rows, engine, {{"mu", friction}, {"e", restitutions[k]}});
      const std::string label = fmt::format("e = {:g}, {}", restitutions[k], engine_name(engine));
      if (!states.empty()) figure.series.push_back(with_look(series_of(label, states, "I", observable), k, engine));
    }
  return figure;
}

}  // namespace

std::vector<StudyRun> plan(StudySize size) {
  const bool quick = size == StudySize::quick;
  const std::vector<double> restitutions = quick ? std::vector{0.1, 0.9} : std::vector{0.1, 0.3, 0.5, 0.7, 0.9};
  const std::vector<double> states = quick ? std::vector{0.03, 0.1, 0.3} : std::vector{0.01, 0.03, 0.06, 0.1, 0.2, 0.3};
  std::vector<StudyRun> runs;
  for (const EngineKind engine : engines)
    for (const double friction : {0.4, 0.0})
      for (const double restitution : restitutions)
        for (const double inertial_number : states) {
          ShearScene scene;
          scene.engine = engine;
          scene.grains = quick ? 200 : full_size_disks;
          scene.contact_steps = quick ? 0 : sparing_steps;
          scene.friction = friction;
          scene.restitution = restitution;
          scene.inertial_number = inertial_number;
          scene.strain = std::clamp((quick ? 200 : 600) * inertial_number, 12.0, 80.0);
          scene.settling = 4;
          if (inertial_number >= collisional) scene.cd_dt_factor = collisional_dt;
          const std::string state = plain_number(inertial_number);
          scene.title = fmt::format("flow-restitution: {}, mu = {:g}, e = {:g}, I = {}", engine_name(engine), friction,
                                    restitution, state);
          runs.push_back({fmt::format("{}_mu_{:g}_e_{:g}_I_{}", engine_name(engine), friction, restitution, state),
                          engine,
                          {{"mu", friction}, {"e", restitution}, {"I", inertial_number}},
                          shear_scene(scene)});
        }
  return runs;
}

StudyReport report(const std::vector<StudyRow>& rows) {
  StudyReport report;
  for (const EngineKind engine : engines) report_engine(report, rows, engine);
  for (const double friction : {0.0, 0.4}) {
    const std::string of = friction > 0 ? "frictional" : "frictionless";
    report.figures.push_back({"mu_star_" + of, restitution_figure(rows, friction, Observable::mu_star)});
    report.figures.push_back({"Phi_" + of, restitution_figure(rows, friction, Observable::solid_fraction)});
  }
  return report;
}

}  // namespace galet::flow_restitution
