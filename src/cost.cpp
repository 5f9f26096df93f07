#include "src/cost.hpp"

#include <algorithm>
#include <cmath>

#include "common/core/error.hpp"
#include "src/schedule.hpp"

namespace galet {

namespace {

/// Seconds per grain and step of md, measured in dense flows and packings.
double md_rate(const Layout& layout) {
  if (layout.dim == 2) return layout.friction ? 1.8e-8 : 1.4e-8;
  return layout.friction ? 4.5e-8 : 2.8e-8;
}

/// Seconds per grain and step of cd: what a step costs without its sweeps, and sweeps over the contacts. A digit of the
/// tolerance takes three times the sweeps; slow flows are better connected and take a little more.
double cd_rate(const Layout& layout, double tolerance, const std::optional<double>& inertial_number) {
  const double slowness = inertial_number ? std::pow(0.1 / std::clamp(*inertial_number, 1e-3, 1.0), 0.12) : 1;
  const double sweeps = 10 * std::pow(3, std::max(0.0, std::log10(1e-3 / tolerance))) * slowness;
  const double contacts = layout.dim == 2 ? 1.2 : 2.5;
  const double one_contact = (layout.friction ? 1.1e-8 : 0.6e-8) * (layout.dim == 2 ? 1 : 1.5);
  return (layout.dim == 2 ? 2.4e-7 : 6e-7) + sweeps * contacts * one_contact;
}

/// Inertial times that packings take to come to rest: 40 to 60 from a gas, less from another packing.
constexpr double rest_time = 50;

/// The duration, with a guess in place of its bound where a state of rest ends a stage.
double likely_duration(const Scene& scene, const Derived& derived) {
  double duration = derived.duration;
  const auto shorten = [&](const EndSpec& end) {
    if (!(end.equilibrium || end.unbalanced) || !end.duration || !derived.inertial_time) return;
    duration -= std::max(0.0, *end.duration - rest_time * *derived.inertial_time);
  };
  if (scene.stages.empty()) shorten(scene.run);
  for (const StageSpec& stage : scene.stages) shorten(stage);
  return duration;
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
  cost.seconds = rate * derived.grains.count * likely_duration(scene, derived) / cost.dt;
  return cost;
}

}  // namespace galet
