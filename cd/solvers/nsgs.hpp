// Nonsmooth Gauss-Seidel over contact columns, matrix-free, with momentum and conjugate directions.
//
// One sweep goes through the colours; the contacts of a colour share no grain, so threads may take them in any
// order with the same bits. The hub (the stress-driven cell) is touched by every contact: its velocity is held
// within a block of contacts, whose impulses are summed in a fixed order and then given to the hub together. A block
// is small enough that the hub's answer to all of it stays below a fifth of a contact's own W_NN, so that the
// block-wise treatment converges like the sequential one.
//
// What is made of the sweeps stands in iteration.hpp: momentum, and conjugate directions where it stalls. Velocities
// and hub are affine in the impulses, so they are extrapolated alongside; no product with W is needed. Measured: 2 to
// 11 times fewer sweeps in dense packings from a cold start than plain Gauss-Seidel (benchmarks/solver_sweeps.cpp).
//
// Problems of rigid contacts between grains that roll freely are swept in records and groups of four
// (plain_sweeps.hpp); this file sweeps all others, and defines what a sweep is.
//
// Sources: Moreau 1994; Jean 1999; Jourdan, Alart and Jean 1998. Cost per sweep: one visit of each contact.
#pragma once

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "cd/laws/contact_bounds.hpp"
#include "cd/laws/turning_contact.hpp"
#include "cd/problem.hpp"
#include "cd/residual.hpp"
#include "cd/solvers/iteration.hpp"
#include "cd/solvers/plain_sweeps.hpp"
#include "cd/solvers/report.hpp"

namespace galet::cd {

template <Layout Y>
class Nsgs {
 public:
  static constexpr int D = Y.dim;

  /// Starts from iterate.reaction with the velocities that belong to it, and leaves the solution there. Never worse
  /// than the best of the iterates that were checked, the start included.
  SolveReport solve(const Problem<Y>& problem, const SolverOptions& options, Iterate<Y>& iterate);

 private:
  /// Number of contacts between two updates of the hub.
  static std::size_t hub_block(const Problem<Y>& problem) {
    double strongest = 0;
    for (const HubMode<D>& mode : problem.hub)
      strongest = std::max(strongest, mode.inverse_inertia * mode.direction.squaredNorm());
    if (strongest == 0) return problem.size();
    double least = 1e300;
    for (std::size_t k = 0; k < problem.size(); ++k)
      if (problem.wn[k] > 0) least = std::min(least, problem.wn[k] / branch_of(problem, k).squaredNorm());
    return static_cast<std::size_t>(std::clamp(0.2 * least / strongest, 1.0, static_cast<double>(problem.size())));
  }

  /// One pass over all contacts. Returns the squared change and the squared impulses, both in energy units.
  ResidualParts sweep(const Problem<Y>& problem, Iterate<Y>& iterate) {
    ResidualParts total;
    const int groups = static_cast<int>(problem.group.size()) - 1;
    for (int g = 0; g < groups; ++g) {
      const bool shared = g == problem.shared[0] || g == problem.shared[1];
      const std::size_t end = problem.group[g + 1];
      for (std::size_t begin = problem.group[g]; begin < end; begin += block_)
        total += sweep_block(problem, iterate, begin, std::min(end, begin + block_), shared);
    }
    return total;
  }

  ResidualParts sweep_block(const Problem<Y>& problem, Iterate<Y>& iterate, std::size_t begin, std::size_t end,
                            bool sequential) {
    const std::size_t count = end - begin;
    if (partial_change_.size() < chunk_count(count)) {
      partial_change_.resize(chunk_count(count));
      partial_virial_.resize(chunk_count(count));
    }
    const bool turning = problem.turns(begin);  // a group is all of one kind
    const auto body = [&](std::size_t chunk, std::size_t from, std::size_t to) {
      if (turning)
        sweep_chunk<true>(problem, iterate, begin + from, begin + to, chunk);
      else
        sweep_chunk<false>(problem, iterate, begin + from, begin + to, chunk);
    };
    if (sequential)
      for (std::size_t chunk = 0; chunk < chunk_count(count); ++chunk)
        body(chunk, chunk * chunk_size, std::min(count, (chunk + 1) * chunk_size));
    else
      parallel_chunks(count, body);
    ResidualParts total;
    Mat<D> virial = Mat<D>::Zero();
    for (std::size_t chunk = 0; chunk < chunk_count(count); ++chunk) {
      total += partial_change_[chunk];
      virial += partial_virial_[chunk];
    }
    add_to_hub(problem, iterate, virial);
    return total;
  }

  template <bool Turning>
  void sweep_chunk(const Problem<Y>& problem, Iterate<Y>& iterate, std::size_t from, std::size_t to,
                   std::size_t chunk) {
    ResidualParts change;
    Mat<D> virial = Mat<D>::Zero();
    const Mat<D> gradient = iterate.gradient;  // a local copy stays in registers
    for (std::size_t k = from; k < to; ++k) change += visit<Turning>(problem, iterate, gradient, k, virial);
    partial_change_[chunk] = change;
    partial_virial_[chunk] = virial;
  }

