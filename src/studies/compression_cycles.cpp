// Loading and unloading of spheres at rest: without lateral strain, and what the isotropic path of the study leaves.
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "src/studies/compression_parts.hpp"
#include "src/studies/estimates.hpp"
#include "src/studies/solid_templates.hpp"
#include "src/studies/studies.hpp"

namespace galet::compression {

namespace {

constexpr double oedometric_level = 3900;  ///< under the largest axial stress
constexpr std::array cycled_states = {'A', 'C'};

/// Strain left when a cycle comes back to the stress of its start, over the largest strain on the way: values at the
/// ends of three stages.
Estimate strain_left(const std::vector<const StudyRow*>& rows, Observable strain, const std::string& start,
                     const std::string& top, const std::string& end) {
  return mean_over(rows, [&](const StudyRow& row) {
    const StageReport *first = stage_of(row, start), *most = stage_of(row, top), *last = stage_of(row, end);
    if (!first || !most || !last) return std::nan("");
    return (last->last[strain] - first->last[strain]) / (most->last[strain] - first->last[strain]);
  });
}

/// The stage at rest with the lowest kappa.
std::string top_of(const std::vector<const StudyRow*>& rows) {
  std::string top;
  if (!rows.empty())
    for (const StageReport& stage : rows[0]->run.stages)
      if (stage.name.starts_with("kappa")) top = stage.name;
  return top;
}

}  // namespace

Estimate mean_at_stage(const std::vector<const StudyRow*>& rows, const std::string& stage, Observable observable) {
  std::vector<Estimate> values;
  for (const StudyRow* row : rows)
    if (const StageReport* report = stage_of(*row, stage)) values.push_back({report->last[observable], 0});
  return weighted_mean(values);
}

void add_oedometric_runs(std::vector<StudyRun>& runs, bool quick) {
  for (const char state : cycled_states)
    for (const int seed : {1, 2, 3}) {
      SolidScene scene;
      scene.grains = quick ? 300 : 4000;
      scene.seed = seed;
      scene.title = fmt::format("compression: md, state {}, oedometric, seed {}", state, seed);
      runs.push_back({fmt::format("md_oedometric_{}_seed_{}", state, seed),
                      EngineKind::md,
                      {{"state", state}, {"oedometric", 1}, {"seed", seed}},
                      assembly_scene(scene, state) + oedometric_stages(scene, oedometric_level)});
    }
}

void report_cycles(StudyReport& report, const std::vector<StudyRow>& rows) {
  for (const char state : cycled_states) {
    const auto isotropic = rows_with(rows, EngineKind::md, {{"state", state}, {"oedometric", 0}});
    const auto oedometric = rows_with(rows, EngineKind::md, {{"state", state}, {"oedometric", 1}});
    const std::string letter(1, state);
    report.add(fmt::format("strain of {} left after an isotropic cycle, of its largest", state),
               strain_left(isotropic, Observable::eps_v, letter, top_of(isotropic), "back"), "compression.left");
    const Estimate loaded = mean_at_stage(oedometric, "loaded", Observable::z),
                   start = mean_at_stage(oedometric, letter, Observable::z),
                   left = strain_left(oedometric, Observable::eps_zz, letter, "loaded", "unloaded");
    report.add(fmt::format("z of {} under the axial stress of kappa = {:g} over 39000, - 1", state, oedometric_level),
               ratio(loaded, start) - Estimate{1, 0}, "compression.moderate",
               fmt::format("a cycle leaves {:.3f} +- {:.3f} of its axial strain", left.value, left.error));
    if (state != 'A') continue;
    report.add(
        "z* of A after an isotropic cycle, less before",
        mean_at_stage(isotropic, "back", Observable::z_star) - mean_at_stage(isotropic, letter, Observable::z_star),
        "compression.cycle_z");
  }
}

}  // namespace galet::compression
