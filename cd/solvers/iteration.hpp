// What is made of sweeps: momentum, and conjugate directions where momentum stalls. Nothing here knows a contact.
//
//   momentum    y = r + beta (r - r_before), r' = S(y);  beta = min((t - 1) / t', cap), t' = (1 + sqrt(1 + 4 t^2)) / 2,
//               t = 1 again when |r' - y| grows by more than 5 % from one sweep to the next
//   conjugate   y' = S(y) + beta p,  p' = y' - y;  beta = |S(y) - y|^2 / |that of the sweep before|^2, 0 where above
//   one
//
// S: a sweep, whose fixed points are the solutions; |.| in units of energy. The problem is no convex one, and momentum
// ends up wandering about a solution, in a region that is smaller for smaller beta: where 500 sweeps don't bring the
// best residual below 0.7 of what it was, the cap falls, by 0.945 down to 0.8. Where that too has stalled for 3000
// sweeps, conjugate directions take turns with momentum, each from the best impulses. What is handed back is the best
// that was checked. (Measured on piles of spheres, benchmarks/cd_piles.cpp: conjugate directions need 3 to 5 times the
// sweeps of momentum to a residual of 1e-4 and 2e-5, so they come last.) Sources: Nesterov 1983; O'Donoghue and Candes
// 2015 (restart); Silcowitz-Hansen, Niebe and Erleben 2010 (conjugate directions).
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "cd/residual.hpp"
#include "cd/solvers/report.hpp"

namespace galet::cd {

/// `Sweeps`: PlainSweeps (cd/solvers/plain_sweeps.hpp) or the sweeps of any problem (cd/solvers/nsgs.hpp).
template <class Sweeps>
class Iteration {
 public:
  Iteration(Sweeps& sweeps, const SolverOptions& options)
      : sweeps_(sweeps), options_(options), cap_(options.momentum) {}

  SolveReport run() {
    begin(options_.momentum > 0 ? SolverMethod::momentum : SolverMethod::plain);
    int next_check = 1, next_watch = first_watch;
    for (int count = 1;; ++count) {
      const ResidualParts change =
          report_.method == SolverMethod::conjugate ? sweeps_.sweep_along(beta_) : sweeps_.sweep(beta_);
      report_.sweeps = count;
      if (count == 1) first_ = change;
      if ((count & (count - 1)) == 0) earlier_ = std::exchange(at_power_, change.impulse);
      impulse_ = change.impulse;
      const bool last = count >= options_.max_sweeps;
      // Testing the change of the sweep first, which costs nothing, saves most residual passes.
      // (Measured: the residual is 0.3 to 0.5 of the relative change.)
      const bool promising = change.map <= 4 * options_.tolerance * options_.tolerance * change.impulse;
      const bool still = change.map <= least_change * change.impulse;
      if (last || still || (promising && count >= next_check) || count >= next_watch) {
        if (check()) return report_;
        if (last || still) return give_up(last ? StopReason::max_iterations : StopReason::stalled);
        next_check = count + 1 + count / 16;
        // A wandering residual is caught low only by looking often.
        next_watch = std::max(first_watch, std::min(next_check, count + 16));
        if (count - begun_ >= patience_) judge(count);
      }
      prepare(change.map);
    }
  }

 private:
  static constexpr int first_watch = 64, short_patience = 500, long_patience = 3000;
  static constexpr double progress = 0.7, cap_factor = 0.945, least_cap = 0.8;
  /// Squared relative change below which nothing but the last digits moves.
  static constexpr double least_change = 1e-31;
  static constexpr double growth = 1.1025;  // of the square: 5 %

  void begin(SolverMethod method) {
    report_.method = method;
    beta_ = 0, momentum_ = 1, since_restart_ = 0, change_before_ = 0;
  }

  /// Whether the present impulses are good enough; keeps the best.
  bool check() {
    present_ = sweeps_.residual();
    report_.residual = present_;
    report_.stop = unbounded() ? StopReason::unbounded : StopReason::converged;
    if (present_ <= options_.tolerance) return true;
    if (present_ < best_ && report_.sweeps >= first_watch) {
      sweeps_.keep();
      best_ = present_;
    }
    return false;
  }

  /// Where there is no solution (or one very far off) impulses grow without end, so that any misfit becomes small
  /// relative to them: here it is still half of what the first sweep changed, and the impulses are a thousand times
  /// those after it. (Large mass ratios make them grow by less where there is a solution. Found at tolerances below
  /// 1e-3, from a cold start.)
  bool unbounded() const {
    return present_ * present_ * impulse_ > 0.25 * first_.map && impulse_ > 1e6 * first_.impulse &&
           first_.impulse > 0 && impulse_ > 1.5 * earlier_;
  }

  SolveReport give_up(StopReason reason) {
    report_.stop = unbounded() ? StopReason::unbounded : reason;
    if (best_ < present_) {
      sweeps_.return_to_kept();
      report_.residual = best_;
    }
    return report_;
  }

  /// Smaller steps, and then the other method, go on where this one stalls.
  void judge(int count) {
    if (report_.method != SolverMethod::plain && best_ > progress * best_at_beginning_) {
      if (report_.method == SolverMethod::momentum && cap_ > least_cap) {
        cap_ = std::max(least_cap, cap_factor * cap_);
        patience_ = cap_ > least_cap ? short_patience : long_patience;
      } else {
        if (best_ < present_)
          sweeps_.return_to_kept();
        else
          sweeps_.restart();
        begin(report_.method == SolverMethod::conjugate ? SolverMethod::momentum : SolverMethod::conjugate);
        patience_ = long_patience;
      }
    }
    begun_ = count;
    best_at_beginning_ = best_;
  }

  /// What the next sweep starts from.
  void prepare(double change) {
    const double ratio = change_before_ > 0 ? change / change_before_ : std::numeric_limits<double>::infinity();
    if (report_.method == SolverMethod::momentum) {
      const double next = 0.5 * (1 + std::sqrt(1 + 4 * momentum_ * momentum_));
      beta_ = std::min((momentum_ - 1) / next, cap_);
      momentum_ = next;
      ++since_restart_;
      if (change_before_ > 0 && ratio > growth && since_restart_ > 2) momentum_ = 1, since_restart_ = 0, beta_ = 0;
    } else if (report_.method == SolverMethod::conjugate) {
      beta_ = ratio <= 1 ? ratio : 0;
    }
    change_before_ = change;
  }

  Sweeps& sweeps_;
  const SolverOptions& options_;
  SolveReport report_;
  ResidualParts first_;                ///< of the first sweep
  double impulse_ = 0;                 ///< of the last
  double at_power_ = 0, earlier_ = 0;  ///< of the last sweep that was a power of two, and of the one before
  double cap_, beta_ = 0, momentum_ = 1, change_before_ = 0;
  int since_restart_ = 0, begun_ = 0, patience_ = short_patience;
  double present_ = 0, best_ = std::numeric_limits<double>::infinity(),
         best_at_beginning_ = std::numeric_limits<double>::infinity();
};

}  // namespace galet::cd
