#include "cd/discrete/solve.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>

#include "cd/discrete/block_matrix.hpp"
#include "cd/discrete/body_matrix.hpp"
#include "cd/discrete/contradiction.hpp"
#include "cd/discrete/convex_newton.hpp"
#include "cd/discrete/interior_point.hpp"
#include "cd/discrete/iterations.hpp"
#include "cd/discrete/proximal_newton.hpp"
#include "cd/discrete/sweeps.hpp"
#include "common/core/error.hpp"

namespace galet::cd {

namespace {

constexpr Momentum exact_momentum{0.9, 1.05}, current_momentum{0.9, 1.5}, frozen_momentum{1, 0};
constexpr int frozen_sweeps = 20;
constexpr long endless = std::numeric_limits<long>::max();
/// Rows (of W, or of M) up to which a factorisation costs no more than the sweeps that it may save.
constexpr int most_factored_rows = 6000;
/// Sweeps that look for a reason why there is no solution: after the first round that failed, and at the end.
constexpr long early_search = 500, late_search = 20000;

template <int B>
class Solvers {
 public:
  using Vector = typename ScaledProblem<B>::Vector;
  Solvers(const ScaledProblem<B>& problem, const GlobalProblem* bodies, Monitor<B>& monitor,
          Contradiction<B>& contradiction)
      : problem_(problem), bodies_(bodies), monitor_(monitor), contradiction_(contradiction) {}

  bool gauss_seidel(long budget) { return exact("gs", {0, 0}, budget); }
  bool momentum(long budget) { return exact("ags", exact_momentum, budget); }
  bool conjugate(long budget) {
    monitor_.begin("nncg");
    auto r = monitor_.best();
    ExactSweep<B> sweep(problem_);
    return iterate_conjugate<B>(sweep, budget, r, monitor_);
  }
  bool projected(long budget) { return projected("pgs", 0, current_momentum, budget); }
  bool frozen(long budget) { return projected("pgs-frozen", frozen_sweeps, frozen_momentum, budget); }
  bool interior_point(long budget) {
    BlockMatrix<B> matrix(problem_);
    return interior_point("ipm", matrix, budget);
  }
  bool interior_point_of_bodies(long budget) {
    BodyMatrix<B> matrix(problem_, *bodies_);
    return interior_point("ipm-bodies", matrix, budget);
  }
  bool newton(long budget) {
    BlockMatrix<B> matrix(problem_);
    return newton("newton", matrix, budget);
  }
  bool convex_newton(long budget) {
    BlockMatrix<B> matrix(problem_);
    return convex_newton("newton-frozen", matrix, budget);
  }
  bool convex_newton_of_bodies(long budget) {
    BodyMatrix<B> matrix(problem_, *bodies_);
    return convex_newton("newton-frozen-bodies", matrix, budget);
  }
  bool newton_of_bodies(long budget) {
    BodyMatrix<B> matrix(problem_, *bodies_);
    return newton("newton-bodies", matrix, budget);
  }

  /// Cheap methods first; each starts from the best iterate, and rounds grow.
  bool automatic() {
    const bool bulk = problem_.diagonal && problem_.size() > 2000;
    if (bulk) return in_bulk();
    for (double budget = 1;; budget *= 2.5) {
      if (budget > 1 && contradiction_.search(early_search) && contradiction_.none()) return false;
      const auto sweeps = [&](double count) { return static_cast<long>(count * budget); };
      if constexpr (B != 5)
        if (momentum(sweeps(300))) return true;
      if (projected(sweeps(600))) return true;
      if (frozen(sweeps(2000))) return true;
      const bool on_bodies = bodies_ && bodies_->mass.rows() < B * problem_.size();
      if ((on_bodies ? bodies_->mass.rows() : B * problem_.size()) > most_factored_rows) continue;
      if (on_bodies ? newton_of_bodies(40) || interior_point_of_bodies(60) : newton(40) || interior_point(60))
        return true;
    }
  }

 private:
  bool exact(const char* name, const Momentum& momentum, long budget) {
    monitor_.begin(name);
    auto r = monitor_.best();
    ExactSweep<B> sweep(problem_);
    return iterate<B>(sweep, momentum, budget, r, monitor_);
  }
  bool projected(const char* name, int frozen, const Momentum& momentum, long budget) {
    monitor_.begin(name);
    auto r = monitor_.best();
    ProjectedSweep<B> sweep(problem_, frozen, r);
    return iterate<B>(sweep, momentum, budget, r, monitor_);
  }

  bool interior_point(const char* name, NewtonMatrix<B>& matrix, long budget) {
    monitor_.begin(name);
    return InteriorPoint<B>(problem_, matrix).solve(budget, monitor_);
  }
  bool newton(const char* name, NewtonMatrix<B>& matrix, long budget) {
    monitor_.begin(name);
    return ProximalNewton<B>(problem_, matrix, monitor_.best()).solve(budget, monitor_);
  }

  bool convex_newton(const char* name, NewtonMatrix<B>& matrix, long budget) {
    monitor_.begin(name);
    return ConvexNewton<B>(problem_, matrix, monitor_.best()).solve(budget, monitor_);
  }

  /// Many grains: momentum for as long as it halves the error in a thousand sweeps, then conjugate directions.
  bool in_bulk() {
    for (double before = monitor_.best_error().scaled;; before = monitor_.best_error().scaled) {
      if (momentum(1000)) return true;
      if (monitor_.best_error().scaled > 0.5 * before) break;
    }
    return conjugate(endless);
  }

