// Flow laws of cohesive disks: md with the published law of attraction, sqrt(4 K_N F0 h), and beside it a constant
// attraction F0 with a range in both engines. Without one the bonds of rigid grains hold no energy (docs/theory.md,
// "Rigid limit"), and nothing could be compared.
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
constexpr double range = 1e-3;  ///< D0/d of the constant law
/// Of md with that law: F0/K_N, which adds to the range where bonds are torn, is a twentieth of it at eta = 50.
constexpr double ranged_stiffness = 1e6;

enum class Bonds { square_root, with_range };

constexpr std::array shown = {0.0, slight, weak, 50.0};  ///< eta in the figures

/// D0 as a parameter of runs: 0 for the published law, and without cohesion, where the two are the same.
double range_of(Bonds bonds, double eta) { return bonds == Bonds::with_range && eta > 0 ? range : 0; }

/// The bonds that an engine's laws are reported with.
Bonds bonds_of(EngineKind engine) { return engine == EngineKind::md ? Bonds::square_root : Bonds::with_range; }

std::vector<const StudyRow*> rows_at(const std::vector<StudyRow>& rows, EngineKind engine, Bonds bonds, double eta) {
  return rows_with(rows, engine, {{"eta", eta}, {"mu", 0.4}, {"D0", range_of(bonds, eta)}});
}

/// kappa h*/d in equilibrium under a force P d: the positive root of x^2 - 2 sqrt(eta) x - 1 = 0, squared.
double deflection(double eta) { return 1 + 2 * eta + 2 * std::sqrt(eta + eta * eta); }

FlowFit fit_of(const std::vector<StudyRow>& rows, EngineKind engine, double eta) {
  return fit_flow(rows_at(rows, engine, bonds_of(engine), eta), fit_from, fit_to);
}

void report_engine(StudyReport& report, const std::vector<StudyRow>& rows, EngineKind engine) {
  const std::string of = " (" + engine_name(engine) + ")";
  double strong = 0;
  for (const StudyRow* row : rows_with(rows, engine, {})) strong = std::max(strong, row->plan.parameter("eta"));
  if (strong == 0) return;
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
    const double d0 = range_of(bonds_of(engine), eta);
    return value_of(row_with(rows, engine, {{"eta", eta}, {"mu", 0.4}, {"D0", d0}, {"I", fast}}), Observable::z);
  };
  report.add(fmt::format("z at I = 0.2, eta = {:g} minus 0{}", strong, of), z(strong) - z(0), "cohesive.rises");
}

Figure law_figure(const std::vector<StudyRow>& rows, Observable observable) {
  const bool friction = observable == Observable::mu_star;
  Figure figure{friction ? "Friction law of cohesive disks" : "Dilatancy law of cohesive disks",
                "inertial number {/:Italic I}",
                friction ? "mu*" : "Phi",
                true,
                friction,
                {}};
  for (const double eta : shown)
    for (const EngineKind engine : {EngineKind::md, EngineKind::cd}) {
      const auto found = rows_at(rows, engine, bonds_of(engine), eta);
      const std::string law = engine == EngineKind::md ? "square root" : "range";
      if (!found.empty())
        figure.series.push_back(
            series_of(fmt::format("eta = {:g}, {}{}", eta, engine_name(engine), eta > 0 ? ", " + law : ""), found, "I",
                      observable));
    }
  return figure;
}

/// Both engines with the same bonds, of the constant law with a range.
Figure range_figure(const std::vector<StudyRow>& rows) {
  Figure figure{"Friction law with bonds of range 1e-3 d", "inertial number {/:Italic I}", "mu*", true, true, {}};
  for (const double eta : shown)
    for (const EngineKind engine : {EngineKind::md, EngineKind::cd}) {
      const auto found = rows_at(rows, engine, Bonds::with_range, eta);
      if (!found.empty())
        figure.series.push_back(
            series_of(fmt::format("eta = {:g}, {}", eta, engine_name(engine)), found, "I", Observable::mu_star));
    }
  return figure;
}

/// Phi at I = 0.2 against eta, by the friction of contacts.
Figure fraction_figure(const std::vector<StudyRow>& rows) {
  Figure figure{"Solid fraction at I = 0.2", "cohesion number eta", "Phi", false, false, {}};
  for (const double friction : {0.0, 0.4})
    for (const EngineKind engine : {EngineKind::md, EngineKind::cd}) {
      Series series{fmt::format("mu = {:g}, {}", friction, engine_name(engine)), {}, {}, {}, false, true};
      for (const double eta : values_of(rows, "eta")) {
        const double d0 = range_of(bonds_of(engine), eta);
        const StudyRow* row = row_with(rows, engine, {{"mu", friction}, {"eta", eta}, {"D0", d0}, {"I", fast}});
        if (!row) continue;
        series.x.push_back(eta), series.y.push_back((*row)[Observable::solid_fraction].value);
        series.y_error.push_back((*row)[Observable::solid_fraction].error);
      }
      if (!series.x.empty()) figure.series.push_back(series);
    }
  return figure;
}

