// When a run measures, in steps. The schedule is made once, from the length of the run; a checkpoint keeps it, so
// that a resumed or a lengthened run goes on measuring at the same intervals.
#pragma once

#include "common/core/archive.hpp"

namespace galet {

struct Schedule {
  double steps_per_sample = 1;  ///< >= 1
  int samples_per_row = 1;
  double steps_per_frame = 0;  ///< 0: no frames

  /// Step at whose end sample number `sample` (from 1) is taken.
  long step_of(long sample) const;
  /// Number of samples taken in the first `steps` steps.
  long samples_until(long steps) const;

  /// Step of frame number `frame` (from 0), and the first frame after `steps` steps.
  long step_of_frame(long frame) const;
  long frame_after(long steps) const;

  void save(Archive& archive) const;
  void restore(const Archive& archive);
};

/// Steps of a run of `duration`: the first whole number of steps that reaches it.
long steps_for(double duration, double dt);

/// `rows` rows (fewer when there are fewer steps), each the mean of samples that are `interval` steps apart: the
/// steps in which forces change. Rarer samples would be shot noise of the collisions.
Schedule make_schedule(long total_steps, int rows, long interval);

}  // namespace galet
