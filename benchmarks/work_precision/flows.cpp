// Classes without a closed answer: a cooling gas, dense flow, the strength of a packing in biaxial compression.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "benchmarks/dense_sample.hpp"
#include "benchmarks/work_precision/classes.hpp"
#include "benchmarks/work_precision/isostatic.hpp"
#include "benchmarks/work_precision/settings.hpp"
#include "common/measure/block_average.hpp"
#include "common/measure/coordination.hpp"
#include "common/measure/numbers.hpp"
#include "common/measure/stress.hpp"

namespace galet::precision {

namespace {

/// Adds the cost of `part` to `sum`.
void add_cost(const Row& part, Row& sum) {
  sum.seconds += part.seconds, sum.steps += part.steps, sum.sweeps += part.sweeps, sum.missed += part.missed;
  sum.extent += part.extent;
}

// ---- cooling gas ---------------------------------------------------------------------------------------------------

/// Kinetic energy that is left of an inelastic gas at time 5, some six collisions of a grain; each replicate is a seed.
Row gas(const Setting& setting) {
  constexpr double time = 5;
  Row sum{.scene = "gas", .setting = setting, .quantities = {{"energy left", {}}}};
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    Scene scene = verify::periodic_scene(2, 500, 0, 0.9, 1);
    scene.initial.solid_fraction = 0.2, scene.initial.speed = 1, scene.seed = seed;
    scene.cd.max_sweeps = 20000;
    apply(setting, scene);
    Measured run(setting, scene);
    const double hot = verify::kinetic_energy_of(run.trial().state());
    run.to(time);
    sum.quantities[0].values.push_back(verify::kinetic_energy_of(run.trial().state()) / hot);
    add_cost(run.row("", time, {}), sum);
  }
  return sum;
}

// ---- dense flow
// ------------------------------------------------------------------------------------------------------

/// Plane shear of 300 disks (+-20 %, mu = 0.4, e = 0.1) under sigma_yy = 1: means over the strain after the settling,
/// errors by blocking.
Row flow(const Setting& setting, double inertial_number, const std::string& name) {
  static const Sample<2> start = bench::dense_sample<2>(300, 0.4);
  const double settle = inertial_number > 0.05 ? 4 : 2, strain = inertial_number > 0.05 ? 40 : 8, look = 0.002;
  Scene scene = bench::dense_scene(2, start.count(), 0.4);
  scene.material.restitution = 0.1;
  scene.material.tangential_stiffness_ratio = 0.5;
  scene.loading.kind = LoadingKind::plane_shear;
  scene.loading.inertial_number = inertial_number;
  apply(setting, scene);
  Measured run(setting, scene, start);
  run.to(settle / inertial_number);
  run.reset_cost();
  std::vector<double> friction, fraction, z, normal;
  const long every = std::max(1L, std::lround(look / inertial_number / run.trial().dt()));
  while (run.trial().time() < (settle + strain) / inertial_number) {
    run.steps(every);
    const Snapshot<2> state = run.trial().state();
    const Mat<2> sigma = stress<2>(state).total();
    friction.push_back(-0.5 * (sigma(0, 1) + sigma(1, 0)));
    normal.push_back(sigma(0, 0));
    fraction.push_back(solid_fraction<2>(state));
    z.push_back(coordination<2>(state, true).z);
  }
  const auto mean = [](const std::string& what, const std::vector<double>& series) {
    const Estimate estimate = block_average(series);
    return Quantity{what, {estimate.value}, estimate.error};
  };
  // sigma_yy is held at 1.
  return run.row(name, strain,
                 {mean("mu*", friction), mean("Phi", fraction), mean("z", z), mean("sigma_xx/sigma_yy", normal)});
}

// ---- biaxial compression -----------------------------------------------------------------------------------------

/// q / P of dense packings (made without friction, sheared with mu = 0.3), mean over axial strains from 1 % to 2 %, and
/// the volume strain there; each replicate is a packing.
Row biaxial(const Setting& setting) {
  constexpr double rate = 1e-3, rest = 10, axial = 0.02;
  static const std::vector<Sample<2>> packings = [] {
    std::vector<Sample<2>> all;
    for (std::uint64_t seed = 1; seed <= 6; ++seed) all.push_back(soft_packing(100, seed));
    return all;
  }();
  Row sum{.scene = "biaxial", .setting = setting, .quantities = {{"q/P", {}}, {"volume strain", {}}}};
  for (Sample<2> start : packings) {
    if (setting.engine == EngineKind::md) scale(start, 1 - 0.8 / setting.kappa);
    Scene scene = loaded_scene(start.count(), 0.3);
    scene.cd.max_sweeps = 20000;
    apply(setting, scene);
    Measured run(setting, scene, start);
    run.to(rest);
    const double volume = run.trial().state().cell->volume();
    scene.loading.drives[1] = {.component = "yy", .rate = -rate};
    run.trial().change(scene);
    run.reset_cost();
    double deviator = 0, dilation = 0;
    constexpr int looks = 1000;
    for (int look = 1; look <= looks; ++look) {
      run.to(rest + axial / rate * look / looks);
      const Mat<2> sigma = stress<2>(run.trial().state()).total();
      if (2 * look <= looks) continue;
      deviator += (sigma(1, 1) / sigma(0, 0) - 1) / (looks / 2.0);
      dilation += (run.trial().state().cell->volume() / volume - 1) / (looks / 2.0);
    }
    sum.quantities[0].values.push_back(deviator);
    sum.quantities[1].values.push_back(dilation);
    add_cost(run.row("", axial, {}), sum);
  }
  return sum;
}

}  // namespace

