// What the state depends on that a gas of spheres comes to when it is compressed with friction: rate, restitution,
// size.
#include <array>

#include <fmt/format.h>

#include "src/engines.hpp"
#include "src/studies/compression_parts.hpp"
#include "src/studies/estimates.hpp"
#include "src/studies/solid_templates.hpp"
#include "src/studies/templates.hpp"

namespace galet::compression {

namespace {

constexpr double usual_rate = 1e-3, usual_restitution = 0.2, other_restitution = 0.9;

std::vector<const StudyRow*> states_at(const std::vector<StudyRow>& rows, EngineKind engine, double rate,
                                       double restitution, double grains) {
  return rows_with(rows, engine, {{"I", rate}, {"e", restitution}, {"N", grains}});
}

StudyRun assembly_run(EngineKind engine, double rate, double restitution, int grains, int seed) {
  SolidScene scene;
  scene.engine = engine;
  scene.grains = grains;
  scene.seed = seed;
  scene.restitution = restitution;
  scene.equilibrium = rest_of(engine);
  const std::string name = fmt::format("{}_assembly_I_{}_e_{:g}_N_{}_seed_{}", engine_name(engine), plain_number(rate),
                                       restitution, grains, seed);
  scene.title = "compression: " + name;
  return {name, engine, {{"I", rate}, {"e", restitution}, {"N", grains}, {"seed", seed}}, approach_scene(scene, rate)};
}

/// The largest of the values that rows have of a parameter, and the smallest.
std::pair<double, double> range_of(const std::vector<StudyRow>& rows, std::string_view parameter) {
  double most = 0, least = 1e300;
  for (const double value : values_of(rows, parameter)) most = std::max(most, value), least = std::min(least, value);
  return {most, least};
}

}  // namespace

void add_assembly_runs(std::vector<StudyRun>& runs, bool quick) {
  const int grains = quick ? 300 : 4000, fewer = quick ? 150 : 1000;
  for (const EngineKind engine : {EngineKind::md, EngineKind::cd})
    for (const int seed : {1, 2, 3}) {
      const auto add = [&](double rate, double restitution, int count) {
        runs.push_back(assembly_run(engine, rate, restitution, count, seed));
      };
      if (!quick) add(1e-4, usual_restitution, fewer);
      for (const double rate : {usual_rate, 1e-2, 0.1}) add(rate, usual_restitution, grains);
      add(usual_rate, other_restitution, grains);
      add(usual_rate, usual_restitution, fewer);
    }
}

void report_assembly(StudyReport& report, const std::vector<StudyRow>& rows) {
  const auto [grains, fewer] = range_of(rows, "N");
  const double slowest = range_of(rows, "I").second;
  for (const EngineKind engine : {EngineKind::md, EngineKind::cd}) {
    const auto compare = [&](const std::string& what, const std::vector<const StudyRow*>& changed,
                             const std::vector<const StudyRow*>& reference) {
      if (changed.empty() || reference.empty()) return;
      const auto effect = [&](Observable observable) {
        return ratio(mean_at_stage(changed, "rest", observable), mean_at_stage(reference, "rest", observable)) -
               Estimate{1, 0};
      };
      const std::string of = fmt::format(", assembled with {}, - 1 ({})", what, engine_name(engine));
      report.add("Phi" + of, effect(Observable::solid_fraction), "compression.assembly_Phi");
      report.add("z*" + of, effect(Observable::z_star), "compression.assembly_z_star");
    };
    const auto usual = states_at(rows, engine, usual_rate, usual_restitution, grains);
    if (slowest < usual_rate)
      compare(fmt::format("I = {:g} over {:g}, N = {:g}", usual_rate, slowest, fewer),
              states_at(rows, engine, usual_rate, usual_restitution, fewer),
              states_at(rows, engine, slowest, usual_restitution, fewer));
    else
      compare(fmt::format("I = 0.01 over {:g}", usual_rate), states_at(rows, engine, 0.01, usual_restitution, grains),
              usual);
    compare(fmt::format("e = {:g} over {:g}", other_restitution, usual_restitution),
            states_at(rows, engine, usual_rate, other_restitution, grains), usual);
    compare(fmt::format("N = {:g} over {:g}", fewer, grains),
            states_at(rows, engine, usual_rate, usual_restitution, fewer), usual);
  }
}

Figure assembly_figure(const std::vector<StudyRow>& rows) {
  Figure figure{
      "Spheres compressed from a gas", "inertial number of the approach {/:Italic I}", "Phi at rest", true, false, {}};
  const double grains = range_of(rows, "N").first;
  for (const EngineKind engine : {EngineKind::md, EngineKind::cd}) {
    Series series;
    series.label = engine == EngineKind::md ? "md, kappa = 39000" : "cd, rigid";
    for (const double rate : values_of(rows, "I")) {
      const auto found = states_at(rows, engine, rate, usual_restitution, grains);
      if (found.empty()) continue;
      const Estimate fraction = mean_at_stage(found, "rest", Observable::solid_fraction);
      series.x.push_back(rate), series.y.push_back(fraction.value), series.y_error.push_back(fraction.error);
    }
    if (!series.x.empty()) figure.series.push_back(series);
  }
  return figure;
}

}  // namespace galet::compression