  const ScaledProblem<B>& problem_;
  const GlobalProblem* bodies_;
  Monitor<B>& monitor_;
  Contradiction<B>& contradiction_;
};

template <int B>
using Method = bool (*)(Solvers<B>&);

template <int B>
struct Named {
  std::string_view name;
  Method<B> run;
  bool bodies = false;
};

template <int B>
constexpr Named<B> methods[] = {
    {"auto", [](Solvers<B>& solvers) { return solvers.automatic(); }},
    {"gs", [](Solvers<B>& solvers) { return solvers.gauss_seidel(endless); }},
    {"ags", [](Solvers<B>& solvers) { return solvers.momentum(endless); }},
    {"nncg", [](Solvers<B>& solvers) { return solvers.conjugate(endless); }},
    {"pgs", [](Solvers<B>& solvers) { return solvers.projected(endless); }},
    {"pgs-frozen", [](Solvers<B>& solvers) { return solvers.frozen(endless); }},
    {"newton", [](Solvers<B>& solvers) { return solvers.newton(400); }},
    {"newton-frozen", [](Solvers<B>& solvers) { return solvers.convex_newton(400); }},
    {"ipm", [](Solvers<B>& solvers) { return solvers.interior_point(200); }},
    {"newton-bodies", [](Solvers<B>& solvers) { return solvers.newton_of_bodies(400); }, true},
    {"newton-frozen-bodies", [](Solvers<B>& solvers) { return solvers.convex_newton_of_bodies(400); }, true},
    {"ipm-bodies", [](Solvers<B>& solvers) { return solvers.interior_point_of_bodies(200); }, true},
};

template <int B>
DiscreteSolution solve_blocks(const DiscreteProblem& given, const DiscreteOptions& options,
                              const GlobalProblem* bodies) {
  const ScaledProblem<B> problem(given);
  using Vector = typename ScaledProblem<B>::Vector;
  const std::vector<double> zero(given.rows(), 0.0);
  std::vector<Vector> start = problem.scaled(options.start.empty() ? zero : options.start);
  Monitor<B> monitor(problem, options, std::move(start));
  Contradiction<B> contradiction(problem);
  Solvers<B> solvers(problem, bodies, monitor, contradiction);
  const auto* method = std::find_if(std::begin(methods<B>), std::end(methods<B>),
                                    [&](const Named<B>& named) { return named.name == options.solver; });
  if (!monitor.done()) method->run(solvers);
  if (!monitor.reached()) contradiction.search(late_search);

  DiscreteSolution solution;
  solution.r = problem.physical(monitor.best());
  solution.u.resize(solution.r.size());
  for (int c = 0; c < problem.size(); ++c)
    Eigen::Map<Vector>(&solution.u[B * c]) =
        problem.motion(c, std::span<const Vector>(monitor.best())).cwiseQuotient(problem.scale[c]);
  const DiscreteError& error = monitor.best_error();
  solution.error = error.scaled, solution.siconos_error = error.siconos;
  solution.force_error = error.force, solution.violation = error.violation;
  solution.converged = monitor.reached();
  solution.reason = monitor.reached()                          ? "error reached"
                    : contradiction.none()                     ? "no solution"
                    : monitor.unbounded() || monitor.growing() ? "impulses without bound"
                    : monitor.out_of_time()                    ? "out of time"
                                                               : "stalled";
  if (!monitor.reached()) {
    solution.contradiction = contradiction.contacts();
    solution.least_impulse = contradiction.least_impulse();
  }
  solution.solver = monitor.best_solver();
  solution.iterations = monitor.iterations();
  solution.seconds = monitor.seconds();
  solution.history = monitor.take_history();
  return solution;
}

}  // namespace

std::vector<std::string_view> discrete_solvers() {
  std::vector<std::string_view> names;
  for (const Named<3>& method : methods<3>) names.push_back(method.name);
  return names;
}

bool needs_bodies(std::string_view solver) {
  return std::any_of(std::begin(methods<3>), std::end(methods<3>),
                     [&](const Named<3>& method) { return method.name == solver && method.bodies; });
}

DiscreteSolution solve(const DiscreteProblem& problem, const DiscreteOptions& options, const GlobalProblem* bodies) {
  const std::vector<std::string> mistakes = mistakes_of(problem);
  require(mistakes.empty(), mistakes.empty() ? "" : mistakes.front().c_str());
  const auto names = discrete_solvers();
  require(std::find(names.begin(), names.end(), options.solver) != names.end(), "no such solver of contact problems");
  require(bodies || !needs_bodies(options.solver),
          "this solver factorises matrices of the bodies, which are not given");
  require(!bodies || (bodies->block == problem.block && bodies->jacobian.cols() == problem.rows() &&
                      bodies->jacobian.rows() == bodies->mass.rows() && bodies->mass.rows() == bodies->mass.cols()),
          "the bodies are those of another problem");
  require(options.start.empty() || options.start.size() == problem.q.size(), "the start has another size than q");
  if (problem.contacts() == 0) {
    DiscreteSolution nothing;
    nothing.converged = true, nothing.reason = "error reached";
    return nothing;
  }
  switch (problem.block) {
    case 2:
      return solve_blocks<2>(problem, options, bodies);
    case 3:
      return solve_blocks<3>(problem, options, bodies);
    default:
      return solve_blocks<5>(problem, options, bodies);
  }
}

}  // namespace galet::cd
