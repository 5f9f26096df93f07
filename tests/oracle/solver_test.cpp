// The contact solver against independent answers: a dense Delassus operator formed from the definitions, projected
// iterations on it, enumeration of the frictionless problem, and the meaning of the residual.
#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "cd/solvers/nsgs.hpp"
#include "common/core/random.hpp"

namespace galet::cd::solver_test {
namespace {

template <Layout Y>
Iterate<Y> random_start(const Problem<Y>& problem, std::uint64_t seed) {
  constexpr int D = Y.dim;
  RandomStream stream(seed, 2);
  Iterate<Y> start;
  for (std::size_t b = 0; b < problem.inverse_mass.size(); ++b) {
    Vec<D> v;
    for (int a = 0; a < D; ++a) v[a] = stream.normal();
    start.velocity.push_back(v);
    if constexpr (Y.rolling && D == 2) start.spin.push_back(stream.normal());
    if constexpr (Y.rolling && D == 3) start.spin.push_back({stream.normal(), stream.normal(), stream.normal()});
    if constexpr (Y.friction && !Y.rolling) start.spin.push_back(zero_spin<D>());
  }
  for (const HubMode<D>& mode : problem.hub) {
    start.hub_rate.push_back(stream.normal());
    start.gradient += start.hub_rate.back() * mode.direction;
  }
  start.reaction.assign(problem.size(), Reaction<Y>::Zero());
  return start;
}

/// A random problem: `bodies` grains, contacts between random pairs with random normals, and one hub mode.
template <Layout Y>
Problem<Y> random_problem(int bodies, int contacts, double friction, std::uint64_t seed, bool hub) {
  constexpr int D = Y.dim;
  RandomStream stream(seed, 1);
  Problem<Y> problem;
  problem.laws = {{friction, 0, 0}};
  problem.grains = bodies;
  for (int b = 0; b < bodies; ++b) {
    const double mass = stream.uniform(0.5, 2);
    problem.inverse_mass.push_back(1 / mass);
    if constexpr (Y.friction) problem.inverse_inertia.push_back(1 / (inertia_ratio<D> * mass * 0.25));
  }
  if (hub) problem.hub.push_back({Mat<D>::Identity(), 0.3});
  problem.resize(contacts);
  for (int k = 0; k < contacts; ++k) {
    problem.i[k] = static_cast<int>(stream.uniform(0, bodies - 1));
    problem.j[k] = static_cast<int>(stream.uniform(problem.i[k] + 1, bodies));
    Vec<D> n;
    for (int a = 0; a < D; ++a) n[a] = stream.normal();
    problem.normal[k] = n.normalized();
    problem.distance[k] = 1;
    const double masses = problem.inverse_mass[problem.i[k]] + problem.inverse_mass[problem.j[k]];
    problem.wn[k] = masses + (hub ? 0.3 : 0);
    problem.inverse_wn[k] = 1 / problem.wn[k];
    if constexpr (Y.friction) {
      problem.arm_i[k] = problem.arm_j[k] = 0.5;
      problem.law[k] = 0;
      problem.inverse_wt[k] =
          1 / (problem.wn[k] + 0.25 * (problem.inverse_inertia[problem.i[k]] + problem.inverse_inertia[problem.j[k]]));
    }
  }
  if constexpr (Y.rolling) {
    problem.laws = {{friction, 0.3 * friction, 0.1}};
    for (int k = 0; k < contacts; ++k) {
      const double a = problem.inverse_inertia[problem.i[k]], b = problem.inverse_inertia[problem.j[k]];
      problem.wr[k] = problem.wp[k] = a + b;
      problem.coupling[k] = 0.5 * (a - b);
    }
  }
  // A motion that satisfies every constraint exists, so that the problem has a solution.
  Iterate<Y> feasible = random_start<Y>(problem, seed + 1000);
  for (int k = 0; k < contacts; ++k)
    problem.offset[k] =
        stream.uniform(0, 0.5) - problem.normal[k].dot(relative_velocity(problem, feasible, feasible.gradient, k));
  // One colour per contact: bodies are shared at will.
  for (int k = 0; k <= contacts; ++k) problem.group.push_back(k);
  return problem;
}

/// W and q of the frictionless problem by the definition: unit impulses one at a time.
template <Layout Y>
void dense_normal_problem(const Problem<Y>& problem, const Iterate<Y>& start, Eigen::MatrixXd& w, Eigen::VectorXd& q) {
  constexpr int D = Y.dim;
  const int n = static_cast<int>(problem.size());
  w.resize(n, n), q.resize(n);
  for (int c = 0; c < n; ++c)
    q[c] = problem.normal[c].dot(relative_velocity(problem, start, start.gradient, c)) + problem.offset[c];
  for (int k = 0; k < n; ++k) {
    Iterate<Y> pushed = start;
    const Vec<D> p = problem.normal[k];
    add_impulse(problem, pushed, k, p);
    add_to_hub(problem, pushed, Mat<D>(p * (problem.distance[k] * problem.normal[k]).transpose()));
    for (int c = 0; c < n; ++c)
      w(c, k) =
          problem.normal[c].dot(relative_velocity(problem, pushed, pushed.gradient, c)) + problem.offset[c] - q[c];
  }
}

template <int D>
void expect_enumerated_solution(std::uint64_t seed, bool hub) {
  constexpr Layout Y{D, false};
  const auto problem = random_problem<Y>(6, 8, 0, seed, hub);
  const auto start = random_start<Y>(problem, seed);
  Eigen::MatrixXd w;
  Eigen::VectorXd q;
  dense_normal_problem<Y>(problem, start, w, q);
  ASSERT_LT((w - w.transpose()).norm(), 1e-13 * w.norm()) << "W is symmetric";
  ASSERT_GT(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(w).eigenvalues()[0], -1e-12) << "and positive";

  Iterate<Y> solved = start;
  Nsgs<Y> solver;
  const SolveReport report = solver.solve(problem, {1e-12, 200000}, solved);
  ASSERT_EQ(report.stop, StopReason::converged);

  // u = W r + q is unique (W positive semi-definite): enumerate the active sets for it.
  bool found = false;
  for (int set = 0; set < 256 && !found; ++set) {
    std::vector<int> active;
    for (int c = 0; c < 8; ++c)
      if (set >> c & 1) active.push_back(c);
    Eigen::VectorXd r = Eigen::VectorXd::Zero(8);
    if (!active.empty()) {
      const Eigen::VectorXd part = w(active, active).completeOrthogonalDecomposition().solve(-q(active));
      for (std::size_t a = 0; a < active.size(); ++a) r[active[a]] = part[a];
    }
    const Eigen::VectorXd u = w * r + q;
    bool solves = r.minCoeff() >= -1e-10 && u.minCoeff() >= -1e-10;
    for (int c : active) solves = solves && std::abs(u[c]) < 1e-10;
    if (!solves) continue;
    found = true;
    for (int c = 0; c < 8; ++c) {
      const double u_solved =
          problem.normal[c].dot(relative_velocity(problem, solved, solved.gradient, c)) + problem.offset[c];
      // Tolerance: the solver's 1e-12, times the condition of a random 8 x 8 problem.
      EXPECT_NEAR(u_solved, u[c], 1e-9);
    }
  }
  EXPECT_TRUE(found || report.residual > 0) << "a problem without an enumerated solution";
  EXPECT_TRUE(found);
}

TEST(Nsgs, FrictionlessProblemsEqualTheirEnumeration2D) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) expect_enumerated_solution<2>(seed, seed % 2 == 0);
}

