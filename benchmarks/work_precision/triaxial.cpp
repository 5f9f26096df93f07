// Class of spheres in triaxial compression: the strength that small dense packings reach in an increment of axial
// strain.
#include <algorithm>

#include "benchmarks/work_precision/classes.hpp"
#include "benchmarks/work_precision/settings.hpp"
#include "common/measure/stress.hpp"

namespace galet::precision {

namespace {

constexpr int spheres = 100, packings = 6;

/// Spheres +-20 % in a periodic cell under stresses 1 along each axis, each held by its own component.
Scene triaxial_scene(double friction) {
  Scene scene = verify::periodic_scene(3, spheres, friction, 0.3, 1e4);
  scene.material.convention = DampingConvention::total;
  scene.grains.diameter = {SizeKind::uniform, 1, 0.2, {}, {}};
  scene.initial.solid_fraction = 0.3;
  scene.loading.kind = LoadingKind::drives;
  scene.loading.pressure = 1;
  scene.loading.drives = {
      {.component = "xx", .stress = 1.0}, {.component = "yy", .stress = 1.0}, {.component = "zz", .stress = 1.0}};
  return scene;
}

void scale_spheres(Sample<3>& sample, double factor) {
  sample.cell.box *= factor;
  for (Vec<3>& x : sample.position) x *= factor;
}

/// Compressed from a gas without friction by md, at rest, its grains about to touch.
Sample<3> dense_spheres(std::uint64_t seed) {
  verify::Report report;
  Scene scene = triaxial_scene(0);
  scene.seed = seed;
  scene.initial.speed = 0.1;
  scene.md.drag = 0.5;
  Sample<3> sample = initial_sample<3>(verify::checked(EngineKind::md, scene));
  verify::Trial<3> trial(report, EngineKind::md, scene, sample);
  trial.run_to(150);
  const Snapshot<3> state = trial.state();
  sample.cell = *state.cell;
  sample.cell.rate.setZero();
  sample.cell.strain.setZero();
  sample.position.assign(state.position.begin(), state.position.end());
  for (Vec<3>& velocity : sample.velocity) velocity.setZero();
  scale_spheres(sample, 1 + 1e-4);  // about what the pressure presses them together
  return sample;
}

/// q / P of one packing, mean over axial strains from 1 % to 2 %, its volume strain there, and the cost.
Row triaxial_packing(const Setting& setting, Sample<3> start) {
  constexpr double rate = 1e-3, rest = 10, axial = 0.02;
  constexpr int looks = 1000;
  if (setting.engine == EngineKind::md) scale_spheres(start, 1 - 0.8 / setting.kappa);
  Scene scene = triaxial_scene(0.3);
  scene.cd.max_sweeps = 20000;
  apply(setting, scene);
  Measured run(setting, scene, start);
  run.to(rest);
  const double volume = run.trial().state().cell->volume();
  scene.loading.drives[2] = {.component = "zz", .rate = -rate};
  run.trial().change(scene);
  run.reset_cost();
  double deviator = 0, dilation = 0;
  for (int look = 1; look <= looks; ++look) {
    run.to(rest + axial / rate * look / looks);
    const Mat<3> sigma = stress<3>(run.trial().state()).total();
    if (2 * look <= looks) continue;
    deviator += (2 * sigma(2, 2) / (sigma(0, 0) + sigma(1, 1)) - 1) / (looks / 2.0);
    dilation += (run.trial().state().cell->volume() / volume - 1) / (looks / 2.0);
  }
  return run.row("triaxial", axial, {{"q/P", {deviator}}, {"volume strain", {dilation}}});
}

/// Each replicate is a packing.
Row triaxial(const Setting& setting) {
  static const std::vector<Sample<3>> starts = [] {
    std::vector<Sample<3>> all;
    for (std::uint64_t seed = 1; seed <= packings; ++seed) all.push_back(dense_spheres(seed));
    return all;
  }();
  Row sum{.scene = "triaxial", .setting = setting, .quantities = {{"q/P", {}}, {"volume strain", {}}}};
  for (const Sample<3>& start : starts) {
    const Row part = triaxial_packing(setting, start);
    for (std::size_t k = 0; k < part.quantities.size(); ++k)
      sum.quantities[k].values.push_back(part.quantities[k].values[0]);
    sum.seconds += part.seconds, sum.steps += part.steps, sum.sweeps += part.sweeps, sum.missed += part.missed;
    sum.extent += part.extent;
  }
  return sum;
}

}  // namespace

SceneClass triaxial_class() {
  SceneClass made{.name = "triaxial",
                  .question = "q/P of six packings of 100 spheres at axial strains from 1 % to 2 %",
                  .truth = Truth::limit,
                  .extent = "axial strain",
                  .plan = {},
                  .run = triaxial};
  for (const double kappa : {1e2, 1e3, 1e4}) made.plan.push_back(md_setting(kappa));
  for (const double kappa : {1e3, 1e4}) made.plan.push_back(md_setting(kappa, 20));
  for (const double dt : {0.1, 0.05, 0.02}) made.plan.push_back(cd_setting(dt, 1e-2));
  for (const double dt : {0.1, 0.05, 0.02}) made.plan.push_back(cd_setting(dt, 1e-3));
  made.plan.push_back(cd_setting(0.05, 1e-4));
  made.plan.push_back(md_setting(1e5));
  return made;
}

}  // namespace galet::precision
