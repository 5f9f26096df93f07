// The pace of one call of run(): how many steps to take at a time so that the run can listen, speak and save a few
// times per second. It looks at the clock and changes nothing of the state.
#pragma once

#include "common/core/clock.hpp"
#include "src/run_control.hpp"

namespace galet {

class Pace {
 public:
  Pace(const RunControl& control, long step);

  /// Progress counts from now on the steps from `first` to `last`, under that name.
  void start_stage(std::string_view name, long first, long last);

  /// Steps that take about a fifth of a second.
  long bite() const;
  /// To be called when `step` is reached: measures the pace and reports progress when it is time to.
  void reached(long step);
  bool checkpoint_due();
  /// At most once per second, and the first time.
  bool copy_due();

 private:
  const RunControl& control_;
  std::string_view name_;
  long first_step_, step_;
  long stage_first_ = 0, stage_last_ = 0;
  double start_ = wall_seconds();
  double reported_ = 0, saved_ = start_, copied_ = 0;
};

}  // namespace galet
