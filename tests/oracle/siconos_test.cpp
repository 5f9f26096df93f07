// The global form of a step, as Siconos reads and solves it where this machine has it.
#include <sstream>

#include <gtest/gtest.h>

#include "cd/discrete/error.hpp"
#include "cd/discrete/fclib.hpp"
#include "cd/discrete/step_problem.hpp"
#include "tests/determinism/sheared.hpp"
#include "tests/support/other_programs.hpp"

namespace galet::cd::siconos_test {
namespace {

/// M v = H r + f and u = H^T v + w, solved by Siconos' own Gauss-Seidel to its own error 1e-5; prints r.
constexpr const char* script = R"(
import warnings
warnings.simplefilter("ignore")
import os
import h5py
import numpy as np
import scipy.sparse as sparse
import siconos.numerics as sn
form = h5py.File(sys.argv[1] + "/global.hdf5")["fclib_global"]
def matrix(name):
    shape = (int(form[name + "/m"][0]), int(form[name + "/n"][0]))
    return sparse.csc_matrix((form[name + "/x"][:], form[name + "/i"][:], form[name + "/p"][:]), shape=shape)
problem = sn.GlobalFrictionContactProblem()
problem.dimension = int(form["spacedim"][0])
problem.M, problem.H = matrix("M"), matrix("H")
mu = form["vectors/mu"][:]
problem.numberOfContacts = len(mu)
problem.q, problem.b, problem.mu = form["vectors/f"][:], form["vectors/w"][:], mu
options = sn.SolverOptions(sn.SICONOS_GLOBAL_FRICTION_3D_NSGS_WR)
options.dparam[sn.SICONOS_DPARAM_TOL] = 1e-5
options.iparam[sn.SICONOS_IPARAM_MAX_ITER] = 50000
rows, freedoms = problem.H.shape[1], problem.M.shape[0]
r, u, v = np.zeros(rows), np.zeros(rows), np.zeros(freedoms)
info = sn.gfc3d_driver(problem, r, u, v, options)
print(info, *["%.17g" % value for value in r])
sys.stdout.flush()
os._exit(0)
)";

TEST(Siconos, SolvesTheGlobalFormOfAStep) {
  Scene scene = test::sheared_scene<3>(0.3, 1);
  Sample<3> sample = test::crystal_sample<3>(3, 1.002);
  test::vary_sizes<3>(sample, 0.001, 51);
  test::shake<3>(sample, 0.3, 52, 0.3);
  scene.cd.dt = 4e-3, scene.cd.tolerance = 1e-8, scene.cd.max_sweeps = 20000;
  const auto engine = test::make_engine<3>(EngineKind::cd, scene, sample);
  engine->advance(5);
  const StepProblem step = dynamic_cast<ProblemSource&>(*engine).step_with_problem(ProblemForm::global);
  const test::TemporaryFolder folder;
  write_fclib(folder.file("global.hdf5"), FclibGlobalContent{step.global, step.v, step.u, step.r});
  const std::optional<std::string> said = test::said_by_python("siconos.numerics, scipy.sparse, h5py", script, folder);
  if (!said) GTEST_SKIP() << "python3-siconos, python3-scipy or python3-h5py is not installed";
  std::istringstream text(*said);
  int info = -1;
  text >> info;
  EXPECT_EQ(info, 0) << "Siconos says that it reached its error";
  std::vector<double> r(step.r.size());
  for (double& value : r) text >> value;
  ASSERT_TRUE(text);
  EXPECT_GT(*std::max_element(r.begin(), r.end()), 0);
  const ScaledProblem<3> local(reduced(step.global));
  const auto theirs = local.scaled(r), ours = local.scaled(step.r);
  // Siconos' error counts in the problem's units, relative to the largest of |q|, |r| and |u|; with blocks of W between
  // 1 and 4 the two differ by a factor of a few.
  EXPECT_LT(discrete_error<3>(local, theirs).scaled, 1e-4);
  EXPECT_LT(discrete_error<3>(local, ours).scaled, 1e-7);
}

}  // namespace
}  // namespace galet::cd::siconos_test
