// The contact problem of one step of the cd engine as a discrete problem, to be kept or given to other solvers.
#pragma once

#include <vector>

#include "cd/discrete/problem.hpp"

namespace galet::cd {

/// Contacts that nothing can move are left out. Units: those of the scene (q a velocity, r an impulse).
struct StepProblem {
  DiscreteProblem problem;
  std::vector<double> r;  ///< the engine's impulses, right to its tolerance
  std::vector<double> u;  ///< W r + q
};

/// What an engine that solves contact problems can show of them.
class ProblemSource {
 public:
  virtual ~ProblemSource() = default;

  /// Takes one step and returns the problem that was solved in it, of the last part where the step was taken in parts.
  /// Throws InputError when it has no such form: pivoting resistance; more contacts of a stress-driven cell than a
  /// dense W allows.
  virtual StepProblem step_with_problem() = 0;
};

}  // namespace galet::cd
