#include "common/scene/loading.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace galet {

bool has_axis(LoadingKind kind) {
  return kind == LoadingKind::oedometric || kind == LoadingKind::biaxial || kind == LoadingKind::triaxial;
}

std::string axis_component(int dimension) { return dimension == 2 ? "yy" : "zz"; }

std::vector<std::string> component_names(int dimension) {
  std::vector<std::string> names;
  for (int a = 0; a < dimension; ++a)
    for (int b = 0; b < dimension; ++b) names.push_back({"xyz"[a], "xyz"[b]});
  names.emplace_back("isotropic");
  return names;
}

bool imposes_rate(const LoadingSpec& loading) {
  if (loading.kind == LoadingKind::plane_shear) return true;
  if (has_axis(loading.kind)) return loading.compression_rate.value_or(0) != 0 || loading.inertial_number;
  return std::any_of(loading.drives.begin(), loading.drives.end(),
                     [](const CellDrive& drive) { return drive.rate.value_or(0) != 0; });
}

bool has_changing_stress(const LoadingSpec& loading) {
  return loading.pressure_to || loading.axial_stress_to ||
         std::any_of(loading.drives.begin(), loading.drives.end(),
                     [](const CellDrive& drive) { return drive.stress_to.has_value(); });
}

bool holds_present_stress(const LoadingSpec& loading) {
  return loading.hold_axial ||
         std::any_of(loading.drives.begin(), loading.drives.end(), [](const CellDrive& drive) { return drive.hold; });
}

double largest_stress(const LoadingSpec& loading) {
  double largest = 0;
  const auto consider = [&largest](const std::optional<double>& stress) {
    largest = std::max(largest, std::abs(stress.value_or(0)));
  };
  for (const auto& stress : {loading.pressure, loading.pressure_to, loading.axial_stress, loading.axial_stress_to})
    consider(stress);
  for (const CellDrive& drive : loading.drives) consider(drive.stress), consider(drive.stress_to);
  return largest;
}

std::vector<double> gravity_of(const LoadingSpec& loading) {
  std::vector<double> gravity = loading.gravity;
  if (gravity.empty() || !loading.inclination) return gravity;
  const double angle = *loading.inclination * std::numbers::pi / 180, x = gravity.front(), up = gravity.back();
  gravity.front() = x * std::cos(angle) - up * std::sin(angle);
  gravity.back() = x * std::sin(angle) + up * std::cos(angle);
  return gravity;
}

std::vector<CellDrive> loading_drives(const Scene& scene, const Derived& derived) {
  const LoadingSpec& loading = scene.loading;
  const CellDrive held{.stress = loading.pressure, .stress_to = loading.pressure_to};
  std::vector<CellDrive> drives;
  const auto hold = [&](const std::string& component) {
    drives.push_back(held);
    drives.back().component = component;
  };
  if (loading.kind == LoadingKind::drives) return loading.drives;
  if (loading.kind == LoadingKind::plane_shear) {
    drives.push_back({.component = "xy", .rate = derived.shear_rate});
    if (loading.pressure && !loading.fixed_volume) hold("yy");
  }
  if (loading.kind == LoadingKind::isotropic) hold("isotropic");
  if (!has_axis(loading.kind)) return drives;
  CellDrive axis{.component = axis_component(scene.dimension),
                 .stress = loading.axial_stress,
                 .stress_to = loading.axial_stress_to,
                 .hold = loading.hold_axial};
  if (derived.compression_rate) axis.rate = -*derived.compression_rate;
  drives.push_back(axis);
  if (loading.kind != LoadingKind::oedometric)
    for (const char* lateral : {"xx", "yy"})
      if (lateral != axis.component) hold(lateral);
  return drives;
}

}  // namespace galet