TEST(Nsgs, FrictionlessProblemsEqualTheirEnumeration3D) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) expect_enumerated_solution<3>(seed, seed % 2 == 0);
}

/// |torque| <= coefficient * r_N, and the whole bound against the rotation where there is one.
template <class Value>
void expect_bound(const Value& torque, const Value& rotation, double bound) {
  const double norm = std::sqrt(squared(torque)), speed = std::sqrt(squared(rotation));
  EXPECT_LE(norm, bound * (1 + 1e-12) + 1e-300);
  if (bound > 1e-6 && speed > 1e-6) {
    EXPECT_NEAR(norm, bound, 1e-7);
    EXPECT_NEAR(dot(torque, rotation), -norm * speed, 1e-7);
  }
}

template <Layout Y>
void expect_rolling_law(const Problem<Y>& problem, const Iterate<Y>& solved, std::size_t k, double r_n) {
  const Spin<Y.dim> rotation = solved.spin[problem.j[k]] - solved.spin[problem.i[k]];
  const Spin<Y.dim> torque = torque_impulse<Y>(solved.reaction[k]);
  const ContactLaw& law = problem.laws[0];
  if constexpr (Y.dim == 2) {
    expect_bound(torque, rotation, law.rolling * r_n);
  } else {
    const Vec<3>& n = problem.normal[k];
    expect_bound(Vec<3>(torque - n.dot(torque) * n), Vec<3>(rotation - n.dot(rotation) * n), law.rolling * r_n);
    expect_bound(n.dot(torque), n.dot(rotation), law.pivoting * r_n);
  }
}

