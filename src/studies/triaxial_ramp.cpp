// The interval of strains of type I, where the contacts of the start carry what is added: the axial stress is raised
// slowly, because a rate of strain that is slow for rearrangements is fast for strains of 1/kappa.
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

constexpr double highest_deviator = 1.6;  ///< above the peak, 1.4: every sample breaks
constexpr double failed = 1e-3;           ///< strain that contacts alone don't give at kappa of 8400 and more
/// What the solver leaves of each contact's problem lets rigid grains creep: at 1e-4 by 2e-4 before the structure
/// breaks, at 1e-5, 1e-6 and 1e-7 by 1e-4, 9e-6 and 1e-6 (300 spheres, 160 inertial times).
constexpr double creepless_tolerance = 1e-6;

struct Ramp {
  EngineKind engine;
  double level;  ///< 0: rigid
  const char* label;
};
constexpr std::array ramps = {
    Ramp{EngineKind::md, reference_level, "md, kappa = 8400"}, Ramp{EngineKind::md, stiff_level, "md, kappa = 39000"},
    Ramp{EngineKind::cd, reference_level, "cd, elastic, kappa = 8400"}, Ramp{EngineKind::cd, 0, "cd, rigid"}};

std::vector<const StudyRow*> ramp_rows(const std::vector<StudyRow>& rows, EngineKind engine, double level) {
  return rows_with(rows, engine, {{"ramp", 1}, {"kappa", level}});
}

}  // namespace

void add_ramp_runs(std::vector<StudyRun>& runs, bool quick) {
  const double duration = quick ? 320 : 1300;
  for (const auto& [engine, level, label] : ramps)
    for (const int seed : seeds_of(quick)) {
      SolidScene scene = solid_sample(engine, level, seed, quick);
      // Ramps are slow: with all 4000 spheres they would take five times as long as the rest of the study.
      if (!quick) scene.grains = 1000;
      scene.compliance = engine == EngineKind::cd && level > 0;
      scene.samples = 400;
      scene.tolerance = creepless_tolerance;
      const std::string name =
          fmt::format("{}_ramp{}_seed_{}", engine_name(engine), level > 0 ? "_kappa_" + plain_number(level) : "", seed);
      scene.title = "triaxial: " + name;
      runs.push_back({name,
                      engine,
                      {{"ramp", 1}, {"kappa", level}, {"seed", seed}},
                      assembly_scene(scene, 'A') + ramp_stage(highest_deviator, duration),
                      true});
    }
}

void report_ramps(StudyReport& report, const std::vector<StudyRow>& rows) {
  const auto strain = [&](EngineKind engine, double level) {
    return over_seeds(ramp_rows(rows, engine, level), type_I_strain);
  };
  const auto end = [&](EngineKind engine, double level) {
    return over_seeds(ramp_rows(rows, engine, level),
                      [](const TriaxialCurve& curve) { return deviator_at(curve, failed); });
  };
  const Estimate one{1, 0}, soft = strain(EngineKind::md, reference_level), stiff = strain(EngineKind::md, stiff_level);
  const std::string at = " from q/P = 0.1 to 0.4";
  report.add("kappa strain of A" + at + ", kappa = 39000 over 8400, - 1 (md)",
             stiff_level / reference_level * ratio(stiff, soft) - one, "triaxial.type_I");
  report.add("strain of A" + at + ", elastic cd over md, kappa = 8400, - 1",
             ratio(strain(EngineKind::cd, reference_level), soft) - one, "triaxial.type_I");
  report.add("strain of A" + at + ", rigid cd over md with kappa = 8400", ratio(strain(EngineKind::cd, 0), soft),
             "triaxial.rigid");
  report.add("q/P of A at strain 1e-3, kappa = 39000 over 8400, - 1 (md)",
             ratio(end(EngineKind::md, stiff_level), end(EngineKind::md, reference_level)) - one,
             "triaxial.instability");
  report.add("q/P of A at strain 1e-3, rigid cd over md with kappa = 39000, - 1",
             ratio(end(EngineKind::cd, 0), end(EngineKind::md, stiff_level)) - one, "triaxial.instability");
}

Figure ramp_figure(const std::vector<StudyRow>& rows) {
  Figure figure{"Spheres of state A under a slowly raised deviator",
                "kappa times axial strain (rigid: kappa = 39000)",
                "q / P",
                false,
                false,
                {}};
  for (const auto& [engine, level, label] : ramps) {
    const auto found = rows_with(rows, engine, {{"ramp", 1}, {"kappa", level}, {"seed", 1}});
    if (found.empty()) continue;
    const TriaxialCurve curve = triaxial_curve(*found[0]);
    Series series{label, {}, {}, {}, true, false};
    constexpr double widest = 20;  // of the axis: beyond, strains are of type II
    for (std::size_t k = 0; k < curve.strain.size(); ++k) {
      const double x = curve.strain[k] * (level > 0 ? level : stiff_level);
      if (x > widest) break;
      series.x.push_back(x), series.y.push_back(curve.deviator[k]);
    }
    if (!series.x.empty()) figure.series.push_back(series);
  }
  return figure;
}

}  // namespace galet::triaxial
