#include "common/scene/stages.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "common/scene/loading.hpp"

namespace galet {

std::vector<Scene> stage_scenes(const Scene& scene) {
  if (scene.stages.empty()) return {scene};
  std::vector<Scene> scenes;
  for (const StageSpec& stage : scene.stages) {
    Scene one = scene;
    one.stages.clear();
    one.loading = stage.loading;
    one.loading.unit_pressure = scene.loading.pressure;
    if (!one.loading.pressure) one.loading.pressure = scene.loading.pressure;
    if (one.loading.gravity.empty()) one.loading.gravity = scene.loading.gravity;
    if (!one.loading.inclination) one.loading.inclination = scene.loading.inclination;
    if (stage.friction) one.material.friction = *stage.friction;
    if (stage.restitution) one.material.restitution = stage.restitution, one.material.damping_ratio.reset();
    static_cast<EndSpec&>(one.run) = stage;
    scenes.push_back(std::move(one));
  }
  return scenes;
}

std::string stage_name(const Scene& scene, std::size_t stage) {
  if (scene.stages.empty()) return "run";
  const std::string& name = scene.stages.at(stage).name;
  return name.empty() ? fmt::format("stage {}", stage + 1) : name;
}

std::vector<Derived> derive_stages(const Scene& scene, const GrainFacts& facts) {
  std::vector<Derived> all;
  for (const Scene& stage : stage_scenes(scene)) all.push_back(derive(stage, facts));
  Derived shared = all.front();
  for (std::size_t k = 0; k < all.size(); ++k) {
    const Derived& one = all[k];
    shared.layout.friction |= one.layout.friction;
    shared.layout.rolling |= one.layout.rolling;
    if (one.cd_dt < shared.cd_dt) {
      shared.cd_dt = one.cd_dt;
      shared.cd_dt_from = fmt::format("{}, of {}", one.cd_dt_from, stage_name(scene, k));
    }
    if (shared.md_dt) shared.md_dt = std::min(*shared.md_dt, one.md_dt.value_or(*shared.md_dt));
    if (shared.md_dt_stable)
      shared.md_dt_stable = std::min(*shared.md_dt_stable, one.md_dt_stable.value_or(*shared.md_dt_stable));
    shared.md_stiffest = std::max(shared.md_stiffest, one.md_stiffest);
    shared.md_most_neighbours = std::min(shared.md_most_neighbours, one.md_most_neighbours);
  }
  for (Derived& one : all) {
    one.layout = shared.layout;
    one.cd_dt = shared.cd_dt, one.cd_dt_from = shared.cd_dt_from;
    one.md_dt = shared.md_dt, one.md_dt_stable = shared.md_dt_stable, one.md_stiffest = shared.md_stiffest;
    one.md_most_neighbours = shared.md_most_neighbours;
  }
  return all;
}

int path_parts(const Scene& stage) { return stage.run.cycles > 0 ? 2 * stage.run.cycles : 1; }

bool path_needs_start(const Scene& stage) {
  return stage.run.cycles > 0 || has_changing_stress(stage.loading) || holds_present_stress(stage.loading);
}

template <int D>
LoadingSpec path_part(const Scene& stage, const Derived& derived, int part, const Mat<D>& stress) {
  LoadingSpec loading = stage.loading;
  if (loading.kind == LoadingKind::none) return loading;
  const bool back = part % 2 == 1;
  loading.drives = loading_drives(stage, derived);
  loading.kind = LoadingKind::drives;
  for (CellDrive& drive : loading.drives) {
    if (drive.rate && back) drive.rate = -*drive.rate;
    if (drive.hold) {
      const int a = drive.component[0] - 'x', b = drive.component[1] - 'x';
      drive.stress = drive.component == "isotropic" ? stress.trace() / D : stress(a, b);
      drive.hold = false;
    }
    if (drive.stress_to && back) std::swap(drive.stress, drive.stress_to);
  }
  return loading;
}

template LoadingSpec path_part<2>(const Scene&, const Derived&, int, const Mat<2>&);
template LoadingSpec path_part<3>(const Scene&, const Derived&, int, const Mat<3>&);

}  // namespace galet