SceneClass gas_class() {
  SceneClass made{.name = "gas",
                  .question = "kinetic energy left of a gas of 500 disks, e = 0.9, after six collisions each",
                  .truth = Truth::limit,
                  .power = 0.5,  // a collision lasts tau_c, as kappa^-1/2, of the time between two
                  .extent = "time",
                  .plan = {},
                  .run = gas};
  for (const double kappa : {3e2, 1e3, 1e4, 1e5, 1e6}) made.plan.push_back(md_setting(kappa, 20));
  for (const double kappa : {1e3, 1e5}) made.plan.push_back(md_setting(kappa));
  for (const double dt : {0.1, 0.05, 0.02, 0.01, 0.003}) made.plan.push_back(cd_setting(dt, 1e-4));
  return made;
}

SceneClass flow_class(double inertial_number) {
  const std::string name = fmt::format("flow_{}", inertial_number);
  SceneClass made{
      .name = name,
      .question = fmt::format("mu* of 300 disks in plane shear at I = {}", inertial_number),
      .truth = Truth::limit,
      .extent = "strain",
      .plan = {},
      .run = [inertial_number, name](const Setting& setting) { return flow(setting, inertial_number, name); }};
  for (const double kappa : {1e2, 1e3, 1e4}) made.plan.push_back(md_setting(kappa));
  made.plan.push_back(md_setting(1e3, 20));
  for (const double dt : {0.1, 0.05, 0.02}) made.plan.push_back(cd_setting(dt, 1e-2));
  for (const double dt : {0.05, 0.02}) made.plan.push_back(cd_setting(dt, 1e-3));
  if (inertial_number > 0.05) {  // what is too dear where the flow is slow
    made.plan.push_back(cd_setting(0.01, 1e-3));
    for (const double dt : {0.02, 0.01}) made.plan.push_back(cd_setting(dt, 1e-4));
    made.plan.push_back(md_setting(1e5));
  }
  return made;
}

SceneClass biaxial_class() {
  SceneClass made{.name = "biaxial",
                  .question = "q/P of six packings of 100 disks at axial strains from 1 % to 2 %",
                  .truth = Truth::limit,
                  .extent = "axial strain",
                  .plan = {},
                  .run = biaxial};
  for (const double kappa : {1e2, 1e3, 1e4, 1e5}) made.plan.push_back(md_setting(kappa));
  for (const double kappa : {1e3, 1e4}) made.plan.push_back(md_setting(kappa, 20));
  for (const double dt : {0.1, 0.05, 0.02}) made.plan.push_back(cd_setting(dt, 1e-2));
  for (const double dt : {0.1, 0.05, 0.02, 0.01}) made.plan.push_back(cd_setting(dt, 1e-3));
  for (const double dt : {0.05, 0.02}) made.plan.push_back(cd_setting(dt, 1e-4));
  return made;
}

std::vector<SceneClass> all_classes() {
  return {impact_class(),  column_class(),   packing_class(), gas_class(),
          biaxial_class(), triaxial_class(), flow_class(0.1), flow_class(0.01)};
}

}  // namespace galet::precision
