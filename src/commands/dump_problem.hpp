// galet run --dump-problem: the contact problem of one step as an FCLIB file.
#pragma once

#include <string>

#include "cd/discrete/step_problem.hpp"
#include "src/simulation.hpp"

namespace galet::cli {

struct DumpRequest {
  long step = 0;      ///< 1: the first of the run proper
  std::string file;   ///< to be written
  std::string title;  ///< of the scene
  cd::ProblemForm form = cd::ProblemForm::local;
};

/// Takes the run to that step (through the stage before, if the scene has one) and writes the step's problem, with the
/// engine's impulses as its solution. Returns the exit code. Throws InputError for engine md, for steps that lie
/// behind, and for problems that have no such form.
template <int D>
int dump_problem(Simulation<D>& simulation, const DumpRequest& request, const RunControl& control);

}  // namespace galet::cli
