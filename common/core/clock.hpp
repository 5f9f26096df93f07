// The two clocks of a run: wall time, and the processor time of the calling thread alone, so that simulations
// which run side by side on threads of their own don't count each other's work.
#pragma once

#include <chrono>
#include <ctime>

namespace galet {

inline double wall_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

inline double thread_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace galet
