#include "src/cost.hpp"

#include <algorithm>
#include <cmath>

#include "common/core/error.hpp"
#include "src/schedule.hpp"

namespace galet {

namespace {

/// Seconds per grain and step of md, measured in a dense flow.
double md_rate(const Layout& layout) {
  if (layout.dim == 2) return layout.friction ? 3.5e-8 : 2.5e-8;
  return layout.friction ? 9e-8 : 6e-8;
}

/// Seconds per grain and step of cd: about 25 ns per contact and sweep (disks with friction), and sweeps in
/// proportion to the digits of the tolerance. Slow flows are better connected: their sweeps grow like I^(-1/2).
double cd_rate(const Layout& layout, double tolerance, const std::optional<double>& inertial_number) {
  const double slowness = inertial_number ? std::clamp(std::sqrt(0.1 / *inertial_number), 0.5, 5.0) : 2;
  const double sweeps = 9 * std::max(1.0, std::log10(1 / tolerance)) * slowness;
  const double contacts = layout.dim == 2 ? 1.2 : 2.5;
  const double one_contact = (layout.friction ? 2.5e-8 : 1.2e-8) * (layout.dim == 2 ? 1 : 1.5);
  return 3.0e-7 + sweeps * contacts * one_contact;
}

}  // namespace

CostEstimate estimate_cost(EngineKind kind, const Scene& scene, const Derived& derived) {
  const bool soft = kind == EngineKind::md;
  require(!soft || derived.md_dt, "the scene says nothing about stiffness, which md needs");
  CostEstimate cost;
  cost.dt = soft ? *derived.md_dt : derived.cd_dt;
  cost.steps = steps_for(derived.duration, cost.dt);
  const double rate =
      soft ? md_rate(derived.layout) : cd_rate(derived.layout, scene.cd.tolerance, derived.inertial_number);
  cost.seconds = rate * derived.grains.count * static_cast<double>(cost.steps);
  return cost;
}

}  // namespace galet
