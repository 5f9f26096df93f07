// Watches the iterates of the solvers of one discrete problem: keeps the best, the history and the clock, and says when
// to stop. Errors are checked at iterations that grow geometrically apart; the checks' time is not counted.
#pragma once

#include <cmath>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "cd/discrete/error.hpp"
#include "cd/discrete/solve.hpp"
#include "common/core/clock.hpp"

namespace galet::cd {

template <int B>
class Monitor {
 public:
  using Vector = typename ScaledProblem<B>::Vector;

  Monitor(const ScaledProblem<B>& problem, const DiscreteOptions& options, std::vector<Vector> start)
      : problem_(problem), options_(options), started_(thread_seconds()), best_(std::move(start)) {
    solver_ = best_solver_ = "start";
    best_error_ = discrete_error(problem_, std::span<const Vector>(best_));
    note(best_error_);
  }

  /// A solver begins.
  void begin(std::string solver) {
    solver_ = std::move(solver);
    phase_iterations_ = 0;
    next_check_ = 1;
  }

  /// Counts an iteration; true when the solver is to stop: the error is reached or the time is over. `dear`: the
  /// iteration costs far more than a check, which is then made after each.
  bool after(const std::vector<Vector>& r, bool dear = false) {
    ++iterations_;
    if (++phase_iterations_ < next_check_ && !dear) return false;
    next_check_ = std::max(next_check_ + 1, static_cast<long>(1.06 * static_cast<double>(next_check_)));
    return check(r);
  }

  bool check(const std::vector<Vector>& r) {
    const double paused = thread_seconds();
    const DiscreteError error = discrete_error(problem_, std::span<const Vector>(r));
    last_ = error.scaled;
    if (std::isfinite(error.scaled) && measure(error) < measure(best_error_)) {
      best_ = r, best_error_ = error, best_solver_ = solver_;
    }
    if (options_.history) note(error);
    checks_ += thread_seconds() - paused;
    return done();
  }

  bool reached() const {
    // Relative to impulses that grow without bound any miss is small: it must be small for the load too.
    return !unbounded() && best_error_.scaled <= options_.error &&
           best_error_.miss <= largest_miss * best_error_.load &&
           (options_.siconos_error <= 0 || best_error_.siconos <= options_.siconos_error);
  }
  /// Whether the impulses have grown as they do where there is no solution.
  bool unbounded() const { return best_error_.impulse > 1e8 * best_error_.load; }
  /// Whether the impulses have grown far above the load without meeting it.
  bool growing() const {
    return best_error_.impulse > 1e4 * best_error_.load && best_error_.miss > largest_miss * best_error_.load;
  }
  bool out_of_time() const { return seconds() >= options_.seconds; }
  bool done() const { return reached() || out_of_time(); }

  double seconds() const { return thread_seconds() - started_ - checks_; }
  double last() const { return last_; }  ///< errS at the last check
  const std::vector<Vector>& best() const { return best_; }
  const DiscreteError& best_error() const { return best_error_; }
  const std::string& best_solver() const { return best_solver_; }
  long iterations() const { return iterations_; }
  std::vector<DiscreteHistory> take_history() { return std::move(history_); }

 private:
  static constexpr double largest_miss = 1e-3;

  /// What is to become small, in units of what is asked.
  double measure(const DiscreteError& error) const {
    const double scaled = error.scaled / options_.error;
    return options_.siconos_error > 0 ? std::max(scaled, error.siconos / options_.siconos_error) : scaled;
  }
  void note(const DiscreteError& error) {
    if (options_.history) history_.push_back({seconds(), solver_, iterations_, error.scaled, error.siconos});
  }

  const ScaledProblem<B>& problem_;
  const DiscreteOptions& options_;
  double started_, checks_ = 0, last_ = std::numeric_limits<double>::infinity();
  long iterations_ = 0, phase_iterations_ = 0, next_check_ = 1;
  std::vector<Vector> best_;
  DiscreteError best_error_;
  std::string solver_, best_solver_;
  std::vector<DiscreteHistory> history_;
};

}  // namespace galet::cd
