// Isotropic compression of equal spheres: Phi, z* and rattlers of the states A, C and D, how z* grows as kappa falls
// and what is left of it on the way back, with the states that rigid grains (cd) come to beside them.
#include <array>

#include <fmt/format.h>

#include "src/engines.hpp"
#include "src/studies/compression_parts.hpp"
#include "src/studies/estimates.hpp"
#include "src/studies/solid_templates.hpp"
#include "src/studies/studies.hpp"
#include "src/studies/templates.hpp"

namespace galet::compression {

namespace {

constexpr double last_level = 2000;
constexpr std::array states = {'A', 'C', 'D'};

Estimate at_stage(const std::vector<StudyRow>& rows, EngineKind engine, char state, const std::string& stage,
                  Observable observable) {
  return mean_at_stage(rows_with(rows, engine, {{"state", state}, {"oedometric", 0}}), stage, observable);
}

void report_state(StudyReport& report, const std::vector<StudyRow>& rows, char state) {
  const std::string letter(1, state);
  for (const EngineKind engine : {EngineKind::md, EngineKind::cd}) {
    const std::string of = fmt::format(", state {} ({})", state, engine_name(engine));
    const auto at = [&](Observable observable) { return at_stage(rows, engine, state, letter, observable); };
    report.add("Phi" + of, at(Observable::solid_fraction), "compression.Phi_" + letter);
    report.add("z*" + of, at(Observable::z_star), "compression.z_star_" + letter);
    report.add("share of rattlers" + of, at(Observable::rattler_fraction), "compression.rattlers_" + letter);
  }
  const std::string compressed = fmt::format("kappa {:g}", last_level);
  const auto grown = [&](Observable observable) {
    return at_stage(rows, EngineKind::md, state, compressed, observable);
  };
  const auto start = [&](Observable observable) { return at_stage(rows, EngineKind::md, state, letter, observable); };
  if (state == 'A') {
    // From kappa to infinity on, the chapter says.
    report.add(
        "z of A at kappa = 2000 over that of rigid grains (cd), - 1",
        ratio(grown(Observable::z), at_stage(rows, EngineKind::cd, state, letter, Observable::z)) - Estimate{1, 0},
        "compression.growth_A");
    return;
  }
  report.add(fmt::format("z of {} at kappa = 2000", state), grown(Observable::z), "compression.z_2000");
  report.add(fmt::format("share of the rattlers of {} left at kappa = 2000", state),
             ratio(grown(Observable::rattler_fraction), start(Observable::rattler_fraction)),
             "compression.rattlers_2000");
}

Figure level_figure(const std::vector<StudyRow>& rows, Observable observable, const std::string& label) {
  Figure figure{"Isotropic compression of spheres", "stiffness level kappa", label, true, false, {}};
  for (const char state : states) {
    Series series;
    series.label = fmt::format("state {}", state);
    series.line = true;
    for (const StudyRow* row : rows_with(rows, EngineKind::md, {{"state", state}, {"oedometric", 0}}))
      for (const StageReport& stage : row->run.stages) {
        const bool rest =
            stage.name == std::string(1, state) || stage.name.starts_with("kappa") || stage.name == "back";
        if (!rest || row->plan.parameter("seed") != 1) continue;
        series.x.push_back(stage.last[Observable::stiffness_level]);
        series.y.push_back(stage.last[observable]);
      }
    if (!series.x.empty()) figure.series.push_back(series);
  }
  return figure;
}

}  // namespace

std::vector<StudyRun> plan(StudySize size) {
  const bool quick = size == StudySize::quick;
  const std::vector<double> levels =
      quick ? std::vector{8400.0, last_level} : std::vector{18100.0, 8400.0, 3900.0, last_level, 1000.0};
  std::vector<StudyRun> runs;
  for (const EngineKind engine : {EngineKind::md, EngineKind::cd})
    for (const char state : states)
      for (const int seed : {1, 2, 3}) {
        SolidScene scene;
        scene.engine = engine;
        scene.grains = quick ? 300 : 4000;
        scene.seed = seed;
        scene.equilibrium = rest_of(engine);
        scene.title = fmt::format("compression: {}, state {}, seed {}", engine_name(engine), state, seed);
        std::string text = assembly_scene(scene, state);
        if (engine == EngineKind::md) text += compression_stages(scene, levels);
        runs.push_back({fmt::format("{}_{}_seed_{}", engine_name(engine), state, seed),
                        engine,
                        {{"state", state}, {"oedometric", 0}, {"seed", seed}},
                        text});
      }
  add_oedometric_runs(runs, quick);
  add_assembly_runs(runs, quick);
  return runs;
}

StudyReport report(const std::vector<StudyRow>& rows) {
  StudyReport report;
  for (const char state : states) report_state(report, rows, state);
  report_cycles(report, rows);
  report_assembly(report, rows);
  report.figures.push_back({"z_star", level_figure(rows, Observable::z_star, "z*")});
  report.figures.push_back({"rattlers", level_figure(rows, Observable::rattler_fraction, "share of rattlers")});
  report.figures.push_back({"Phi", level_figure(rows, Observable::solid_fraction, "Phi")});
  report.figures.push_back({"assembly", assembly_figure(rows)});
  report.remarks.emplace_back(
      "figures against kappa show seed 1, on the way down to the lowest kappa and back; findings are means over the "
      "seeds, "
      "with the error of their scatter");
  return report;
}

}  // namespace galet::compression
