// What a contact solver says of its work.
#pragma once

namespace galet::cd {

enum class StopReason {
  converged,      ///< the residual is at or below the tolerance
  max_iterations  ///< the sweeps ran out first
};

struct SolveReport {
  StopReason stop = StopReason::converged;
  int sweeps = 0;
  double residual = 0;  ///< reached (cd/residual.hpp)
};

struct SolverOptions {
  double tolerance = 1e-4;  ///< on the residual; useful range 1e-2 .. 1e-10
  int max_sweeps = 2000;
  double momentum = 0.9;  ///< largest beta of the momentum step; 0: plain Gauss-Seidel
};

}  // namespace galet::cd
