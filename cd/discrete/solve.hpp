// Solves a discrete contact problem (cd/discrete/problem.hpp).
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "cd/discrete/global_problem.hpp"
#include "cd/discrete/problem.hpp"

namespace galet::cd {

struct DiscreteOptions {
  double error = 1e-8;          ///< errS wanted (cd/discrete/error.hpp)
  double seconds = 10;          ///< processor time allowed
  std::string solver = "auto";  ///< one of discrete_solvers()
  std::vector<double> start;    ///< first r; empty: zero
  bool history = false;         ///< fill DiscreteSolution::history
  double siconos_error = 0;     ///< go on until errP is below this too (0: not asked)
};

struct DiscreteHistory {
  double seconds;               ///< processor time, checks not counted
  std::string solver;           ///< that was at work
  long iterations;              ///< since the start, of all solvers
  double error, siconos_error;  ///< errS, errP
};

struct DiscreteSolution {
  std::vector<double> r, u;  ///< u = W r + q
  double error = 0;          ///< errS of r
  double siconos_error = 0;  ///< errP of r
  double force_error = 0;    ///< estimate of the relative error of r: |r - P_K(r - u^)| / |r|, scaled
  double violation = 0;      ///< largest -u_N (in units of u): what a gap would lose
  bool converged = false;
  std::string reason;  ///< why it stopped: "error reached", "out of time", "stalled", "impulses without bound", or "no
                       ///< solution" where contacts close against each other (cd/discrete/contradiction.hpp)
  std::vector<int> contradiction;  ///< those contacts
  double least_impulse = 0;        ///< where it did not converge: no solution has |r| below this times |q|, scaled
  std::string solver;              ///< whose iterate r is
  long iterations = 0;
  double seconds = 0;  ///< processor time, checks not counted
  std::vector<DiscreteHistory> history;
};

/// Names that `DiscreteOptions::solver` accepts, "auto" first.
std::vector<std::string_view> discrete_solvers();

/// Whether this solver factorises matrices of the bodies (cd/discrete/body_matrix.hpp) and needs to be given them.
bool needs_bodies(std::string_view solver);

/// Never worse than its best iterate. `bodies`: the global form of the same problem, where it is known; "auto" then
/// factorises whichever form is smaller. Answers are measured with W alone, so that bodies of another problem could
/// only spoil directions. Throws std::invalid_argument where mistakes_of(problem) is not empty, the solver is unknown
/// or needs bodies that are not given, or their sizes are not those of the problem.
DiscreteSolution solve(const DiscreteProblem& problem, const DiscreteOptions& options,
                       const GlobalProblem* bodies = nullptr);

}  // namespace galet::cd
