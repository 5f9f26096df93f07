#include "src/cost.hpp"

#include <cmath>

#include "common/core/error.hpp"
#include "src/schedule.hpp"

namespace galet {

namespace {

/// Seconds per grain and step of md.
double md_rate(const Layout& layout) {
  const double disks = layout.friction ? 2.0e-7 : 1.2e-7;
  return layout.dim == 2 ? disks : 3 * disks;
}

/// Seconds per grain and step of cd: the sweeps, about 60 ns per contact each, grow as the tolerance tightens.
double cd_rate(const Layout& layout, double tolerance) {
  const double sweeps = 15 * std::log10(1 / tolerance);
  const double contacts = layout.dim == 2 ? 1.5 : 2.5;
  const double one_contact = (layout.friction ? 6.0e-8 : 3.0e-8) * (layout.dim == 2 ? 1 : 1.5);
  return 1.0e-6 + sweeps * contacts * one_contact;
}

}  // namespace

CostEstimate estimate_cost(EngineKind kind, const Scene& scene, const Derived& derived) {
  const bool soft = kind == EngineKind::md;
  require(!soft || derived.md_dt, "the scene says nothing about stiffness, which md needs");
  CostEstimate cost;
  cost.dt = soft ? *derived.md_dt : derived.cd_dt;
  cost.steps = steps_for(derived.duration, cost.dt);
  const double rate = soft ? md_rate(derived.layout) : cd_rate(derived.layout, scene.cd.tolerance);
  cost.seconds = rate * derived.grains.count * static_cast<double>(cost.steps);
  return cost;
}

}  // namespace galet
