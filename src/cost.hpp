// A guess of what a run will cost, from its size alone: time = grains * steps * (time per grain and step). The rates
// are those of one core of a 2020s server in the studies' quick sizes; expect a factor of 2 or 3 either way. The rigid
// engine's rate follows the number of sweeps that its tolerance needs. A stage that a state of rest ends counts with
// the time that packings take to get there, not with its bound.
#pragma once

#include "common/scene/derive.hpp"
#include "common/scene/scene.hpp"

namespace galet {

struct CostEstimate {
  double dt = 0;
  long steps = 0;      ///< at most
  double seconds = 0;  ///< of one core, for the run proper
};

/// `derived` is that of the scene; md needs derived.md_dt.
CostEstimate estimate_cost(EngineKind kind, const Scene& scene, const Derived& derived);

}  // namespace galet
