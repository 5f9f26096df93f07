// Sweeps and time that Gauss-Seidel needs from a cold start, plain and with momentum, on one step of a dense
// frictional packing at rest under pressure (every contact closed): the hard case of a rigid engine.
// Prints one CSV row per (dimension, grains, solver, tolerance). Processor time; ratios within one run count.
#include <ctime>

#include <fmt/format.h>

#include "benchmarks/cold_problem.hpp"
#include "cd/solvers/nsgs.hpp"

namespace galet {
namespace {

double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

template <Layout Y>
void measure(int count) {
  const bench::ColdProblem<Y> cold(count);
  for (const double tolerance : {1e-2, 1e-3, 1e-4, 1e-5}) {
    for (const double momentum : {0.0, 0.9}) {
      cd::Iterate<Y> iterate = cold.start;
      cd::Nsgs<Y> solver;
      const double before = cpu_seconds();
      const cd::SolveReport report = solver.solve(cold.problem, {tolerance, 20000, momentum}, iterate);
      const double seconds = cpu_seconds() - before;
      fmt::print("{},{},{},{},{},{},{:.3g},{:.4f},{:.1f}\n", Y.dim, count, cold.problem.size(),
                 momentum > 0 ? "momentum" : "plain", tolerance, report.sweeps, report.residual, seconds,
                 1e9 * seconds / (static_cast<double>(report.sweeps) * static_cast<double>(cold.problem.size())));
    }
  }
}

}  // namespace
}  // namespace galet

int main() {
  fmt::print("dimension,grains,contacts,solver,tolerance,sweeps,residual,seconds,ns_per_contact_and_sweep\n");
  galet::measure<galet::Layout{2, true}>(500);
  galet::measure<galet::Layout{2, true}>(2000);
  galet::measure<galet::Layout{3, true}>(500);
  galet::measure<galet::Layout{3, true}>(2000);
}
