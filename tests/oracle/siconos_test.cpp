// The global form of a step and its solution, as Siconos judges them where this machine has it.
#include <sstream>

#include <gtest/gtest.h>

#include "cd/discrete/fclib.hpp"
#include "cd/discrete/step_problem.hpp"
#include "tests/determinism/sheared.hpp"
#include "tests/support/other_programs.hpp"

namespace galet::cd::siconos_test {
namespace {

/// Prints Siconos' own error of the file's solution of M v = H r + f and u = H^T v + w, and of one with other impulses.
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
solution = h5py.File(sys.argv[1] + "/global.hdf5")["solution"]
r, u, v = solution["r"][:], solution["u"][:], solution["v"][:]
norms = np.linalg.norm(form["vectors/f"][:]), np.linalg.norm(form["vectors/w"][:])
for factor in (1, 1.01):
    print("%.17g" % sn.gfc3d_compute_error(problem, factor * r, u, v, 1e-9, options, *norms)[1])
sys.stdout.flush()
os._exit(0)
)";

TEST(Siconos, FindsTheGlobalFormOfAStepSolved) {
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
  double right = 1, wrong = 0;
  text >> right >> wrong;
  ASSERT_TRUE(text);
  // The step was solved to 1e-8 of its impulses; Siconos adds the misses of both equations and of the laws, in the
  // problem's units, each relative to its terms.
  EXPECT_LT(right, 1e-6);
  EXPECT_GT(wrong, 1e-4) << "impulses that are off by a hundredth";
}

}  // namespace
}  // namespace galet::cd::siconos_test