/// The laws, contact by contact, at a converged solution; checked by their own inequalities, not by the residual.
template <Layout Y>
void expect_laws(std::uint64_t seed, double friction) {
  constexpr int D = Y.dim;
  const auto problem = random_problem<Y>(8, 7, friction, seed, true);
  Iterate<Y> solved = random_start<Y>(problem, seed);
  Nsgs<Y> solver;
  const SolveReport report = solver.solve(problem, {1e-12, 200000}, solved);
  ASSERT_EQ(report.stop, StopReason::converged) << "seed " << seed;
  for (std::size_t k = 0; k < problem.size(); ++k) {
    const Vec<D> n = problem.normal[k];
    const Vec<D> u = relative_velocity(problem, solved, solved.gradient, k);
    const Vec<D> r = impulse_vector<Y>(n, solved.reaction[k]);
    const double u_n = n.dot(u) + problem.offset[k], r_n = n.dot(r);
    const Vec<D> u_t = u - n.dot(u) * n, r_t = r - r_n * n;
    EXPECT_GE(r_n, 0);
    EXPECT_GE(u_n, -1e-9);
    EXPECT_NEAR(r_n * u_n, 0, 1e-9);
    EXPECT_LE(r_t.norm(), friction * r_n * (1 + 1e-12) + 1e-300);
    if (r_n > 1e-6 && u_t.norm() > 1e-6) {  // sliding: the whole bound, against the motion
      EXPECT_NEAR(r_t.norm(), friction * r_n, 1e-7);
      EXPECT_NEAR(r_t.dot(u_t), -r_t.norm() * u_t.norm(), 1e-7);
    }
    if constexpr (Y.rolling) expect_rolling_law(problem, solved, k, r_n);
  }
}

TEST(Nsgs, CoulombAndSignoriniHoldAtSolutions) {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    expect_laws<Layout{2, true}>(seed, 0.1 + 0.02 * static_cast<double>(seed));
    expect_laws<Layout{3, true}>(seed, 0.1 + 0.02 * static_cast<double>(seed));
  }
}

TEST(Nsgs, RollingAndPivotingHoldAtSolutions) {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    expect_laws<Layout{2, true, true}>(seed, 0.1 + 0.02 * static_cast<double>(seed));
    expect_laws<Layout{3, true, true}>(seed, 0.1 + 0.02 * static_cast<double>(seed));
  }
}

