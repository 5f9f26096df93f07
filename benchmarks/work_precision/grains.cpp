// Classes of single grains: oblique impacts, a column at rest.
#include <algorithm>
#include <cmath>

#include "benchmarks/work_precision/classes.hpp"
#include "benchmarks/work_precision/settings.hpp"

namespace galet::precision {

namespace {

// ---- oblique impacts -----------------------------------------------------------------------------------------------

constexpr int balls = 100;
constexpr double impact_time = 2, impact_friction = 0.3, restitution = 1;

double gap_of(int k) { return 0.2 + 0.6 * std::fmod(0.5 + k * 0.6180339887498949, 1.0); }  // phases spread evenly
double along_of(int k) { return 3 + 7.0 * k / (balls - 1); }  // faster ones are ahead: they never meet

/// Elastic disks that meet a plane at speed 1 across and 3 to 10 along it: they slide throughout in both engines, so
/// that the rebound of rigid grains is exact for both: across 1, along by -2 mu. (With a dashpot md's contact begins
/// with a normal force, under which it sticks at first, and its friction impulse falls short of mu (1 + e) by an amount
/// that no kappa changes: rms 0.012 in velocity at e = 0.5.)
Row impacts(const Setting& setting) {
  Scene scene = verify::free_scene(2, impact_friction, restitution, 1);
  scene.material.convention = DampingConvention::total;
  scene.md.allow_unsafe_dt = true;  // coarse steps are part of the question; the bound is for packings
  verify::add_plane(scene, {0, 0}, {0, 1});
  for (int k = 0; k < balls; ++k) verify::add_grain(scene, {2.0 * k, 0.5 + gap_of(k)}, {along_of(k), -1});
  apply(setting, scene);
  Measured run(setting, scene);
  run.to(impact_time);
  const Snapshot<2> state = run.trial().state();
  const double lost = impact_friction * (1 + restitution), rest = run.trial().time();
  double position = 0, velocity = 0;
  for (int k = 0; k < balls; ++k) {
    const double met = gap_of(k), v = along_of(k) - lost;
    const Vec<2> where(2.0 * k + along_of(k) * met + v * (rest - met), 0.5 + restitution * (rest - met));
    position += (state.position[k] - where).squaredNorm() / balls;
    // Rim speed R |w| = 2 J / m of a disk.
    velocity += ((state.velocity[k] - Vec<2>(v, restitution)).squaredNorm() +
                 std::pow(0.5 * std::abs(state.spin[k]) - 2 * lost, 2)) /
                balls;
  }
  return run.row("impact", balls, {{"position", {std::sqrt(position)}}, {"velocity", {std::sqrt(velocity)}}});
}

// ---- a column at rest
// ------------------------------------------------------------------------------------------------

constexpr int height = 30;

/// Disks one above the other that just touch, under gravity, until they rest: forces are the weights above, heights
/// those of rigid disks. md runs until its slowest mode, damped at the rate sqrt(2) zeta lambda sqrt(K) / 2 with lambda
/// the chain's least eigenvalue, is down to 1 / kappa.
Row column(const Setting& setting) {
  Scene scene = verify::free_scene(2, 0.5, 0.1, 1);
  verify::add_floor(scene);
  for (int k = 0; k < height; ++k) verify::add_grain(scene, {0, 0.5 + k});
  scene.cd.max_sweeps = 100000000;
  apply(setting, scene);
  Measured run(setting, scene);
  if (setting.engine == EngineKind::md) {
    const double zeta = std::log(10.0) / std::hypot(verify::pi, std::log(10.0));  // e = 0.1
    const double lambda = std::pow(2 * std::sin(verify::pi / (4 * height + 2)), 2);
    run.to(std::log(setting.kappa) / (std::sqrt(2.0) * zeta * lambda * std::sqrt(setting.kappa) / 2));
  } else {
    run.steps(3);
  }
  const Snapshot<2> state = run.trial().state();
  std::vector<double> found(height, 0.0);
  for (std::size_t c = 0; c < state.contacts->size(); ++c) {
    const int i = state.contacts->i[c], j = state.contacts->j[c];
    found[j >= height ? 0 : std::max(i, j)] = std::abs(state.contacts->force[c].y());
  }
  double force = 0, sunk = 0;
  for (int k = 0; k < height; ++k) {
    force = std::max(force, std::abs(found[k] - (height - k)) / height);
    sunk = std::max(sunk, std::abs(state.position[k].y() - 0.5 - k) / height);
  }
  return run.row("column", 1, {{"larger of both", {std::max(force, sunk)}}, {"force", {force}}, {"height", {sunk}}});
}

}  // namespace

SceneClass impact_class() {
  SceneClass made{.name = "impact",
                  .question = "where are 100 disks after an oblique, sliding impact (rms, d)",
                  .extent = "impact",
                  .plan = {},
                  .run = impacts};
  for (const double kappa : {1e2, 1e3, 1e4, 1e5, 1e6, 1e7})
    for (const double steps : {10.0, 50.0}) made.plan.push_back(md_setting(kappa, steps));
  for (const double dt : {1e-1, 3e-2, 1e-2, 3e-3, 1e-3, 3e-4, 1e-4}) made.plan.push_back(cd_setting(dt, 1e-8));
  return made;
}

SceneClass column_class() {
  SceneClass made{.name = "column",
                  .question = "forces (of the weight) and heights (of the column) of 30 disks at rest",
                  .extent = "column",
                  .plan = {},
                  .run = column};
  for (const double kappa : {1e3, 1e4, 1e5, 1e6, 1e7})
    for (const double steps : {20.0, 50.0}) made.plan.push_back(md_setting(kappa, steps));
  for (const double dt : {1e-1, 1e-2})
    for (const double tolerance : {1e-2, 1e-3, 1e-4, 1e-6, 1e-8}) made.plan.push_back(cd_setting(dt, tolerance));
  return made;
}

}  // namespace galet::precision
