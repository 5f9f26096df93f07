#include "src/commands/dump_problem.hpp"

#include <fmt/format.h>

#include "cd/discrete/fclib.hpp"
#include "common/core/error.hpp"

namespace galet::cli {

template <int D>
int dump_problem(Simulation<D>& simulation, const DumpRequest& request, const RunControl& control) {
  if (dynamic_cast<cd::ProblemSource*>(&simulation.engine()) == nullptr)
    throw InputError(
        fmt::format("--dump-problem needs engine cd: {} solves no contact problems", simulation.engine().name()));
  RunResult stage;
  if (!simulation.prepare(control, stage)) {
    fmt::print(stderr, "galet: {}\n", stage.failure.empty() ? "stopped" : stage.failure);
    return 1;
  }
  Engine<D>& engine = simulation.engine();
  const long before = request.step - 1 - engine.steps();
  if (before < 0)
    throw InputError(fmt::format("--dump-problem {}: the run is already at step {}, the next one is {}", request.step,
                                 engine.steps(), engine.steps() + 1));
  for (long step = 0; step < before; ++step) {
    engine.advance(1);
    if (control.stop && control.stop()) {
      fmt::print(stderr, "galet: stopped after step {}\n", engine.steps());
      return 1;
    }
  }
  const bool global = request.form == cd::ProblemForm::global;
  cd::StepProblem step = dynamic_cast<cd::ProblemSource&>(engine).step_with_problem(request.form);
  std::string& title = global ? step.global.title : step.problem.title;
  std::string& description = global ? step.global.description : step.problem.description;
  title = request.title;
  description = fmt::format(
      "contact problem of step {} (time {:.9g}) of galet's engine cd, step length {:.9g}; {}, r: impulses, "
      "in the units of the scene; solution: the engine's impulses, right to its tolerance {:g}",
      request.step, engine.time(), engine.dt(),
      global ? "v: velocities of bodies, cell modes and elastic contacts" : "q: velocities",
      simulation.scene().cd.tolerance);
  const cd::FclibScale scale{step.gap_time, simulation.derived().grains.mean_diameter};
  if (global) {
    cd::write_fclib(request.file, cd::FclibGlobalContent{step.global, step.v, step.u, step.r, scale});
    fmt::print("{}: {} contacts of {} numbers, {} freedoms, {} entries of H\n", request.file, step.global.mu.size(),
               step.global.block, step.global.mass.rows(), step.global.jacobian.nonZeros());
  } else {
    cd::write_fclib(request.file, cd::FclibContent{step.problem, step.u, step.r, scale});
    fmt::print("{}: {} contacts of {} numbers, {} entries of W\n", request.file, step.problem.contacts(),
               step.problem.block, step.problem.value.size());
  }
  return 0;
}

template int dump_problem<2>(Simulation<2>&, const DumpRequest&, const RunControl&);
template int dump_problem<3>(Simulation<3>&, const DumpRequest&, const RunControl&);

}  // namespace galet::cli
