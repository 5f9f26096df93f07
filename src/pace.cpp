#include "src/pace.hpp"

#include <algorithm>

namespace galet {

namespace {
constexpr double bite_seconds = 0.2, report_seconds = 0.2, copy_seconds = 1;
}

Pace::Pace(const RunControl& control, long step) : control_(control), first_step_(step), step_(step) {}

void Pace::start_stage(std::string_view name, long first, long last) {
  name_ = name;
  stage_first_ = first, stage_last_ = last;
}

long Pace::bite() const {
  const double elapsed = wall_seconds() - start_;
  if (step_ == first_step_ || elapsed <= 0) return 1;
  return std::max(1L, static_cast<long>(bite_seconds * static_cast<double>(step_ - first_step_) / elapsed));
}

void Pace::reached(long step) {
  step_ = step;
  const double now = wall_seconds();
  if (!control_.progress || now - reported_ < report_seconds) return;
  reported_ = now;
  Progress progress{name_, step - stage_first_, stage_last_ - stage_first_, 0, 0};
  if (now > start_) progress.steps_per_second = static_cast<double>(step - first_step_) / (now - start_);
  if (progress.steps_per_second > 0)
    progress.seconds_left = static_cast<double>(stage_last_ - step) / progress.steps_per_second;
  control_.progress(progress);
}

bool Pace::checkpoint_due() {
  if (!control_.checkpoint || wall_seconds() - saved_ < control_.checkpoint_every) return false;
  saved_ = wall_seconds();
  return true;
}

bool Pace::copy_due() {
  if (!control_.keep_last_good || wall_seconds() - copied_ < copy_seconds) return false;
  copied_ = wall_seconds();
  return true;
}

}  // namespace galet
