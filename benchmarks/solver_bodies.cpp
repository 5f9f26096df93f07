// Second-order methods that factorise matrices of the bodies beside those that factorise W, and beside sweeps, on
// single steps of sphere packings under gravity.
//
//   solver_bodies [FILE]      FILE: the geometry of pile3d (benchmarks/pile_problem.hpp), solved too where it is given
//
// Each method starts from the same impulses, those of momentum at errS = 2e-5, and has three seconds of processor time.
// A row has the freedoms of the bodies and the numbers of the contacts (the rows of the two kinds of matrices), the
// best errS and errP, the iterations (of newton and ipm: factorisations) and the time of one.
#include <fmt/format.h>

#include "benchmarks/dense_sample.hpp"
#include "benchmarks/pile_problem.hpp"
#include "cd/discrete/discrete_form.hpp"
#include "cd/discrete/solve.hpp"

namespace galet {
namespace {

using bench::Pile;

constexpr double start_error = 2e-5, seconds = 3;

void solve_pile(const std::string& name, const Pile& pile) {
  const cd::GlobalProblem bodies =
      cd::DiscreteForm<Pile::Y>::of(pile.problem, pile.free, pile.free.reaction, cd::ProblemForm::global).global;
  const cd::DiscreteProblem problem = cd::reduced(bodies);
  cd::DiscreteOptions options;
  options.seconds = seconds;
  options.solver = "ags", options.error = start_error;
  options.start = cd::solve(problem, options).r;
  options.error = 1e-10;
  for (const char* solver :
       {"ags", "newton", "newton-bodies", "newton-frozen", "newton-frozen-bodies", "ipm", "ipm-bodies"}) {
    options.solver = solver;
    const cd::DiscreteSolution solution = cd::solve(problem, options, &bodies);
    fmt::print("{},{},{},{},{},{:.2e},{:.2e},{},{:.2g}\n", name, problem.contacts(), bodies.mass.rows(), problem.rows(),
               solver, solution.error, solution.siconos_error, solution.iterations,
               solution.seconds / static_cast<double>(std::max(1L, solution.iterations)));
    std::fflush(stdout);
  }
}

}  // namespace
}  // namespace galet

int main(int argc, char** argv) {
  using namespace galet;
  if (argc > 2) {
    fmt::print(stderr, "usage: solver_bodies [FILE]\n");
    return 2;
  }
  try {
    fmt::print("problem,contacts,freedoms,numbers,solver,errS,errP,iterations,seconds of one\n");
    const Sample<3> packing = bench::dense_sample<3>(2000, 0.4);
    for (const double side : {5.0, 6.5, 8.0, 10.0})
      solve_pile(fmt::format("cube of {:g} d", side), bench::pile_of_packing(packing, side, 0.4, 0.01));
    if (argc == 2) solve_pile("pile3d", bench::pile_of_file(argv[1], 0.5));
  } catch (const std::exception& error) {
    fmt::print(stderr, "solver_bodies: {}\n", error.what());
    return 1;
  }
  return 0;
}
