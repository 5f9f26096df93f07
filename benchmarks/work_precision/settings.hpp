// What the classes of the work-precision benchmark share: a setting put into a scene, and a timed engine on it.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "benchmarks/work_precision/rows.hpp"
#include "common/core/clock.hpp"
#include "src/verify/trial.hpp"

namespace galet::precision {

inline void apply(const Setting& setting, Scene& scene) {
  scene.engine = setting.engine;
  if (setting.engine == EngineKind::md) {
    scene.material.stiffness_level.reset();
    scene.material.normal_stiffness = setting.kappa;
    scene.md.steps_per_contact = setting.steps_per_contact;
  } else {
    scene.cd.dt = setting.dt;
    scene.cd.tolerance = setting.tolerance;
  }
}

/// An engine on a scene of disks or spheres; only the steps are timed.
template <int D = 2>
class Measured {
 public:
  Measured(const Setting& setting, const Scene& scene)
      : setting_(setting), trial_(std::make_unique<verify::Trial<D>>(report_, setting.engine, scene)) {}
  Measured(const Setting& setting, const Scene& scene, const Sample<D>& start)
      : setting_(setting), trial_(std::make_unique<verify::Trial<D>>(report_, setting.engine, scene, start)) {}

  verify::Trial<D>& trial() { return *trial_; }
  void steps(long count) {
    const double before = thread_seconds();
    trial_->advance(count);
    seconds_ += thread_seconds() - before;
  }
  void to(double time) { steps(std::max(1L, std::lround(time / trial_->dt()) - trial_->engine().steps())); }
  /// Forgets what was spent so far.
  void reset_cost() {
    seconds_ = 0;
    before_ = trial_->engine().steps();
    summary_ = trial_->engine().solver_summary();
  }
  Row row(const std::string& scene, double extent, std::vector<Quantity> quantities) {
    const SolverSummary now = trial_->engine().solver_summary();
    return {scene,
            setting_,
            seconds_,
            trial_->engine().steps() - before_,
            now.sweeps - summary_.sweeps,
            now.missed - summary_.missed,
            extent,
            std::move(quantities)};
  }

 private:
  Setting setting_;
  verify::Report report_;
  std::unique_ptr<verify::Trial<D>> trial_;
  double seconds_ = 0;
  long before_ = 0;
  SolverSummary summary_;
};

}  // namespace galet::precision
