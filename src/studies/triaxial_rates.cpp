// How slow triaxial compression has to be, and creep when it is stopped.
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "src/engines.hpp"
#include "src/studies/estimates.hpp"
#include "src/studies/published.hpp"
#include "src/studies/templates.hpp"
#include "src/studies/triaxial_parts.hpp"

namespace galet::triaxial {

namespace {

constexpr double usual_restitution = 0.2, other_restitution = 1;  ///< zeta = 0
constexpr double least_strain = 0.002, most_strain = 0.02;        ///< between which q/P is compared
constexpr double creep_strain = 0.002;                            ///< before creep
constexpr std::array engines = {EngineKind::md, EngineKind::cd};

/// Slower and faster than the usual rate.
std::vector<double> other_rates(bool quick) { return quick ? std::vector{1e-3, 1e-2} : std::vector{1e-4, 1e-3, 1e-2}; }

std::vector<double> creep_rates(bool quick) { return quick ? std::vector{1e-3, 5e-3} : std::vector{2e-4, 2e-3}; }

/// Axial strain of the stage of creep; NaN where it has not come to rest.
double creep_of(const StudyRow& row) {
  const StageReport *before = stage_of(row, "triaxial"), *creep = stage_of(row, "creep");
  if (!before || !creep || creep->ending != Ending::equilibrium) return std::nan("");
  return creep->last[Observable::eps_zz] - before->last[Observable::eps_zz];
}

}  // namespace

std::vector<int> seeds_of(bool quick) { return quick ? std::vector{1, 2} : std::vector{1, 2, 3}; }

double usual_rate(bool quick) { return quick ? 2e-3 : 5e-4; }

SolidScene solid_sample(EngineKind engine, double level, int seed, bool quick) {
  SolidScene scene;
  scene.engine = engine;
  scene.grains = quick ? 300 : 4000;
  scene.seed = seed;
  scene.stiffness_level = level > 0 ? level : reference_level;
  scene.restitution = usual_restitution;
  scene.equilibrium = engine == EngineKind::md && !quick ? 1e-7 : 1e-6;
  return scene;
}

Estimate over_seeds(const std::vector<const StudyRow*>& rows,
                    const std::function<double(const TriaxialCurve&)>& number) {
  return mean_over(rows, [&](const StudyRow& row) { return number(triaxial_curve(row)); });
}

void add_quasistatic_runs(std::vector<StudyRun>& runs, bool quick) {
  const auto add = [&](double rate, double restitution) {
    for (const int seed : seeds_of(quick)) {
      SolidScene scene = solid_sample(EngineKind::md, reference_level, seed, quick);
      const std::string name = fmt::format("md_A_I_{}_e_{:g}_seed_{}", plain_number(rate), restitution, seed);
      scene.title = "triaxial: " + name;
      runs.push_back({name,
                      EngineKind::md,
                      {{"I", rate}, {"e", restitution}, {"seed", seed}},
                      assembly_scene(scene, 'A') +
                          triaxial_stage(most_strain, rate, fmt::format("restitution = {}\n", restitution)),
                      true});
    }
  };
  for (const double rate : other_rates(quick)) add(rate, usual_restitution);
  add(usual_rate(quick), other_restitution);
}

void report_quasistatic(StudyReport& report, const std::vector<StudyRow>& rows) {
  const auto mean = [](const std::vector<const StudyRow*>& found) {
    return over_seeds(found,
                      [](const TriaxialCurve& curve) { return mean_deviator(curve, least_strain, most_strain); });
  };
  const Estimate usual =
      mean(rows_with(rows, EngineKind::md, {{"state", 'A'}, {"mu", 0.3}, {"kappa", reference_level}}));
  for (const double rate : values_of(rows, "I"))
    for (const double restitution : values_of(rows, "e")) {
      const auto found = rows_with(rows, EngineKind::md, {{"I", rate}, {"e", restitution}});
      if (found.empty()) continue;
      report.add(fmt::format("A: mean q/P, I = {:g}, e = {:g}, over the usual, - 1", rate, restitution),
                 ratio(mean(found), usual) - Estimate{1, 0},
                 rate <= 1e-3 || restitution != usual_restitution ? "triaxial.slow" : "triaxial.fast");
    }
}

void add_creep_runs(std::vector<StudyRun>& runs, bool quick) {
  for (const EngineKind engine : engines)
    for (const double rate : creep_rates(quick))
      for (const int seed : seeds_of(quick)) {
        SolidScene scene = solid_sample(engine, engine == EngineKind::md ? reference_level : 0, seed, quick);
        const std::string name = fmt::format("{}_creep_I_{}_seed_{}", engine_name(engine), plain_number(rate), seed);
        scene.title = "triaxial: " + name;
        runs.push_back(
            {name,
             engine,
             {{"creep_after", rate}, {"seed", seed}},
             assembly_scene(scene, 'A') + triaxial_stage(creep_strain, rate) + creep_stage(scene.equilibrium),
             true});
      }
}

void report_creep(StudyReport& report, const std::vector<StudyRow>& rows) {
  for (const EngineKind engine : engines) {
    std::vector<Estimate> strains;  // after slow compression, and after fast one
    for (const double rate : values_of(rows, "creep_after")) {
      strains.push_back(mean_over(rows_with(rows, engine, {{"creep_after", rate}}), creep_of));
      report.add(fmt::format("axial strain of creep after I = {:g}, A ({})", rate, engine_name(engine)), strains.back(),
                 "triaxial.creep");
    }
    if (strains.size() == 2)
      report.add(fmt::format("creep after slow compression less that after fast ({})", engine_name(engine)),
                 strains[0] - strains[1], "triaxial.creep_falls");
  }
}

}  // namespace galet::triaxial
