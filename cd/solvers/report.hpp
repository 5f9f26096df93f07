// What a contact solver is asked for, and what it says of its work.
#pragma once

namespace galet::cd {

enum class StopReason {
  converged,       ///< the residual is at or below the tolerance
  max_iterations,  ///< the sweeps ran out first
  stalled,         ///< sweeps change nothing any more but the last digits, and the tolerance is below that
  unbounded        ///< impulses grow and the misfit stays: no solution, or (mass ratios of 1e8) one much further off
};

/// What was made of the sweeps when the solver ended (cd/solvers/iteration.hpp).
enum class SolverMethod { plain, momentum, conjugate };

struct SolveReport {
  StopReason stop = StopReason::converged;
  SolverMethod method = SolverMethod::plain;  ///< that was at work at the end
  int sweeps = 0;
  double residual = 0;  ///< reached (cd/residual.hpp): that of the impulses handed back, the best that were checked
};

struct SolverOptions {
  double tolerance = 1e-4;  ///< on the residual; useful range 1e-2 .. 1e-10
  int max_sweeps = 2000;
  double momentum = 0.9;  ///< largest beta of the momentum step; 0: plain Gauss-Seidel
};

}  // namespace galet::cd
