// Independent pieces of work (whole simulations, one thread each) side by side: workers take them one by one, the
// costliest first. What a piece computes does not depend on how many run beside it.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

namespace galet {

struct SideBySideOptions {
  int jobs = 1;
  /// Share of the work that is done, and the seconds that the rest will take at this pace. A few times per second.
  std::function<void(double share, double seconds_left)> progress;
  std::function<bool()> stop;
};

/// What a piece of work is handed.
struct WorkControl {
  std::function<bool()> stop;                  ///< true: give up; the caller or another piece's exception says so
  std::function<void(double share)> progress;  ///< share of this piece that is done, in [0, 1]
};

/// Calls work(k, control) for each k < costs.size(). `costs`: guesses in any unit, for the order and the progress.
/// An exception of one piece stops the others and is thrown again when all have come back.
void run_side_by_side(const SideBySideOptions& options, const std::vector<double>& costs,
                      const std::function<void(std::size_t, const WorkControl&)>& work);

}  // namespace galet
