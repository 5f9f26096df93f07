// Problems of cd in the discrete form: W against unit impulses that go through the matrix-free operator one at a
// time, q against the motion without reactions, and cd's impulses as solutions by the error of the discrete problem.
#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "cd/discrete/discrete_form.hpp"
#include "cd/discrete/solve.hpp"
#include "cd/solvers/nsgs.hpp"
#include "common/core/random.hpp"
#include "tests/determinism/sheared.hpp"
#include "tests/support/rigid_laws.hpp"

namespace galet::cd::step_problem_test {
namespace {

template <int D>
Vec<D> random_vector(RandomStream& stream) {
  Vec<D> v;
  for (int a = 0; a < D; ++a) v[a] = stream.normal();
  return v;
}

template <int D>
Spin<D> random_spin(RandomStream& stream) {
  if constexpr (D == 2)
    return stream.normal();
  else
    return random_vector<3>(stream);
}

/// Velocities and spins of the grains, rates of the hub; planes rest.
template <Layout Y>
Iterate<Y> random_motion(const Problem<Y>& problem, std::uint64_t seed) {
  constexpr int D = Y.dim;
  RandomStream stream(seed, 2);
  Iterate<Y> motion;
  for (std::size_t b = 0; b < problem.inverse_mass.size(); ++b) {
    const bool grain = static_cast<int>(b) < problem.grains;
    motion.velocity.push_back(grain ? random_vector<D>(stream) : Vec<D>(Vec<D>::Zero()));
    if constexpr (Y.friction) motion.spin.push_back(grain ? random_spin<D>(stream) : zero_spin<D>());
  }
  for (const HubMode<D>& mode : problem.hub) {
    motion.hub_rate.push_back(stream.normal());
    motion.gradient += motion.hub_rate.back() * mode.direction;
  }
  motion.reaction.assign(problem.size(), Reaction<Y>::Zero());
  return motion;
}

/// Eight grains of unlike masses, a plane that forces move along its normal and one that they don't; contacts between
/// random bodies, one of a grain with its own image, one that nothing can move; lag, and by choice a stress-driven cell
/// and compliance.
template <Layout Y>
Problem<Y> random_problem(std::uint64_t seed, bool hub, bool compliant) {
  constexpr int D = Y.dim;
  constexpr int grains = 8, contacts = 14;
  RandomStream stream(seed, 1);
  Problem<Y> problem;
  problem.laws = {{Y.friction ? 0.4 : 0, Y.rolling ? 0.1 : 0, 0}, {Y.friction ? 0.2 : 0, Y.rolling ? 0.05 : 0, 0}};
  problem.grains = grains;
  problem.inverse_mass.assign(grains + 2, 0), problem.inverse_inertia.assign(grains + 2, 0);
  for (int b = 0; b < grains; ++b) {
    problem.inverse_mass[b] = 1 / stream.uniform(0.5, 2);
    if constexpr (Y.friction) problem.inverse_inertia[b] = problem.inverse_mass[b] / (inertia_ratio<D> * 0.25);
  }
  const Vec<D> along = random_vector<D>(stream).normalized();
  problem.mobility = {0.7 * along * along.transpose(), Mat<D>::Zero()};
  if (hub) problem.hub = {{Mat<D>::Identity(), 0.3}, {Vec<D>::Unit(0) * Vec<D>::Unit(1).transpose(), 0.2}};
  problem.compliant = compliant, problem.lagged = Y.friction;
  problem.resize(contacts);
  Iterate<Y> feasible = random_motion(problem, seed + 1000);
  for (int k = 0; k < contacts; ++k) {
    problem.i[k] = k == 0 ? 3 : k % grains;
    problem.j[k] = k == 0 ? 3 : k < 10 ? (k + 1 + k / 4) % grains : k < 13 ? grains : grains + 1;
    if (k > 0 && problem.i[k] == problem.j[k]) problem.j[k] = (problem.j[k] + 1) % grains;
    const Vec<D>& n = problem.normal[k] = k > 9 && k < 13 ? Vec<D>(-along) : random_vector<D>(stream).normalized();
    const int i = problem.i[k], j = problem.j[k];
    problem.distance[k] = stream.uniform(0.8, 1.2);
    double w = i == j ? 0 : problem.inverse_mass[i] + problem.inverse_mass[j];
    if (j == grains) w += 0.7;
    for (const HubMode<D>& mode : problem.hub)
      w += mode.inverse_inertia * (problem.distance[k] * (mode.direction * n)).squaredNorm();
    if (compliant) problem.compliance[k] = {0.5, 0.4, 0.6, 0};
    const double wn = w + (compliant ? 0.5 : 0);
    problem.wn[k] = wn, problem.inverse_wn[k] = wn > 0 ? 1 / wn : 0;
    if constexpr (Y.friction) {
      problem.law[k] = static_cast<std::uint8_t>(k % 2);
      const double arm_i = problem.arm_i[k] = 0.5, arm_j = problem.arm_j[k] = j < grains ? 0.45 : 0;
      const double inverse_i = problem.inverse_inertia[i], inverse_j = problem.inverse_inertia[j];
      const double turning = i == j ? (arm_i + arm_j) * (arm_i + arm_j) * inverse_i
                                    : arm_i * arm_i * inverse_i + arm_j * arm_j * inverse_j;
      problem.inverse_wt[k] = 1 / (w + turning + (compliant ? 0.4 : 0));
      Components<Y> lag;
      if constexpr (D == 2) lag.tangential = 0.1 * stream.normal();
      if constexpr (D == 3) {
        lag.tangential = 0.1 * random_vector<3>(stream);
        lag.tangential -= n.dot(lag.tangential) * n;
      }
      problem.lag[k] = composed<Y>(n, lag);
      if constexpr (Y.rolling) {
        problem.wr[k] = problem.wp[k] = (i == j ? 0 : inverse_i + inverse_j) + (compliant ? 0.6 : 0);
        problem.coupling[k] = i == j ? 0 : arm_i * inverse_i - arm_j * inverse_j;
      }
    }
    // A motion that closes no contact exists, so that the problem has a solution.
    problem.offset[k] = stream.uniform(0, 0.5) - n.dot(relative_velocity(problem, feasible, feasible.gradient, k));
  }
  for (int k = 0; k <= contacts; ++k) problem.group.push_back(k);
  return problem;
}

/// The same with a rigid body that turns, and contacts of it with three grains and with the plane that moves.
template <Layout Y>
Problem<Y> with_turning_body(Problem<Y> problem, std::uint64_t seed) {
  constexpr int D = Y.dim;
  constexpr int more = 4;
  RandomStream stream(seed, 3);
  const int body = problem.grains + 2, first = static_cast<int>(problem.size());
  problem.inverse_mass.push_back(0), problem.inverse_inertia.push_back(0);
  Vec<D> mobility = Vec<D>::Constant(0.8);
  mobility[1] = 0;  // its velocity along y is imposed
  problem.mobility.push_back(mobility.asDiagonal());
  problem.turning.assign(3, zero_map<D>());
  if constexpr (D == 2) {
    problem.turning[2] = 1.7;
  } else {
    Mat<3> root;
    for (int a = 0; a < 3; ++a) root.col(a) = random_vector<3>(stream);
    problem.turning[2] = root * root.transpose();
  }
  problem.resize(first + more);
  problem.first_turning = first;
  problem.bent.resize(more);
  for (int k = first; k < first + more; ++k) {
    problem.i[k] = k == first + 3 ? body : k - first;
    problem.j[k] = k == first + 3 ? problem.grains : body;
    const Vec<D>& n = problem.normal[k] = random_vector<D>(stream).normalized();
    problem.distance[k] = 1, problem.law[k] = 0, problem.arm_i[k] = problem.arm_j[k] = 0;
    TurningContact<Y>& bent = problem.bent[k - first];
    bent.lever_i = k == first + 3 ? random_vector<D>(stream) : Vec<D>(0.5 * n);
    bent.lever_j = k == first + 3 ? Vec<D>(Vec<D>::Zero()) : random_vector<D>(stream);
    problem.lag[k].setZero();
    if (problem.compliant) problem.compliance[k] = {0.5, 0.4, Y.rolling ? 0.6 : 0, 0};
    // The block by unit impulses. The hub's share is left out: it only steers the solver.
    Iterate<Y> rest;
    rest.velocity.assign(body + 1, Vec<D>::Zero()), rest.spin.assign(body + 1, zero_spin<D>());
    const auto tangents = across<D>(n);
    for (int a = 0; a < block_size(Y); ++a) {
      Iterate<Y> pushed = rest;
      Mat<D> virial = Mat<D>::Zero();
      add_reaction(problem, pushed, k, composed<Y>(n, from_frame<Y>(tangents, Reaction<Y>::Unit(a))), virial);
      bent.w.col(a) = in_frame<Y>(tangents, relative_motion(problem, pushed, rest.gradient, k));
    }
    if (problem.compliant) {
      bent.w.diagonal().template head<D>().array() += 0.4;
      bent.w(0, 0) += 0.1;
      if constexpr (Y.rolling) bent.w.diagonal().template segment<D - 1>(D).array() += 0.6;
    }
    problem.wn[k] = bent.w(0, 0), problem.inverse_wn[k] = 1 / problem.wn[k];
    problem.inverse_wt[k] = (D - 1) / bent.w.diagonal().template segment<D - 1>(1).sum();
    if constexpr (Y.rolling) {
      problem.wr[k] = problem.wp[k] = bent.w.diagonal().template segment<D - 1>(D).mean();
      problem.coupling[k] = 0;
    }
    problem.offset[k] = stream.uniform(-2, -1);
    problem.group.push_back(k + 1);
  }
  return problem;
}

/// Row of the discrete block that holds direction `a` of the contact's own components; -1: none.
template <Layout Y>
std::vector<int> rows_of_directions() {
  if (!Y.friction) return {0};
  if (Y.dim == 2) return Y.rolling ? std::vector<int>{0, 1, 3} : std::vector<int>{0, 1};
  return Y.rolling ? std::vector<int>{0, 1, 2, 3, 4} : std::vector<int>{0, 1, 2};
}

template <Layout Y>
Components<Y> unit_component(const Vec<Y.dim>& n, int row) {
  Components<Y> unit;
  if (row == 0) unit.normal = 1;
  if constexpr (Y.friction && Y.dim == 2) {
    if (row == 1) unit.tangential = 1;
    if (row == 3) unit.rolling = 1;
  }
  if constexpr (Y.friction && Y.dim == 3) {
    const Vec<3> t1 = n.unitOrthogonal(), t2 = n.cross(t1);
    if (row == 1 || row == 2) unit.tangential = row == 1 ? t1 : t2;
    if (row == 3 || row == 4) unit.rolling = row == 3 ? t1 : t2;
  }
  return unit;
}

template <Layout Y>
double along(const Components<Y>& unit, const Components<Y>& motion) {
  return unit.normal * motion.normal + dot(unit.tangential, motion.tangential) + dot(unit.rolling, motion.rolling);
}

Eigen::MatrixXd dense(const DiscreteProblem& problem) {
  Eigen::MatrixXd w = Eigen::MatrixXd::Zero(problem.rows(), problem.rows());
  for (int a = 0; a < problem.rows(); ++a)
    for (std::int64_t e = problem.start[a]; e < problem.start[a + 1]; ++e) w(a, problem.column[e]) = problem.value[e];
  return w;
}

/// Contacts that something can move, in order.
template <Layout Y>
std::vector<std::size_t> kept(const Problem<Y>& problem) {
  std::vector<std::size_t> contacts;
  for (std::size_t k = 0; k < problem.size(); ++k)
    if (problem.wn[k] > 0) contacts.push_back(k);
  return contacts;
}

template <Layout Y>
void expect_operator(const Problem<Y>& problem, const Iterate<Y>& free, const DiscreteProblem& discrete) {
  const int block = discrete.block;
  const auto contacts = kept(problem);
  const auto rows = rows_of_directions<Y>();
  ASSERT_EQ(static_cast<std::size_t>(discrete.contacts()), contacts.size());
  const Eigen::MatrixXd w = dense(discrete);
  EXPECT_EQ((w - w.transpose()).norm(), 0) << "W is symmetric to the last bit";
  Iterate<Y> rest = free;
  for (auto& v : rest.velocity) v.setZero();
  if constexpr (Y.friction)
    for (auto& spin : rest.spin) spin = zero_spin<Y.dim>();
  rest.gradient.setZero();
  double worst = 0;
  for (std::size_t d = 0; d < contacts.size(); ++d)
    for (const int b : rows) {
      Iterate<Y> pushed = rest;
      const Vec<Y.dim>& n = problem.normal[contacts[d]];
      const Components<Y> unit = unit_component<Y>(n, b);
      Mat<Y.dim> virial = Mat<Y.dim>::Zero();
      add_reaction(problem, pushed, contacts[d], composed<Y>(n, unit), virial);
      add_to_hub(problem, pushed, virial);
      for (std::size_t c = 0; c < contacts.size(); ++c) {
        const std::size_t k = contacts[c];
        const Components<Y> r = c == d ? unit : Components<Y>{};
        // Without offset and lag: they are the same in both.
        Components<Y> motion = law_motion(problem, pushed, pushed.gradient, k, r);
        const Components<Y> none = law_motion(problem, rest, rest.gradient, k, Components<Y>{});
        motion.normal -= none.normal, motion.tangential -= none.tangential, motion.rolling -= none.rolling;
        for (const int a : rows)
          worst = std::max(worst, std::abs(along<Y>(unit_component<Y>(problem.normal[k], a), motion) -
                                           w(block * static_cast<int>(c) + a, block * static_cast<int>(d) + b)));
      }
    }
  EXPECT_LT(worst, 1e-13 * w.norm()) << "sums of a few products: rounding";
  for (std::size_t c = 0; c < contacts.size(); ++c)
    for (const int a : rows) {
      const std::size_t k = contacts[c];
      const Components<Y> motion = law_motion(problem, free, free.gradient, k, Components<Y>{});
      EXPECT_NEAR(discrete.q[static_cast<std::size_t>(block) * c + static_cast<std::size_t>(a)],
                  along<Y>(unit_component<Y>(problem.normal[k], a), motion), 1e-13);
    }
}

/// The normal part of the projection of (z, parts) on {norm_b <= mu_b s}: where the derivative of the squared distance,
/// which rises with s, is zero, by bisection.
double projected(double z, const std::array<double, 2>& norms, const std::array<double, 2>& mu) {
  const auto slope = [&](double s) {
    double sum = s - z;
    for (int b = 0; b < 2; ++b) sum -= mu[b] * std::max(0.0, norms[b] - mu[b] * s);
    return sum;
  };
  if (slope(0) >= 0) return 0;
  double low = 0, high = std::abs(z) + norms[0] * mu[0] + norms[1] * mu[1];
  for (int round = 0; round < 200; ++round) {
    const double middle = 0.5 * (low + high);
    (slope(middle) < 0 ? low : high) = middle;
  }
  return high;
}

/// errS: the natural map |r - P_K(r - u^)| / max(|q|, |r|, |u|) with each contact scaled to a block of unit mean
/// diagonal, rolling apart; u^ = u + (mu |u_T| + mu_R |u_R|) e_N.
double error_of(const StepProblem& step) {
  const DiscreteProblem& problem = step.problem;
  const Eigen::MatrixXd w = dense(problem);
  const int block = problem.block, moved = block == 5 ? 3 : block;
  double map = 0, r_square = 0, u_square = 0, q_square = 0;
  for (int c = 0; c < problem.contacts(); ++c) {
    const Eigen::MatrixXd own = w.block(block * c, block * c, block, block);
    Eigen::VectorXd scale(block);
    scale.head(moved).setConstant(std::sqrt(moved / own.topLeftCorner(moved, moved).trace()));
    const double turning = own.diagonal().tail(block - moved).sum();  // zero between a grain and its own image
    scale.tail(block - moved).setConstant(turning > 0 ? std::sqrt(2 / turning) : 1);
    const auto part = [&](const std::vector<double>& all) {
      return Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(all.data() + block * c, block));
    };
    const Eigen::VectorXd r = part(step.r).cwiseQuotient(scale);
    Eigen::VectorXd u = part(step.u).cwiseProduct(scale);
    r_square += r.squaredNorm(), u_square += u.squaredNorm();
    q_square += part(problem.q).cwiseProduct(scale).squaredNorm();
    const std::array<double, 2> mu{problem.mu[c], block == 5 ? problem.mu_r[c] * scale[0] / scale[4] : 0};
    u[0] += mu[0] * u.segment(1, moved - 1).norm() + mu[1] * u.tail(block - moved).norm();
    Eigen::VectorXd z = r - u;
    const std::array<double, 2> norms{z.segment(1, moved - 1).norm(), z.tail(block - moved).norm()};
    z[0] = projected(z[0], norms, mu);
    if (norms[0] > mu[0] * z[0]) z.segment(1, moved - 1) *= mu[0] * z[0] / norms[0];
    if (norms[1] > mu[1] * z[0]) z.tail(block - moved) *= mu[1] * z[0] / norms[1];
    map += (r - z).squaredNorm();
  }
  return std::sqrt(map / std::max({r_square, u_square, q_square}));
}

void expect_solution(const StepProblem& step, double error) {
  ASSERT_TRUE(mistakes_of(step.problem).empty()) << mistakes_of(step.problem).front();
  EXPECT_LT(error_of(step), error);
  const Eigen::Index rows = step.problem.rows();
  const auto vector = [&](const std::vector<double>& all) {
    return Eigen::Map<const Eigen::VectorXd>(all.data(), rows);
  };
  const Eigen::VectorXd u = dense(step.problem) * vector(step.r) + vector(step.problem.q);
  EXPECT_LT((u - vector(step.u)).norm(), 1e-13 * (u.norm() + vector(step.problem.q).norm())) << "u = W r + q";
}

/// The global form says the same as the local one: its reduction, its equations of motion, and (where `solved`) its
/// answer.
void expect_global(const StepProblem& local, const StepProblem& global, bool solved) {
  const DiscreteProblem back = reduced(global.global);
  const Eigen::MatrixXd w = dense(local.problem);
  ASSERT_EQ(back.block, local.problem.block);
  ASSERT_EQ(back.q.size(), local.problem.q.size());
  EXPECT_EQ(back.mu, local.problem.mu);
  EXPECT_EQ(back.mu_r, local.problem.mu_r);
  const auto vector = [](const std::vector<double>& all) {
    return Eigen::VectorXd(Eigen::VectorXd::Map(all.data(), static_cast<Eigen::Index>(all.size())));
  };
  // Sums of a few products, of mobilities that eigenvalues are found of: rounding.
  EXPECT_LT((dense(back) - w).norm(), 1e-13 * w.norm());
  EXPECT_LT((vector(back.q) - vector(local.problem.q)).norm(), 1e-13 * (1 + vector(local.problem.q).norm()));
  EXPECT_EQ(global.r, local.r);
  EXPECT_LT((vector(global.u) - vector(local.u)).norm(), 1e-12 * (vector(local.u).norm() + w.norm()));
  const GlobalProblem& problem = global.global;
  const Eigen::VectorXd miss =
      problem.mass * vector(global.v) - problem.jacobian * vector(global.r) - vector(problem.f);
  EXPECT_LT(miss.norm(), 1e-13 * (problem.mass.norm() + 1) * (vector(global.v).norm() + 1));
  if (!solved) return;
  // An answer to one is an answer to the other.
  DiscreteOptions options;
  options.error = 1e-9;
  const DiscreteSolution solution = solve(back, options);
  ASSERT_TRUE(solution.converged) << solution.error;
  StepProblem swapped = local;
  swapped.r = solution.r, swapped.u = solution.u;
  EXPECT_LT(error_of(swapped), 1.01e-9 + 1e-12);
}

template <Layout Y>
void check_layout() {
  for (const bool hub : {false, true})
    for (const bool compliant : {false, true}) {
      SCOPED_TRACE(to_string(Y) + (hub ? ", hub" : "") + (compliant ? ", compliant" : ""));
      const Problem<Y> problem = random_problem<Y>(3, hub, compliant);
      const Iterate<Y> free = random_motion(problem, 7);
      Iterate<Y> solved = free;
      Nsgs<Y> solver;
      ASSERT_EQ(solver.solve(problem, {1e-12, 400000}, solved).stop, StopReason::converged);
      const StepProblem step = DiscreteForm<Y>::of(problem, free, solved.reaction);
      EXPECT_GT(*std::max_element(step.r.begin(), step.r.end()), 0.1) << "some contacts bear impulses";
      expect_operator(problem, free, step.problem);
      // The residual of cd (relative to impulses) at 1e-12 and errS measure the same map in other scales.
      expect_solution(step, 1e-9);
      expect_global(step, DiscreteForm<Y>::of(problem, free, solved.reaction, ProblemForm::global), true);
    }
}

template <Layout Y>
void check_turning() {
  for (const bool hub : {false, true})
    for (const bool compliant : {false, true}) {
      SCOPED_TRACE(to_string(Y) + " and a body that turns" + (hub ? ", hub" : "") + (compliant ? ", compliant" : ""));
      const Problem<Y> problem = with_turning_body(random_problem<Y>(3, hub, compliant), 5);
      const Iterate<Y> free = random_motion(problem, 7);
      Iterate<Y> solved = free;
      Nsgs<Y> solver;
      ASSERT_EQ(solver.solve(problem, {1e-12, 400000}, solved).stop, StopReason::converged);
      const StepProblem step = DiscreteForm<Y>::of(problem, free, solved.reaction);
      double turning = 0;
      for (std::size_t k = problem.first_turning; k < problem.size(); ++k)
        turning = std::max(turning, solved.reaction[k].norm());
      EXPECT_GT(turning, 0.1) << "some of its contacts bear impulses";
      expect_operator(problem, free, step.problem);
      expect_solution(step, 1e-9);
      expect_global(step, DiscreteForm<Y>::of(problem, free, solved.reaction, ProblemForm::global), true);
    }
}

TEST(StepProblem, MatchesTheOperatorOfBodiesThatTurn) {
  check_turning<Layout{2, true}>();
  check_turning<Layout{3, true}>();
  check_turning<Layout{2, true, true}>();
  check_turning<Layout{3, true, true}>();
}

TEST(StepProblem, MatchesTheOperatorOfDisks) {
  check_layout<Layout{2, false}>();
  check_layout<Layout{2, true}>();
  check_layout<Layout{2, true, true}>();
}

TEST(StepProblem, MatchesTheOperatorOfSpheres) {
  check_layout<Layout{3, false}>();
  check_layout<Layout{3, true}>();
  check_layout<Layout{3, true, true}>();
}

TEST(StepProblem, WhatHasNoFormIsRefused) {
  constexpr Layout Y{3, true, true};
  Problem<Y> problem = random_problem<Y>(3, false, false);
  problem.laws[1].pivoting = 0.01;
  const Iterate<Y> free = random_motion(problem, 7);
  EXPECT_THROW(DiscreteForm<Y>::of(problem, free, free.reaction), InputError);

  constexpr Layout Plain{2, false};
  Problem<Plain> many;
  many.grains = 2, many.inverse_mass.assign(2, 1.0), many.hub = {{Mat<2>::Identity(), 1.0}};
  many.resize(DiscreteForm<Plain>::most_hub_contacts + 1);
  for (std::size_t k = 0; k < many.size(); ++k)
    many.i[k] = 0, many.j[k] = 1, many.normal[k] = Vec<2>(1, 0), many.distance[k] = many.wn[k] = 1;
  const Iterate<Plain> still = random_motion(many, 1);
  EXPECT_THROW(DiscreteForm<Plain>::of(many, still, still.reaction), InputError);
  // The global form has no such bound.
  many.offset.assign(many.size(), 0.0);
  Iterate<Plain> none = still;
  none.reaction.assign(many.size(), Reaction<Plain>::Zero());
  const StepProblem global = DiscreteForm<Plain>::of(many, none, none.reaction, ProblemForm::global);
  EXPECT_EQ(global.global.jacobian.cols(), 2 * (DiscreteForm<Plain>::most_hub_contacts + 1));
  EXPECT_EQ(global.global.mass.rows(), 5);
}

// ---- Steps of the engine ----

/// A step of a sheared sample under stress: its impulses solve the problem, and showing it changes nothing.
template <int D>
void check_step(const test::RichLaw* law) {
  const auto make = [&] {
    Scene scene = test::sheared_scene<D>(0.3, 1);
    Sample<D> sample = test::crystal_sample<D>(D == 2 ? 6 : 3, 1.002);
    test::vary_sizes<D>(sample, 0.001, 51);
    test::shake<D>(sample, 0.3, 52, 0.3);
    scene.cd.dt = 4e-3, scene.cd.tolerance = 1e-8, scene.cd.max_sweeps = 20000;
    if (law) {
      law->change(scene);
      scene.material.pivoting_friction = 0;
      test::mix_materials<D>(scene, sample);
    }
    return test::make_engine<D>(EngineKind::cd, scene, sample);
  };
  const auto engine = make(), other = make(), silent = make();
  engine->advance(5), other->advance(5), silent->advance(6);
  const StepProblem step = dynamic_cast<ProblemSource&>(*engine).step_with_problem(ProblemForm::local);
  const StepProblem global = dynamic_cast<ProblemSource&>(*other).step_with_problem(ProblemForm::global);
  EXPECT_EQ(test::hash_of<D>(*engine), test::hash_of<D>(*silent));
  EXPECT_EQ(test::hash_of<D>(*other), test::hash_of<D>(*silent));
  EXPECT_GT(step.problem.contacts(), 20);
  EXPECT_GT(*std::max_element(step.r.begin(), step.r.end()), 0);
  ASSERT_EQ(engine->solver_summary().missed, 0);
  // The engine's residual counts against the impulses, errS against the largest of impulses and motions: not above
  // it but for the scale of the blocks (a factor of a few).
  expect_solution(step, 1e-7);
  expect_global(step, global, false);  // solving these to 1e-9 takes seconds
}

TEST(StepProblem, OfEnginesIsSolvedByTheirImpulses) {
  check_step<2>(nullptr);
  check_step<3>(nullptr);
  for (const test::RichLaw& law : test::rich_rigid_laws()) {
    SCOPED_TRACE(law.name);
    check_step<2>(&law);
    check_step<3>(&law);
  }
}

}  // namespace
}  // namespace galet::cd::step_problem_test
