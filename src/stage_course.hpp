// The course of a run through its stages: which one it is in, where that one began and ends, the part of its path that
// the engine follows, and how the stages before have ended. Everything here is part of a checkpoint.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/engine/engine.hpp"
#include "common/scene/derive.hpp"
#include "common/scene/scene.hpp"
#include "src/equilibrium.hpp"
#include "src/run_result.hpp"

namespace galet {

template <int D>
class StageCourse {
 public:
  StageCourse() = default;
  /// Before the stage `present` of the scene: begin() or restore() follows.
  StageCourse(const Scene& scene, const GrainFacts& facts, std::size_t present);

  /// The present stage as a scene, and what follows from it.
  const Scene& scene() const { return scenes_[present_]; }
  const Derived& derived() const { return derived_[present_]; }
  const std::string& name() const { return names_[present_]; }
  bool is_last() const { return present_ + 1 == scenes_.size(); }

  /// Starts the present stage at the engine's state.
  void begin(Engine<D>& engine);
  /// Goes on to the next stage: the engine gets its loading.
  void next(Engine<D>& engine);

  long first_step() const { return first_step_; }
  long last_step() const { return first_step_ + steps_; }
  /// Of the run, if every stage lasts as long as it may.
  long total_steps() const;

  /// The step at which the engine must be told of the next part of the path; that of the end when there is none.
  long next_turn() const;
  /// Tells it, when it is there.
  void turn(Engine<D>& engine);

  /// Looks at a sample, the latest of those that are `interval` apart: whether a condition of the stage ends it.
  std::optional<Ending> look(const Measurement& sample, const Snapshot<D>& snapshot, double interval);
  /// The present stage has ended; a report of it is kept.
  void end(Ending ending, const Measurement& last, const Engine<D>& engine);
  bool ended() const { return ended_; }
  const std::vector<StageReport>& reports() const { return reports_; }
  StageReport report(Ending ending, const Measurement& last, const Engine<D>& engine) const;

  /// The test that the stage asks for, if it asks for one.
  const std::optional<EquilibriumTest<D>>& equilibrium() const { return equilibrium_; }

  void save(Archive& archive) const;
  void restore(const Archive& archive);
  /// The stage that the checkpoint is in.
  static std::size_t stage_in(const Archive& archive);

 private:
  void tell(Engine<D>& engine) const;
  void prepare_test();
  bool passed(const Snapshot<D>& snapshot, double interval);

  std::vector<Scene> scenes_;
  std::vector<Derived> derived_;
  std::vector<std::string> names_;
  std::vector<long> steps_of_;  ///< at most
  EngineKind kind_ = EngineKind::md;

  std::size_t present_ = 0;
  long first_step_ = 0, steps_ = 0;
  int part_ = 0;
  bool ended_ = false;
  long settled_ = 0;                ///< of the latest samples, how many in a row showed equilibrium
  Mat<D> stress_ = Mat<D>::Zero();  ///< at the start of the stage
  Mat<D> strain_ = Mat<D>::Zero();  ///< at the start of the stage
  double mean_ = 0;                 ///< until_stress: running mean of the component
  std::optional<EquilibriumTest<D>> equilibrium_;
  std::vector<StageReport> reports_;
};

extern template class StageCourse<2>;
extern template class StageCourse<3>;

}  // namespace galet
