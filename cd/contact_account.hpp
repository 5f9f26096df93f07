// Energy that contacts take from the motion of rigid grains in one step: - sum of r . (u- + u+) / 2, exact whatever
// other forces act (M (v+ - v-) = dt F + H r, and the power of r is that of the mean velocity). Impacts, friction,
// rolling and pivoting together; the work of drives and moving planes is not in it, as u is relative to them.
// Attraction is a conservative force and not counted. Negative when a step makes energy: with one e = e_T for all
// contacts Moreau's law can't (laws/restitution.hpp), with unlike ones or e_T != e it can, which users should know.
// Cost: one pass over the contacts.
#pragma once

#include <vector>

#include "cd/problem.hpp"
#include "common/core/parallel.hpp"

namespace galet::cd {

/// `start`: velocities before the step; `end`: after it. `partial` is scratch.
template <Layout Y>
double dissipated_energy(const Problem<Y>& problem, const Iterate<Y>& start, const Iterate<Y>& end,
                         std::vector<double>& partial) {
  refill(partial, chunk_count(problem.size()), 0.0);
  parallel_chunks(problem.size(), [&](std::size_t chunk, std::size_t from, std::size_t to) {
    double sum = 0;
    for (std::size_t k = from; k < to; ++k) {
      if (end.reaction[k].isZero(0)) continue;
      const Components<Y> r = components<Y>(problem.normal[k], end.reaction[k]);
      const Components<Y> a = relative_motion(problem, start, start.gradient, k);
      const Components<Y> b = relative_motion(problem, end, end.gradient, k);
      sum += r.normal * (a.normal + b.normal);
      if constexpr (Y.friction) sum += dot(r.tangential, a.tangential) + dot(r.tangential, b.tangential);
      if constexpr (Y.rolling)
        sum += dot(r.rolling, a.rolling) + dot(r.rolling, b.rolling) + r.pivoting * (a.pivoting + b.pivoting);
    }
    partial[chunk] = sum;
  });
  double total = 0;
  for (const double part : partial) total += part;
  return -0.5 * total;
}

}  // namespace galet::cd