StudyRun cohesive_run(EngineKind engine, Bonds bonds, bool quick, double friction, double eta, double inertial_number) {
  const double d0 = range_of(bonds, eta);
  ShearScene scene;
  scene.engine = engine;
  scene.grains = quick ? 200 : full_size_disks;
  scene.contact_steps = quick ? 0 : sparing_steps;
  scene.friction = friction;
  scene.stiffness_level = d0 > 0 ? ranged_stiffness : stiffness;
  scene.inertial_number = inertial_number;
  scene.strain = std::clamp((quick ? 200 : 400) * inertial_number, 12.0, 40.0);
  scene.settling = 3;
  if (d0 > 0)
    scene.material = fmt::format("cohesion_number = {}\ncohesion_range = {}\n", eta, range);
  else if (eta > 0)
    scene.material = fmt::format("cohesion_number = {}\ncohesion_law = \"square_root\"\n", eta);
  const std::string name = engine_name(engine) + (d0 > 0 ? "_range" : ""), number = plain_number(inertial_number);
  scene.title = fmt::format("cohesive-flow: {}{}, mu = {:g}, eta = {:g}, I = {}", engine_name(engine),
                            d0 > 0 ? ", bonds with a range" : "", friction, eta, number);
  return {fmt::format("{}_mu_{:g}_eta_{:g}_I_{}", name, friction, eta, number),
          engine,
          {{"mu", friction}, {"eta", eta}, {"D0", d0}, {"I", inertial_number}},
          shear_scene(scene)};
}

}  // namespace

std::vector<StudyRun> plan(StudySize size) {
  const bool quick = size == StudySize::quick;
  using Reals = std::vector<double>;
  const Reals states = quick ? Reals{0.05, 0.1, fast} : Reals{0.01, 0.02, 0.05, 0.1, fast};
  const auto numbers = [quick](EngineKind engine) {
    if (quick) return Reals{0, slight, weak, 50};
    // Strong bonds take rigid grains small steps: three values less.
    return engine == EngineKind::md ? Reals{0, 0.5, 1, slight, 5, weak, 20, 50, 80} : Reals{0, slight, 5, weak, 20, 50};
  };
  std::vector<StudyRun> runs;
  for (const EngineKind engine : {EngineKind::md, EngineKind::cd})
    for (const double eta : numbers(engine)) {
      for (const double inertial_number : states)
        runs.push_back(cohesive_run(engine, bonds_of(engine), quick, 0.4, eta, inertial_number));
      runs.push_back(cohesive_run(engine, bonds_of(engine), quick, 0, eta, fast));
    }
  for (const double eta : shown)
    for (const double inertial_number : quick ? states : Reals{0.02, 0.1, fast})
      if (eta > 0) runs.push_back(cohesive_run(EngineKind::md, Bonds::with_range, quick, 0.4, eta, inertial_number));
  return runs;
}

StudyReport report(const std::vector<StudyRow>& rows) {
  StudyReport report;
  for (const EngineKind engine : {EngineKind::md, EngineKind::cd}) report_engine(report, rows, engine);
  for (const double eta : values_of(rows, "eta")) {
    const StudyRow* row = row_with(rows, EngineKind::md, {{"eta", eta}, {"mu", 0.4}, {"D0", 0}, {"I", 0.1}});
    report.add(fmt::format("kappa h*/d over H(eta), eta = {:g}, I = 0.1 (md)", eta),
               (stiffness / deflection(eta)) * value_of(row, Observable::mean_overlap), "cohesive.deflection");
  }
  report.figures.push_back({"mu_star", law_figure(rows, Observable::mu_star)});
  report.figures.push_back({"Phi", law_figure(rows, Observable::solid_fraction)});
  report.figures.push_back({"mu_star_range", range_figure(rows)});
  report.figures.push_back({"Phi_eta", fraction_figure(rows)});
  report.remarks.push_back(fmt::format("lines are fitted over {:g} <= I <= {:g}", fit_from, fast));
  report.remarks.emplace_back(
      "laws of md: square-root attraction, of cd: a constant one with the range D0 = 1e-3 d; rows of md with D0 stand "
      "beside those of cd");
  return report;
}

}  // namespace galet::cohesive_flow
