// The facade: a scene becomes a sample, its derived numbers, an engine, and a run that is measured.
//
//   Simulation<2> simulation(read_scene("scene.toml"), EngineKind::cd);
//   RunResult result = simulation.run();
//
// A scene that starts from a compressed gas has a stage before: the gas is a simulation of its own (compression.hpp),
// run first by the same engine; the run proper starts from its grains, at rest. (Tangential forces of the stage are
// not taken over: the run starts with fresh contacts.)
//
// A scene with [[stage]] entries runs them one after the other with one engine (stage_course.hpp); a scene without is
// one stage.
//
// A run can be stopped after any step and resumed from its checkpoint; state, series and averages are then the same,
// bit for bit, as those of a run that was never stopped.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/engine/engine.hpp"
#include "common/io/scene_file.hpp"
#include "common/scene/derive.hpp"
#include "common/scene/sample.hpp"
#include "common/scene/scene.hpp"
#include "src/guard.hpp"
#include "src/pace.hpp"
#include "src/run_control.hpp"
#include "src/run_result.hpp"
#include "src/schedule.hpp"
#include "src/stage_course.hpp"
#include "src/time_series.hpp"

namespace galet {

template <int D>
class Simulation {
 public:
  /// `overrides`: the changes that were made to the scene's text when it was read; checkpoints keep them.
  Simulation(const Scene& scene, EngineKind kind, std::vector<Override> overrides = {});
  /// Starts from `start` whatever the scene says about its initial state.
  Simulation(const Scene& scene, EngineKind kind, const Sample<D>& start);
  /// Goes on from a checkpoint. `scene` is the one that wrote it, with changes of [run] at most (`more`, see
  /// stored_scene).
  static Simulation resume(const Scene& scene, const Archive& archive, const std::vector<Override>& more = {});

  /// Runs to the end of the scene's duration, or until something else ends it (Ending). May be called again
  /// after an interruption. A sound engine error doesn't throw: the result says so.
  RunResult run(const RunControl& control = {});

  /// Everything that resume() needs.
  Archive checkpoint() const;

  const Scene& scene() const { return scene_; }
  const Derived& derived() const { return derived_; }
  /// What the dimensionless numbers of the measures are referred to.
  const MeasureScale& scale() const { return scale_; }
  /// Of each grain.
  const std::vector<int>& material() const { return compression_ ? compression_->start_.material : start_.material; }
  bool compressing() const { return compression_ != nullptr; }
  /// The engine of the present stage.
  Engine<D>& engine() { return compression_ ? compression_->engine() : *engine_; }
  /// The present grains in their cell; the same with all velocities and rates zero.
  Sample<D> present_sample();
  Sample<D> rest_sample();

  /// Runs only the stage before the run proper, if there is one: true when the run proper can start.
  /// Otherwise `result` says why not.
  bool prepare(const RunControl& control, RunResult& result);
  /// What is to be said about that stage: that it ended short of equilibrium.
  std::optional<std::string> compression_note() const;

 private:
  Simulation(const Scene& scene, EngineKind kind, std::vector<Override> overrides, const Archive& archive);

  void start_run(const Sample<D>& start, std::size_t stage);
  void begin_course();
  void take_over_checkpoint();
  void start_stage();
  void finish_stage(Ending ending, const RunControl& control);
  void restore(const Archive& archive);
  bool settle(const RunResult& gas, RunResult& result);
  Ending loop(const RunControl& control, Pace& pace);
  Ending run_stage(const RunControl& control, Pace& pace, long last);
  void take_steps(long count);
  std::optional<Ending> take_sample(Pace& pace);
  void keep_last_good();
  void write_frame(const RunControl& control);
  RunOrigin origin() const;
  void report(RunResult& result) const;
  void add_notes(RunResult& result) const;

  Scene scene_;
  EngineKind kind_;
  std::vector<Override> overrides_;
  Derived derived_;
  std::unique_ptr<Simulation> compression_;  ///< until the stage before is over
  std::optional<CompressionReport> compression_report_;

  Sample<D> start_;  ///< what the engine was built from
  std::unique_ptr<Engine<D>> engine_;
  StageCourse<D> course_;
  std::optional<Guard<D>> guard_;
  MeasureScale scale_;
  Schedule schedule_;  ///< of the present stage
  long samples_ = 0;   ///< in the present stage
  RowAverager row_;
  TimeSeries series_;
  ProfileAverage profile_;
  Measurement last_;
  double cpu_seconds_ = 0, wall_seconds_ = 0;
  std::optional<Archive> last_good_;
};

extern template class Simulation<2>;
extern template class Simulation<3>;

}  // namespace galet
