// Second-order methods on the bodies: their linear systems against dense ones, their answers against those of the
// methods that factorise W.
#include "cd/discrete/body_matrix.hpp"

#include <random>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "cd/discrete/solve.hpp"
#include "cd/discrete/step_problem.hpp"
#include "tests/support/lattices.hpp"
#include "tests/support/scenes.hpp"

namespace galet::cd::body_matrix_test {
namespace {

enum class Mass { diagonal, coupled, gyroscopic };

/// Contacts of numbers of neighbouring bodies in a ring, 6 freedoms each; f and w so that many contacts close.
GlobalProblem random_bodies(int block, int contacts, int bodies, double mu, Mass kind, std::mt19937& random) {
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform(0, 1);
  const int freedoms = 6 * bodies, rows = block * contacts;
  Eigen::MatrixXd mass = Eigen::MatrixXd::Zero(freedoms, freedoms), h = Eigen::MatrixXd::Zero(freedoms, rows);
  for (int a = 0; a < freedoms; ++a) mass(a, a) = std::pow(10, uniform(random));
  if (kind != Mass::diagonal)
    for (int a = 1; a < freedoms; ++a) mass(a, a - 1) = mass(a - 1, a) = 0.3;
  if (kind == Mass::gyroscopic)
    for (int a = 1; a < freedoms; ++a) mass(a, a - 1) += 0.1, mass(a - 1, a) -= 0.1;
  for (int c = 0; c < contacts; ++c)
    for (const int body : {c % bodies, (c + 1) % bodies})
      for (int a = 0; a < 6 * block; ++a) h(6 * body + a % 6, block * c + a / 6) = normal(random);
  GlobalProblem problem;
  problem.block = block;
  problem.mass = mass.sparseView(), problem.jacobian = h.sparseView();
  for (int a = 0; a < freedoms; ++a) problem.f.push_back(normal(random));
  problem.w.assign(rows, 0.0);
  problem.mu.assign(contacts, mu);
  if (block == 5) problem.mu_r.assign(contacts, 0.3 * mu);
  return problem;
}

template <int B>
Eigen::MatrixXd dense_operator(const ScaledProblem<B>& problem, const Eigen::MatrixXd& left) {
  Eigen::MatrixXd w = Eigen::MatrixXd::Zero(left.rows(), left.cols());
  for (int c = 0; c < problem.size(); ++c) {
    w.block<B, B>(B * c, B * c) = problem.own[c];
    for (int k = problem.first[c]; k < problem.first[c + 1]; ++k)
      w.block<B, B>(B * c, B * problem.neighbour[k]) = problem.block[k];
  }
  return left * w;
}

/// D W + A against a dense factorisation. `decades`: how far A reaches.
template <int B>
void check_solutions(Mass kind, bool symmetric, double decades) {
  std::mt19937 random(static_cast<unsigned>(10 * B + symmetric));
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform(-1, 1);
  const GlobalProblem bodies = random_bodies(B, 20, 4, 0.5, kind, random);  // 20 B numbers, 24 freedoms: W is singular
  const ScaledProblem<B> problem(reduced(bodies));
  BodyMatrix<B> matrix(problem, bodies);
  using Block = typename ScaledProblem<B>::Block;
  std::vector<Block> left, added;
  const int rows = B * problem.size();
  Eigen::MatrixXd d = Eigen::MatrixXd::Zero(rows, rows), a = d;
  for (int c = 0; c < problem.size(); ++c) {
    Block some;
    for (int k = 0; k < B * B; ++k) some.data()[k] = normal(random);
    left.push_back(some * some.transpose());
    if (!symmetric) left.back().row(0) += 0.3 * some.row(1);
    added.push_back(std::pow(10, decades * uniform(random)) * Block::Identity());
    d.block<B, B>(B * c, B * c) = left.back(), a.block<B, B>(B * c, B * c) = added.back();
  }
  const Eigen::VectorXd right = Eigen::VectorXd::NullaryExpr(rows, [&] { return normal(random); });
  ASSERT_TRUE(matrix.factorise(left, added));
  const Eigen::MatrixXd full = dense_operator<B>(problem, d) + a;
  // Rounding times the condition, which is below 1e3 times the reach of A.
  const double tolerance = 1e-11 * std::pow(10, 2 * decades);
  const Eigen::VectorXd x = full.fullPivLu().solve(right);
  EXPECT_LT((matrix.solve(right) - x).norm(), tolerance * x.norm());
  // W + E with the same factorisation's pattern.
  ASSERT_TRUE(matrix.factorise(added));
  const Eigen::VectorXd y =
      (dense_operator<B>(problem, Eigen::MatrixXd::Identity(rows, rows)) + a).fullPivLu().solve(right);
  EXPECT_LT((matrix.solve(right) - y).norm(), tolerance * y.norm());
}

TEST(BodyMatrix, SolvesWhatADenseMatrixSolves) {
  for (const Mass kind : {Mass::diagonal, Mass::coupled, Mass::gyroscopic})
    for (const bool symmetric : {true, false}) {
      check_solutions<2>(kind, symmetric, 0);
      check_solutions<3>(kind, symmetric, 0);
      check_solutions<5>(kind, symmetric, 0);
      check_solutions<3>(kind, symmetric, 2);
    }
}

TEST(BodyMatrix, MethodsOnBodiesAgreeWithThoseOnContacts) {
  std::mt19937 random(7);
  for (const int block : {2, 3, 5})
    for (const Mass kind : {Mass::diagonal, Mass::coupled}) {
      // Fewer numbers than freedoms and little friction: one solution.
      const GlobalProblem bodies = random_bodies(block, 4, 6, 0.1, kind, random);
      const DiscreteProblem problem = reduced(bodies);
      for (const char* name : {"newton", "newton-frozen", "ipm"}) {
        DiscreteOptions options;
        // Interior points end short of rounding: on 30 problems like these those on contacts at 6e-15 to 2.4e-7, those
        // on bodies at 1e-13 to 9e-7; the last digits follow the BLAS library.
        options.error = name[0] == 'i' ? 1e-6 : 1e-10;
        options.solver = name;
        const DiscreteSolution on_contacts = solve(problem, options);
        options.solver += "-bodies";
        const DiscreteSolution on_bodies = solve(problem, options, &bodies);
        EXPECT_TRUE(on_contacts.converged) << name << ' ' << block << ' ' << on_contacts.error;
        EXPECT_TRUE(on_bodies.converged) << name << ' ' << block << ' ' << on_bodies.error;
        double size = 0;
        for (const double r : on_contacts.r) size = std::max(size, std::abs(r));
        EXPECT_GT(size, 0);
        for (std::size_t a = 0; a < problem.q.size(); ++a)
          EXPECT_NEAR(on_bodies.r[a], on_contacts.r[a], 100 * options.error * size) << name;
      }
    }
}

/// Far more numbers than freedoms: forces are not unique, and without friction motions still are.
TEST(BodyMatrix, HyperstaticContactsNeedNoCare) {
  std::mt19937 random(8);
  for (const int block : {2, 3, 5})
    for (const double mu : {0.0, 0.1}) {
      const GlobalProblem bodies = random_bodies(block, 30, 3, mu, Mass::diagonal, random);
      const DiscreteProblem problem = reduced(bodies);
      DiscreteOptions options;
      options.error = 1e-10;
      options.solver = "pgs-frozen";
      const DiscreteSolution other = solve(problem, options);
      ASSERT_TRUE(mu > 0 || other.converged);
      for (const char* name : {"newton-bodies", "newton-frozen-bodies"}) {
        options.solver = name;
        const DiscreteSolution solution = solve(problem, options, &bodies);
        EXPECT_TRUE(solution.converged) << name << " block " << block << " mu " << mu << " errS " << solution.error;
        // errS times the norm of q, times the condition.
        for (int c = 0; c < problem.contacts() && mu == 0; ++c)
          EXPECT_NEAR(solution.u[block * c], other.u[block * c], 1e-7) << name;
      }
    }
}

TEST(BodyMatrix, StepsOfAStressDrivenCellAreSolved) {
  Scene scene = test::sheared_scene<2>(0.3, 1);
  Sample<2> sample = test::crystal_sample<2>(6, 1.002);
  test::vary_sizes<2>(sample, 0.001, 51);
  test::shake<2>(sample, 0.3, 52, 0.3);
  scene.cd.dt = 4e-3;
  const auto engine = test::make_engine<2>(EngineKind::cd, scene, sample);
  engine->advance(5);
  const StepProblem step = dynamic_cast<ProblemSource&>(*engine).step_with_problem(ProblemForm::global);
  EXPECT_NEAR(step.gap_time, 4e-3, 1e-15);
  DiscreteOptions options;
  options.solver = "newton-bodies";
  const DiscreteSolution solution = solve(reduced(step.global), options, &step.global);
  EXPECT_TRUE(solution.converged) << solution.error;
}

TEST(BodyMatrix, BodiesAreAskedFor) {
  std::mt19937 random(9);
  const GlobalProblem bodies = random_bodies(3, 4, 6, 0.1, Mass::diagonal, random),
                      others = random_bodies(3, 5, 6, 0.1, Mass::diagonal, random);
  DiscreteOptions options;
  options.solver = "ipm-bodies";
  EXPECT_THROW(solve(reduced(bodies), options), std::invalid_argument);
  EXPECT_THROW(solve(reduced(bodies), options, &others), std::invalid_argument);
  EXPECT_TRUE(needs_bodies("ipm-bodies"));
  EXPECT_FALSE(needs_bodies("ipm"));
}

}  // namespace
}  // namespace galet::cd::body_matrix_test
