// Class of a packing at rest whose load changes: frictionless rigid disks, whose forces are determined by statics.
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>

#include "benchmarks/work_precision/classes.hpp"
#include "benchmarks/work_precision/isostatic.hpp"
#include "benchmarks/work_precision/settings.hpp"
#include "common/measure/stress.hpp"

namespace galet::precision {

namespace {

/// rms of the values.
double rms(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value * value;
  return std::sqrt(sum / static_cast<double>(values.size()));
}

/// The load changes from (1, 1) to (1 + x, 1 - x) at once; x takes the weakest contact 30 % of its way to opening.
Row load_change(const Setting& setting) {
  static const IsostaticPacking packing = isostatic_packing();
  const double x = 0.3 * packing.largest_deviator;
  Scene scene = loaded_scene(packing.start.count(), 0);
  scene.md.drag = 1;
  scene.cd.max_sweeps = 1000000;
  apply(setting, scene);
  Sample<2> start = packing.start;
  const bool soft = setting.engine == EngineKind::md;
  // Soft disks start with about the overlap that the pressure gives them.
  if (soft) scale(start, 1 - 0.8 / setting.kappa);
  Measured run(setting, scene, start);
  const double rest = soft ? 40 : 5 * setting.dt;
  run.to(rest);
  scene.loading.drives[0].stress = 1 + x, scene.loading.drives[1].stress = 1 - x;
  run.trial().change(scene);
  run.reset_cost();
  run.to(2 * rest);

  const Snapshot<2> state = run.trial().state();
  const std::vector<double> exact = packing.forces(x);
  const double mean = std::accumulate(exact.begin(), exact.end(), 0.0) / static_cast<double>(exact.size());
  const ContactMap found = contacts_of(state);
  std::vector<double> force, branch;
  long kept = 0;
  for (std::size_t k = 0; k < exact.size(); ++k) {
    const auto at = found.find(packing.key[k]);
    const bool there = at != found.end();
    kept += there;
    force.push_back(((there ? at->second.force : 0) - exact[k]) / mean);
    if (there) branch.push_back(at->second.branch - packing.branch[k]);
  }
  const Mat<2> sigma = stress<2>(state).total();
  const auto count = static_cast<double>(exact.size());
  return run.row("packing", 1,
                 {{"forces", {rms(force)}},
                  {"branches", {rms(branch)}},
                  {"contacts lost", {(count - static_cast<double>(kept)) / count}},
                  {"contacts more", {static_cast<double>(static_cast<long>(found.size()) - kept) / count}},
                  {"stress", {std::max(std::abs(sigma(0, 0) - 1 - x), std::abs(sigma(1, 1) - 1 + x))}}});
}

}  // namespace

SceneClass packing_class() {
  SceneClass made{.name = "packing",
                  .question = "contact forces of 40 frictionless disks after a change of load (rms, of the mean force)",
                  .extent = "change of load",
                  .plan = {},
                  .run = load_change};
  for (const double kappa : {1e2, 1e3, 1e4, 1e5, 1e6}) made.plan.push_back(md_setting(kappa, 20));
  for (const double kappa : {1e2, 1e3, 1e4, 1e5, 1e6, 1e7}) made.plan.push_back(md_setting(kappa));
  for (const double dt : {0.1, 0.02})
    for (const double tolerance : {1e-2, 1e-3, 1e-4, 1e-6, 1e-8}) made.plan.push_back(cd_setting(dt, tolerance));
  return made;
}

}  // namespace galet::precision