  template <bool Turning>
  static ResidualParts visit(const Problem<Y>& problem, Iterate<Y>& iterate, const Mat<D>& gradient, std::size_t k,
                             Mat<D>& virial) {
    if (problem.wn[k] == 0) return {};
    const Vec<D>& n = problem.normal[k];
    const Reaction<Y> before = iterate.reaction[k];
    const Components<Y> r = components<Y>(n, before);
    const Components<Y> motion = law_motion<Y, Turning>(problem, iterate, gradient, k, r);
    Components<Y> next;
    if constexpr (Turning)
      next = solve_turning_contact<Y>(problem, k, motion, r);
    else
      next = solve_contact<Y>(problem, k, motion, r);
    const Reaction<Y> after = composed<Y>(n, next);
    const Reaction<Y> change = after - before;
    const double impulse = weighted_square(problem, k, after);
    if (change.isZero(0)) return {0, impulse};
    iterate.reaction[k] = after;
    add_reaction<Y, Turning>(problem, iterate, k, change, virial);
    return {weighted_square(problem, k, change), impulse};
  }

  /// Where the solver failed its start may be better than what it found.
  bool start_is_better(const Problem<Y>& problem, const Iterate<Y>& start, SolveReport& report) {
    if (report.stop == StopReason::converged) return false;
    const double at_start = residual(problem, start, partial_residual_);
    if (!(at_start < report.residual)) return false;
    report.residual = at_start;
    return true;
  }

  static void copy_state(const Iterate<Y>& from, Iterate<Y>& to) {
    to.reaction.reserve(from.reaction.capacity());
    copy_with_room(from.reaction, to.reaction);
    copy_with_room(from.velocity, to.velocity);
    if constexpr (Y.friction) copy_with_room(from.spin, to.spin);
    copy_with_room(from.hub_rate, to.hub_rate);
    to.gradient = from.gradient;
  }

  /// Sweeps over the iterate itself, for any problem (the interface of PlainSweeps).
  class General {
   public:
    General(Nsgs& solver, const Problem<Y>& problem, Iterate<Y>& iterate)
        : solver_(solver), problem_(problem), now_(iterate) {
      restart();
    }

    ResidualParts sweep(double beta) {
      each_column(solver_.previous_, [&](auto& now, auto& before, auto&) {
        const std::remove_reference_t<decltype(now)> here = now;
        if (beta != 0) now += beta * (here - before);
        before = here;
      });
      return solver_.sweep(problem_, now_);
    }
    ResidualParts sweep_along(double beta) {
      if (!directed_) copy_state(now_, solver_.direction_);
      each_column(solver_.direction_, [&](auto& now, auto& before, auto& step) {
        if (directed_) now += beta * step;
        step = now - before;
        before = now;
      });
      directed_ = true;
      return solver_.sweep(problem_, now_);
    }
    double residual() { return cd::residual(problem_, now_, solver_.partial_residual_); }
    void restart() {
      copy_state(now_, solver_.previous_);
      directed_ = false;
    }
    void keep() { copy_state(now_, solver_.kept_); }
    void return_to_kept() {
      copy_state(solver_.kept_, now_);
      restart();
    }

   private:
    /// Calls step(now, before, other) for each value of the iterate.
    template <class Step>
    void each_column(Iterate<Y>& other, const Step& step) {
      Iterate<Y>& before = solver_.previous_;
      const auto each = [&](auto& now, auto& old, auto& third) {
        parallel_ranges(
            now.size(),
            [&](std::size_t begin, std::size_t end) {
              for (std::size_t k = begin; k < end; ++k) step(now[k], old[k], third[k]);
            },
            4096);
      };
      each(now_.reaction, before.reaction, other.reaction);
      each(now_.velocity, before.velocity, other.velocity);
      if constexpr (Y.friction) each(now_.spin, before.spin, other.spin);
      each(now_.hub_rate, before.hub_rate, other.hub_rate);
      step(now_.gradient, before.gradient, other.gradient);
    }

    Nsgs& solver_;
    const Problem<Y>& problem_;
    Iterate<Y>& now_;
    bool directed_ = false;
  };

  std::size_t block_ = 1;
  Iterate<Y> start_, previous_, direction_, kept_;  ///< of General
  std::vector<ResidualParts> partial_change_, partial_residual_;
  std::vector<Mat<D>> partial_virial_;
  struct None {};
  std::conditional_t<Y.rolling, None, PlainSweeps<Y>> plain_;
};

template <Layout Y>
SolveReport Nsgs<Y>::solve(const Problem<Y>& problem, const SolverOptions& options, Iterate<Y>& iterate) {
  SolveReport report;
  if (problem.size() == 0) return report;
  block_ = hub_block(problem);
  if constexpr (!Y.rolling)
    if (plain_.load(problem, iterate, block_)) {
      report = Iteration(plain_, options).run();
      if (!start_is_better(problem, iterate, report)) plain_.unload(iterate);
      return report;
    }
  copy_state(iterate, start_);
  // What few solves need has its memory before, so that no later step allocates.
  copy_state(iterate, kept_), copy_state(iterate, direction_);
  General general(*this, problem, iterate);
  report = Iteration(general, options).run();
  if (start_is_better(problem, start_, report)) copy_state(start_, iterate);
  return report;
}

// Compiled in cd/solver_instances.cpp, and only there: what uses the solver is spared minutes. (A member that is
// defined inside of its class would be compiled wherever it is used, declared extern or not.)
extern template class Nsgs<Layout{2, false}>;
extern template class Nsgs<Layout{2, true}>;
extern template class Nsgs<Layout{2, true, true}>;
extern template class Nsgs<Layout{3, false}>;
extern template class Nsgs<Layout{3, true}>;
extern template class Nsgs<Layout{3, true, true}>;

}  // namespace galet::cd
