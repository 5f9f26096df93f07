// The contact problem of one step of the cd engine as a discrete problem, to be kept or given to other solvers.
#pragma once

#include <vector>

#include "cd/discrete/global_problem.hpp"
#include "cd/discrete/problem.hpp"

namespace galet::cd {

enum class ProblemForm {
  local,  ///< W and q
  global  ///< M, H, f and w: sparse whatever the cell does
};

/// Contacts that nothing can move are left out. Units: those of the scene (q and v velocities, r an impulse).
struct StepProblem {
  ProblemForm form = ProblemForm::local;
  DiscreteProblem problem = {};  ///< in the local form
  GlobalProblem global = {};     ///< in the global form
  std::vector<double> r = {};    ///< the engine's impulses, right to its tolerance
  std::vector<double> u = {};    ///< W r + q
  std::vector<double> v = {};    ///< in the global form: M^-1 (H r + f)
  double gap_time = 0;           ///< a gap changes by this times u_N in the step (theta times its length)
};

/// What an engine that solves contact problems can show of them.
class ProblemSource {
 public:
  virtual ~ProblemSource() = default;

  /// Takes one step and returns the problem that was solved in it, of the last part where the step was taken in parts.
  /// Throws InputError when it has no such form: pivoting resistance; more contacts of a stress-driven cell than a
  /// dense W allows (local form).
  virtual StepProblem step_with_problem(ProblemForm form) = 0;
};

}  // namespace galet::cd
