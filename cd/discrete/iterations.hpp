// What is made of a sweep (cd/discrete/sweeps.hpp): plain iteration, momentum, conjugate directions.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "cd/discrete/monitor.hpp"

namespace galet::cd {

/// Momentum on a map: y <- r + beta (r - r_before), beta = min((t - 1) / t', cap). `growth`: start anew when the
/// squared change of a sweep grows by more than this factor; 0: when the change points against the step (for steps of a
/// convex problem). Sources: Nesterov 1983; O'Donoghue and Candes 2015.
struct Momentum {
  double cap = 0.9;
  double growth = 1.05;
};

/// A sweep that renews a frozen term now and then may rest between: so many sweeps without a change are the end.
constexpr long longest_still = 30;

/// Up to `budget` sweeps from r, which is left at the last swept impulses; true when the monitor says stop.
template <int B, class Sweep>
bool iterate(Sweep& sweep, const Momentum& momentum, long budget, std::vector<typename ScaledProblem<B>::Vector>& r,
             Monitor<B>& monitor) {
  auto before = r, start = r;  // swept impulses of the last iteration, and what this one starts from
  double change_before = 0, t = 1;
  long restarted = 0, still = 0;
  for (long k = 1; k <= budget; ++k) {
    std::swap(start, r);
    r = start;
    sweep(r);
    double change = 0, against = 0;
    for (std::size_t c = 0; c < r.size(); ++c) {
      change += (r[c] - start[c]).squaredNorm();
      against -= (r[c] - start[c]).dot(r[c] - before[c]);
    }
    if (monitor.after(r)) return true;
    still = change == 0 ? still + 1 : 0;
    if (still > longest_still) return monitor.check(r);
    if (momentum.cap <= 0) continue;
    const bool turn = momentum.growth > 0 ? change_before > 0 && change > momentum.growth * change_before : against > 0;
    change_before = change;
    const double next = 0.5 * (1 + std::sqrt(1 + 4 * t * t));
    double beta = std::min((t - 1) / next, momentum.cap);
    t = next;
    if (turn && k - restarted > 2) t = 1, beta = 0, restarted = k;
    for (std::size_t c = 0; c < r.size(); ++c) {
      const auto swept = r[c];
      r[c] += beta * (swept - before[c]);
      before[c] = swept;
    }
  }
  if (momentum.cap > 0) r = before;
  return monitor.check(r);
}

/// Conjugate directions on the change of a sweep, with beta = |g|^2 / |g_before|^2 and a new start where it would be
/// above one. Source: Silcowitz-Hansen, Niebe and Erleben 2010 (nonsmooth nonlinear conjugate gradients).
template <int B, class Sweep>
bool iterate_conjugate(Sweep& sweep, long budget, std::vector<typename ScaledProblem<B>::Vector>& r,
                       Monitor<B>& monitor) {
  auto start = r, direction = r;
  double change_before = 0;
  for (long k = 1; k <= budget; ++k) {
    start = r;
    sweep(r);
    double change = 0;
    for (std::size_t c = 0; c < r.size(); ++c) change += (r[c] - start[c]).squaredNorm();
    if (monitor.after(r)) return true;
    if (change == 0) return monitor.check(r);
    const double beta = change_before > 0 ? change / change_before : 2;
    for (std::size_t c = 0; c < r.size(); ++c) {
      const auto g = (r[c] - start[c]).eval();
      if (beta > 1) {
        direction[c] = g;
      } else {
        direction[c] *= beta;
        r[c] += direction[c];
        direction[c] += g;
      }
    }
    change_before = change;
  }
  return monitor.check(r);
}

}  // namespace galet::cd
