#include "src/schedule.hpp"

#include <algorithm>
#include <cmath>

#include "common/core/error.hpp"

namespace galet {

long Schedule::step_of(long sample) const { return std::lround(static_cast<double>(sample) * steps_per_sample); }

long Schedule::samples_until(long steps) const {
  long sample = std::max(0L, static_cast<long>(static_cast<double>(steps) / steps_per_sample) - 1);
  while (step_of(sample + 1) <= steps) ++sample;
  return sample;
}

long Schedule::step_of_frame(long frame) const { return std::lround(static_cast<double>(frame) * steps_per_frame); }

long Schedule::frame_after(long steps) const {
  long frame = std::max(0L, static_cast<long>(static_cast<double>(steps) / steps_per_frame) - 1);
  while (step_of_frame(frame) <= steps) ++frame;
  return frame;
}

void Schedule::save(Archive& archive) const {
  archive.reals["run.steps_per_sample"] = {steps_per_sample};
  archive.reals["run.steps_per_frame"] = {steps_per_frame};
  archive.integers["run.samples_per_row"] = {samples_per_row};
}

void Schedule::restore(const Archive& archive) {
  steps_per_sample = real_column(archive, "run.steps_per_sample").at(0);
  samples_per_row = static_cast<int>(integer_column(archive, "run.samples_per_row").at(0));
  // Frames may be asked for, or no longer, when a run goes on; else it keeps their interval.
  const double stored = real_column(archive, "run.steps_per_frame").at(0);
  if (steps_per_frame > 0 && stored > 0) steps_per_frame = stored;
}

long steps_for(double duration, double dt) {
  require(duration > 0 && dt > 0, "a run needs a duration and a time step above 0");
  // The slack keeps rounding in duration / dt from adding a step.
  return std::max(1L, static_cast<long>(std::ceil(duration / dt * (1 - 1e-12))));
}

Schedule make_schedule(long total_steps, int rows, long interval) {
  require(total_steps >= 1 && rows >= 1 && interval >= 1, "a schedule needs steps, rows and an interval");
  const long written = std::min<long>(rows, total_steps);
  const long per_row = std::max(1L, total_steps / (written * interval));
  return {static_cast<double>(total_steps) / static_cast<double>(written * per_row), static_cast<int>(per_row)};
}

}  // namespace galet
