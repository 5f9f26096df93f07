#include "common/core/parallel.hpp"

#include <algorithm>

#include <omp.h>

#include "common/core/error.hpp"

namespace galet {

namespace {
// Per calling thread, so that independent simulations may run side by side on threads of their own.
thread_local int threads_in_use = 1;
}  // namespace

int thread_count() { return threads_in_use; }

void set_thread_count(int threads) {
  require(threads >= 1, "the number of threads must be at least 1");
  threads_in_use = threads;
}

void parallel_ranges(std::size_t count, RangeBody body, std::size_t grain) {
  const std::size_t useful = std::max<std::size_t>(1, count / std::max<std::size_t>(1, grain));
  const int threads = static_cast<int>(std::min<std::size_t>(threads_in_use, useful));
  if (threads == 1) {
    if (count > 0) body(0, count);
    return;
  }
#pragma omp parallel num_threads(threads)
  {
    // The runtime may grant fewer threads than asked for: ranges are cut by what it granted.
    const std::size_t rank = omp_get_thread_num(), team = omp_get_num_threads();
    const std::size_t begin = count * rank / team, end = count * (rank + 1) / team;
    if (begin < end) body(begin, end);
  }
}

}  // namespace galet