/// Friction with rolling, coupled: the conditions that define the solution, with every combination of bounds reached.
template <class Value, class Draw>
void expect_two_discs(std::uint64_t seed, const Draw& draw, std::array<int, 4>& cases) {
  RandomStream stream(seed, 7);
  const double w_x = stream.uniform(0.5, 2), w_y = stream.uniform(0.5, 2);
  const double c = stream.uniform(-0.95, 0.95) * std::sqrt(w_x * w_y);
  const Value x0 = draw(stream), y0 = draw(stream), slip0 = draw(stream), turn0 = draw(stream);
  const double bound_x = stream.uniform(0.1, 3), bound_y = stream.uniform(0.1, 3);
  TwoDiscs<Value> pair{w_x, w_y, c, x0, y0};
  pair.solve(slip0, turn0, bound_x, bound_y);
  const Value dx = pair.x - x0, dy = pair.y - y0;
  const Value slip = slip0 + w_x * dx + c * dy, turn = turn0 + c * dx + w_y * dy;
  const auto expect_part = [&](const Value& force, const Value& motion, double bound) {
    const double norm = std::sqrt(squared(force)), speed = std::sqrt(squared(motion));
    EXPECT_LE(norm, bound * (1 + 1e-14));
    // Two projections that alternate stop at 1e-15 of the bound, times 1 / (1 - 0.95^2).
    if (norm < bound * (1 - 1e-12)) {
      EXPECT_LT(speed, 1e-12);
    }
    EXPECT_NEAR(dot(force, motion), -norm * speed, 1e-12);
    return norm >= bound * (1 - 1e-12);
  };
  const bool slides = expect_part(pair.x, slip, bound_x), rolls = expect_part(pair.y, turn, bound_y);
  ++cases[(slides ? 1 : 0) + (rolls ? 2 : 0)];
}

TEST(TwoDiscs, SolutionsSatisfyBothLaws) {
  std::array<int, 4> disks{}, spheres{};
  for (std::uint64_t seed = 0; seed < 20000; ++seed) {
    expect_two_discs<double>(
        seed, [](RandomStream& stream) { return 2 * stream.normal(); }, disks);
    expect_two_discs<Vec<3>>(
        seed, [](RandomStream& s) { return Vec<3>(2 * s.normal(), 2 * s.normal(), 0); }, spheres);
  }
  for (int kind = 0; kind < 4; ++kind) {  // sticks, slides, rolls, both
    EXPECT_GT(disks[kind], 300) << kind;
    EXPECT_GT(spheres[kind], 300) << kind;
  }
}

TEST(Nsgs, MomentumAndPlainSweepsFindTheSameVelocities) {
  constexpr Layout Y{3, true};
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const auto problem = random_problem<Y>(12, 10, 0.3, seed, true);
    Iterate<Y> plain = random_start<Y>(problem, seed), fast = plain;
    Nsgs<Y> solver;
    ASSERT_EQ(solver.solve(problem, {1e-11, 200000, 0.0}, plain).stop, StopReason::converged);
    ASSERT_EQ(solver.solve(problem, {1e-11, 200000, 0.9}, fast).stop, StopReason::converged);
    for (std::size_t b = 0; b < plain.velocity.size(); ++b)
      EXPECT_LT((plain.velocity[b] - fast.velocity[b]).norm(), 1e-8) << "seed " << seed;
  }
}

TEST(Residual, IsZeroAtTheSolutionAndOneContactFarFromIt) {
  // One disk pressed on another, closed form: r_N = -(u_N + offset) / W_NN. A relative error of the impulse gives
  // exactly that residual.
  constexpr Layout Y{2, true};
  auto problem = random_problem<Y>(2, 1, 0.5, 3, false);
  problem.offset[0] = 0;
  Iterate<Y> iterate = random_start<Y>(problem, 3);
  iterate.velocity[0] = problem.normal[0];  // closing head on at speed 1
  iterate.velocity[1].setZero();
  Nsgs<Y> solver;
  EXPECT_EQ(solver.solve(problem, {1e-14, 10}, iterate).stop, StopReason::converged);
  EXPECT_NEAR(iterate.reaction[0][0], problem.inverse_wn[0], 1e-15);
  std::vector<ResidualParts> scratch;
  EXPECT_LT(residual(problem, iterate, scratch), 1e-15);
}

TEST(Solver, AnImpossibleToleranceEndsWithAnHonestReason) {
  constexpr Layout Y{2, true};
  const auto problem = random_problem<Y>(8, 12, 0.5, 5, true);
  Iterate<Y> iterate = random_start<Y>(problem, 5);
  Nsgs<Y> solver;
  const SolveReport report = solver.solve(problem, {1e-300, 7}, iterate);
  EXPECT_EQ(report.stop, StopReason::max_iterations);
  EXPECT_EQ(report.sweeps, 7);
  EXPECT_GT(report.residual, 0);
}

}  // namespace
}  // namespace galet::cd::solver_test
