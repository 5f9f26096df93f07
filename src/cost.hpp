// A guess of what a run will cost, from its size alone: time = grains * steps * (time per grain and step). The rates
// are those of one core of a 2020s desktop in a dense flow with friction; expect a factor of 2 or 3 either way. The
// rigid engine's rate follows the number of sweeps that its tolerance needs.
#pragma once

#include "common/scene/derive.hpp"
#include "common/scene/scene.hpp"

namespace galet {

struct CostEstimate {
  double dt = 0;
  long steps = 0;
  double seconds = 0;  ///< of one core, for the run proper
};

/// `derived` is that of the scene; md needs derived.md_dt.
CostEstimate estimate_cost(EngineKind kind, const Scene& scene, const Derived& derived);

}  // namespace galet
