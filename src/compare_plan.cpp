// What `compare` runs: the rows of the sweep, and the shortened sweep.
#include <algorithm>

#include "common/core/error.hpp"
#include "src/compare.hpp"

namespace galet {

namespace {

/// The values of a sweep; an empty list stands for the scene's own value, which needs no change.
std::vector<std::optional<double>> values_or_own(const std::vector<double>& values) {
  if (values.empty()) return {std::nullopt};
  return {values.begin(), values.end()};
}

bool has_stiffness(const Scene& scene) {
  const MaterialSpec& material = scene.material;
  return material.stiffness_level || material.normal_stiffness || material.young_modulus ||
         !scene.compare.stiffness_levels.empty();
}

Scene in_state(const Scene& scene, std::optional<double> inertial_number) {
  Scene state = scene;
  state.output = OutputSpec{};  // rows are compared by what every run measures
  if (inertial_number) {
    state.loading.inertial_number = inertial_number;
    state.loading.shear_rate.reset();
  }
  return state;
}

PlannedRow md_row(const Scene& state, std::optional<double> stiffness_level) {
  PlannedRow row;
  row.engine = EngineKind::md;
  row.scene = state;
  row.scene.engine = EngineKind::md;
  if (stiffness_level) {
    row.scene.material.stiffness_level = stiffness_level;
    row.scene.material.normal_stiffness.reset();
    row.scene.material.young_modulus.reset();
    // A fixed md.dt would be unsafe for one level and wasteful for another: each level gets its own step.
    row.scene.md.dt.reset();
  }
  row.stiffness_level = row.scene.material.stiffness_level;
  return row;
}

PlannedRow cd_row(const Scene& state, std::optional<double> dt_factor, std::optional<double> tolerance) {
  PlannedRow row;
  row.engine = EngineKind::cd;
  row.scene = state;
  row.scene.engine = EngineKind::cd;
  if (dt_factor) {
    row.scene.cd.dt_factor = *dt_factor;
    row.scene.cd.dt.reset();
  }
  if (tolerance) row.scene.cd.tolerance = *tolerance;
  if (!row.scene.cd.dt) row.dt_factor = row.scene.cd.dt_factor;
  row.tolerance = row.scene.cd.tolerance;
  return row;
}

/// Marks, in the first state, the row nearest to the rigid limit of each engine.
void mark_references(std::vector<PlannedRow>& rows) {
  PlannedRow* stiffest = nullptr;
  PlannedRow* finest = nullptr;
  for (PlannedRow& row : rows) {
    if (row.inertial_number != rows.front().inertial_number) continue;
    if (row.engine == EngineKind::md) {
      if (!stiffest || row.stiffness_level > stiffest->stiffness_level) stiffest = &row;
    } else {
      const auto fineness = [](const PlannedRow& r) { return std::pair(r.dt_factor, r.tolerance); };
      if (!finest || fineness(row) < fineness(*finest)) finest = &row;
    }
  }
  if (stiffest) stiffest->reference = true;
  if (finest) finest->reference = true;
}

}  // namespace

std::vector<PlannedRow> compare_plan(const Scene& scene) {
  std::vector<PlannedRow> rows;
  for (const auto& inertial_number : values_or_own(scene.compare.inertial_numbers)) {
    const Scene state = in_state(scene, inertial_number);
    const auto label = state.loading.inertial_number;
    if (has_stiffness(scene))
      for (const auto& level : values_or_own(scene.compare.stiffness_levels)) {
        rows.push_back(md_row(state, level));
        rows.back().inertial_number = label;
      }
    for (const auto& dt_factor : values_or_own(scene.compare.cd_dt_factors))
      for (const auto& tolerance : values_or_own(scene.compare.cd_tolerances)) {
        rows.push_back(cd_row(state, dt_factor, tolerance));
        rows.back().inertial_number = label;
      }
  }
  mark_references(rows);
  return rows;
}

Scene shortened(const Scene& scene) {
  Scene brief = scene;
  const bool given = scene.initial.kind == InitialKind::listed || scene.initial.kind == InitialKind::packing ||
                     scene.initial.kind == InitialKind::checkpoint;
  if (!given) brief.grains.count = std::min(scene.grains.count, 400);
  if (scene.loading.kind == LoadingKind::plane_shear) {
    if (scene.loading.pressure) brief.compare.inertial_numbers = {0.1};
    brief.run.strain = 30;
    brief.run.duration.reset();
  }
  if (scene.loading.pressure && has_stiffness(scene)) brief.compare.stiffness_levels = {1e3, 1e4};
  brief.compare.cd_dt_factors = {0.02, 0.01};
  brief.compare.cd_tolerances = {1e-3};
  return brief;
}

}  // namespace galet
