// A matrix-free contact problem (cd/problem.hpp) as a discrete one (cd/discrete/problem.hpp), in the frame (n, t1, t2)
// of each contact:
//
//   W = sum over bodies of J M^-1 J^T  +  sum over modes of the hub of g g^T / inertia  +  compliance (diagonal)
//   q = u of the free velocities + offset (N) + lag (T, R)
//
// J: rows n.(v_j - v_i), t.(v_j - v_i) - arm (n x t).w, t.(w_j - w_i), with (lever x d).w for each direction d in
// contacts of bodies that turn; g: n.G b and t.G b, b the branch.
// Disks: t = (-n_y, n_x). Spheres: t1 is any direction across n (Eigen's unitOrthogonal), t2 = n x t1.
//
//   layout          block   mu
//   frictionless    D       0 (the tangential rows hold the motion of the centres; nothing depends on them)
//   friction        D       that of the pair
//   rolling, disks  5       (N, T, 0, R, 0): the second directions are coupled to nothing, and have W of the first and
//                           q = 0; their impulses are then zero in every solution
//   rolling, spheres 5      (N, T1, T2, R1, R2), where no pair resists pivoting; else refused
//
// The global form (cd/discrete/global_problem.hpp) has a freedom for each direction in which a body that touches
// something can be pushed (axes, or those that make its mobility diagonal), for each mode of the hub, for each elastic
// direction of a contact (a body of mass 1/compliance that only it moves) and, so that its local form is the one above,
// for each direction of rolling disks that is coupled to nothing. M is then diagonal. What prescribed motions, offsets
// and lags make of u is in w.
//
// Cost: contacts times neighbouring contacts; with a hub every pair of contacts, refused above 3000 of them; global
// form: contacts.
#pragma once

#include <map>

#include <Eigen/Eigenvalues>
#include <fmt/format.h>

#include "cd/discrete/step_problem.hpp"
#include "cd/problem.hpp"
#include "common/core/error.hpp"

namespace galet::cd {

template <Layout Y>
class DiscreteForm {
 public:
  static constexpr int D = Y.dim;
  static constexpr int spins = D == 2 ? 1 : 3;
  static constexpr int block = Y.rolling ? 5 : D;
  static constexpr int most_hub_contacts = 3000;

  /// `free`: velocities without any reaction (attraction included); `reaction`: the engine's impulses.
  static StepProblem of(const Problem<Y>& problem, const Iterate<Y>& free, const Column<Reaction<Y>>& reaction,
                        ProblemForm wanted = ProblemForm::local);

 private:
  using Block = Eigen::Matrix<double, block, block>;
  using Values = Eigen::Matrix<double, block, 1>;
  using Jacobian = Eigen::Matrix<double, block, D + spins>;
  using Mobility = Eigen::Matrix<double, D + spins, D + spins>;

  /// The part of one body in the motion of a contact.
  struct Side {
    int contact;
    Jacobian jacobian;
  };

  explicit DiscreteForm(const Problem<Y>& problem) : problem_(problem), sides_(problem.inverse_mass.size()) {
    for (std::size_t k = 0; k < problem.size(); ++k) {
      if (problem.wn[k] == 0) continue;
      if constexpr (Y.rolling && D == 3)
        if (problem.laws[problem.law[k]].pivoting > 0)
          throw InputError(
              "contacts that resist pivoting have no FCLIB form: set material.pivoting_friction = 0, or leave it out");
      const int contact = static_cast<int>(kept_.size());
      kept_.push_back(k);
      tangents_.push_back(across<D>(problem.normal[k]));
      const int i = problem.i[k], j = problem.j[k];
      if (problem.turns(k)) {
        if constexpr (Y.friction) {
          const TurningContact<Y>& bent = problem.bent[k - problem.first_turning];
          sides_[i].push_back({contact, jacobian(contact, -1, bent.lever_i)});
          sides_[j].push_back({contact, jacobian(contact, 1, bent.lever_j)});
        }
      } else if (i == j) {
        sides_[i].push_back({contact, jacobian(contact, -1, arm_i(k)) + jacobian(contact, 1, arm_j(k))});
      } else {
        sides_[i].push_back({contact, jacobian(contact, -1, arm_i(k))});
        sides_[j].push_back({contact, jacobian(contact, 1, arm_j(k))});
      }
    }
  }

  static void append(const Values& values, std::vector<double>& to) {
    to.insert(to.end(), values.data(), values.data() + block);
  }

  double arm_i(std::size_t k) const {
    if constexpr (Y.friction) return problem_.arm_i[k];
    return 0;
  }
  double arm_j(std::size_t k) const {
    if constexpr (Y.friction) return problem_.arm_j[k];
    return 0;
  }

  /// Components by the contact's own directions; zero in directions that disks have not.
  Values local(std::size_t contact, const Components<Y>& parts) const {
    Values values = Values::Zero();
    values[0] = parts.normal;
    if constexpr (D == 2) {
      values[1] = parts.tangential;
      if constexpr (Y.rolling) values[3] = parts.rolling;
    } else {
      values.template segment<2>(1) = tangents_[contact].transpose() * parts.tangential;
      if constexpr (Y.rolling) values.template segment<2>(3) = tangents_[contact].transpose() * parts.rolling;
    }
    return values;
  }

  /// Motion of the contact by velocity and spin of its body j (side = 1) or i (side = -1).
  Jacobian jacobian(int contact, double side, double arm) const {
    const Vec<D>& n = problem_.normal[kept_[contact]];
    const auto& t = tangents_[contact];
    Jacobian by = Jacobian::Zero();
    by.template block<1, D>(0, 0) = side * n.transpose();
    by.template block<D - 1, D>(1, 0) = side * t.transpose();
    if constexpr (D == 2) {
      by(1, D) = -arm;
      if constexpr (Y.rolling) by(3, D) = side;
    } else {
      by.template block<1, 3>(1, D) = -arm * t.col(1).transpose();
      by.template block<1, 3>(2, D) = arm * t.col(0).transpose();
      if constexpr (Y.rolling) by.template block<2, 3>(3, D) = side * t.transpose();
    }
    return by;
  }

  /// The same where the lever is not along the normal.
  Jacobian jacobian(int contact, double side, const Vec<D>& lever) const {
    Jacobian by = jacobian(contact, side, 0.0);
    const auto turn = [&](int row, const Vec<D>& direction) {
      const Spin<D> moment = side * cross(lever, direction);
      if constexpr (D == 2)
        by(row, D) = moment;
      else
        by.template block<1, 3>(row, D) = moment.transpose();
    };
    turn(0, problem_.normal[kept_[contact]]);
    for (int a = 0; a < D - 1; ++a) turn(1 + a, tangents_[contact].col(a));
    return by;
  }

  Mobility mobility(int body) const {
    Mobility answer = Mobility::Zero();
    if (body < problem_.grains)
      answer.diagonal().template head<D>().setConstant(problem_.inverse_mass[body]);
    else if (problem_.mobile(body))
      answer.template topLeftCorner<D, D>() = problem_.mobility[body - problem_.grains];
    if constexpr (Y.friction) {
      answer.diagonal().template tail<spins>().setConstant(problem_.inverse_inertia[body]);
      if (problem_.spun(body)) set_turning(problem_.turning[body - problem_.grains], answer);
    }
    return answer;
  }

  static void set_turning(double turning, Mobility& answer) { answer(D, D) = turning; }
  static void set_turning(const Mat<3>& turning, Mobility& answer) {
    answer.template bottomRightCorner<spins, spins>() = turning.template topLeftCorner<spins, spins>();
  }

  /// Blocks (c, d) of W with d >= c; the others are their transposes, so that W is symmetric to the last bit.
  std::vector<std::map<int, Block>> upper_blocks() const {
    std::vector<std::map<int, Block>> rows(kept_.size());
    const auto add = [&](int c, int d, const Block& part) {
      rows[c].try_emplace(d, Block::Zero()).first->second += part;
    };
    for (std::size_t body = 0; body < sides_.size(); ++body) {
      const Mobility answer = mobility(static_cast<int>(body));
      if (answer.isZero(0)) continue;
      for (const Side& c : sides_[body])
        for (const Side& d : sides_[body])
          if (d.contact >= c.contact) add(c.contact, d.contact, c.jacobian * answer * d.jacobian.transpose());
    }
    for (const HubMode<D>& mode : problem_.hub) {
      std::vector<Values> strain;
      for (std::size_t c = 0; c < kept_.size(); ++c) strain.push_back(motion_of(c, mode.direction));
      for (int c = 0; c < static_cast<int>(kept_.size()); ++c)
        for (int d = c; d < static_cast<int>(kept_.size()); ++d)
          add(c, d, mode.inverse_inertia * strain[c] * strain[d].transpose());
    }
    for (int c = 0; c < static_cast<int>(kept_.size()); ++c)
      complete_diagonal(c, rows[c].try_emplace(c, Block::Zero()).first->second);
    return rows;
  }

  /// Motion of a contact in a cell of this velocity gradient.
  Values motion_of(std::size_t contact, const Mat<D>& gradient) const {
    const std::size_t k = kept_[contact];
    const Vec<D> u = gradient * branch_of(problem_, k);
    Values values = Values::Zero();
    values[0] = problem_.normal[k].dot(u);
    values.template segment<D - 1>(1) = tangents_[contact].transpose() * u;
    return values;
  }

  void complete_diagonal(int contact, Block& own) const {
    own = (0.5 * (own + own.transpose())).eval();
    if (problem_.compliant) {
      const Compliance& compliance = problem_.compliance[kept_[contact]];
      own(0, 0) += compliance.normal;
      for (int a = 1; a < D; ++a) own(a, a) += compliance.tangential;
      if constexpr (Y.rolling)
        for (int a = 3; a < 2 + D; ++a) own(a, a) += compliance.rolling;
    }
    if constexpr (Y.rolling && D == 2) own(2, 2) = own(1, 1), own(4, 4) = own(3, 3);
  }

  void fill_matrix(DiscreteProblem& discrete) const {
    if (!problem_.hub.empty() && kept_.size() > most_hub_contacts)
      throw InputError(
          fmt::format("a stress-driven cell couples all {} contacts of this step: such a problem can be "
                      "written for {} contacts at most",
                      kept_.size(), most_hub_contacts));
    std::vector<std::map<int, Block>> rows = upper_blocks();
    for (int c = 0; c < static_cast<int>(rows.size()); ++c)
      for (const auto& [d, part] : rows[c])
        if (d > c) rows[d][c] = part.transpose();
    discrete.start = {0};
    for (int c = 0; c < static_cast<int>(rows.size()); ++c)
      for (int a = 0; a < block; ++a) {
        for (const auto& [d, part] : rows[c])
          for (int b = 0; b < block; ++b) {
            if (part(a, b) == 0 && !(c == d && a == b)) continue;
            discrete.column.push_back(block * d + b);
            discrete.value.push_back(part(a, b));
          }
        discrete.start.push_back(static_cast<std::int64_t>(discrete.value.size()));
      }
  }

  /// The freedoms of the global form while they are gathered.
  struct Freedoms {
    std::vector<double> mass, velocity;
    std::vector<Eigen::Triplet<double, int>> entries;  ///< of H
    std::vector<double> diagonal;                      ///< of W, by row

    /// For a freedom of this mobility and free velocity; the next calls of move() are about it.
    void begin(double mobility, double free) { mass.push_back(1 / mobility), velocity.push_back(free); }
    /// u[row] changes by `share` of the freedom's velocity.
    void move(int row, double share) {
      if (share == 0) return;
      entries.emplace_back(static_cast<int>(mass.size()) - 1, row, share);
      diagonal[row] += share * share / mass.back();
    }
  };

  /// Freedoms of a body in directions first .. first + size of its motion.
  template <int size>
  void add_body(std::size_t body, int first, const Eigen::Matrix<double, size, size>& answer,
                const Eigen::Matrix<double, size, 1>& free, Freedoms& freedoms) const {
    using Square = Eigen::Matrix<double, size, size>;
    Square axes = Square::Identity();
    Eigen::Matrix<double, size, 1> mobile = answer.diagonal();
    if (!answer.isDiagonal(0)) {
      const Eigen::SelfAdjointEigenSolver<Square> solver(answer);
      axes = solver.eigenvectors(), mobile = solver.eigenvalues();
    }
    const double least = 1e-12 * mobile.maxCoeff();  // what a plane can't do, to rounding
    for (int a = 0; a < size; ++a) {
      if (!(mobile[a] > least)) continue;
      freedoms.begin(mobile[a], axes.col(a).dot(free));
      for (const Side& side : sides_[body])
        for (int row = 0; row < block; ++row)
          freedoms.move(block * side.contact + row, side.jacobian.template block<1, size>(row, first) * axes.col(a));
    }
  }

  void add_bodies(const Iterate<Y>& free, Freedoms& freedoms) const {
    for (std::size_t body = 0; body < sides_.size(); ++body) {
      if (sides_[body].empty()) continue;
      const Mobility answer = mobility(static_cast<int>(body));
      add_body<D>(body, 0, answer.template topLeftCorner<D, D>(), free.velocity[body], freedoms);
      if constexpr (Y.friction) {
        Eigen::Matrix<double, spins, 1> spin;
        if constexpr (D == 2)
          spin << free.spin[body];
        else
          spin = free.spin[body];
        add_body<spins>(body, D, answer.template bottomRightCorner<spins, spins>(), spin, freedoms);
      }
    }
  }

  /// What only one row of a contact knows.
  void add_single_rows(Freedoms& freedoms) const {
    const auto add = [&](int row, double mobility) {
      if (!(mobility > 0)) return;
      freedoms.begin(mobility, 0);
      freedoms.move(row, 1);
    };
    for (int c = 0; c < static_cast<int>(kept_.size()); ++c) {
      if (problem_.compliant) {
        const Compliance& compliance = problem_.compliance[kept_[c]];
        add(block * c, compliance.normal);
        for (int a = 1; a < D; ++a) add(block * c + a, compliance.tangential);
        if constexpr (Y.rolling)
          for (int a = 3; a < 2 + D; ++a) add(block * c + a, compliance.rolling);
      }
      if constexpr (Y.rolling && D == 2)
        for (const int a : {1, 3}) add(block * c + a + 1, freedoms.diagonal[block * c + a]);
    }
  }

  /// Takes mu and q from step.problem.
  void make_global(const Iterate<Y>& free, StepProblem& step) const {
    const int rows = step.problem.rows();
    Freedoms freedoms;
    freedoms.diagonal.assign(rows, 0.0);
    add_bodies(free, freedoms);
    for (std::size_t m = 0; m < problem_.hub.size(); ++m) {
      freedoms.begin(problem_.hub[m].inverse_inertia, free.hub_rate[m]);
      for (int c = 0; c < static_cast<int>(kept_.size()); ++c) {
        const Values strain = motion_of(c, problem_.hub[m].direction);
        for (int a = 0; a < block; ++a) freedoms.move(block * c + a, strain[a]);
      }
    }
    add_single_rows(freedoms);

    const auto count = static_cast<int>(freedoms.mass.size());
    GlobalProblem& global = step.global;
    global.block = block, global.mu = step.problem.mu, global.mu_r = step.problem.mu_r;
    global.jacobian.resize(count, rows);
    global.jacobian.setFromTriplets(freedoms.entries.begin(), freedoms.entries.end());
    const Eigen::VectorXd mass = Eigen::VectorXd::Map(freedoms.mass.data(), count);
    const Eigen::VectorXd velocity = Eigen::VectorXd::Map(freedoms.velocity.data(), count);
    global.mass = mass.asDiagonal();
    const auto list = [](const Eigen::VectorXd& values) {
      return std::vector<double>(values.data(), values.data() + values.size());
    };
    const Eigen::VectorXd w =
        Eigen::VectorXd::Map(step.problem.q.data(), rows) - global.jacobian.transpose() * velocity;
    const Eigen::VectorXd v =
        velocity + (global.jacobian * Eigen::VectorXd::Map(step.r.data(), rows)).cwiseQuotient(mass);
    global.f = list(mass.cwiseProduct(velocity)), global.w = list(w);
    step.v = list(v), step.u = list(global.jacobian.transpose() * v + w);
    step.problem = {};
  }

  const Problem<Y>& problem_;
  std::vector<std::size_t> kept_;  ///< contacts that something can move
  std::vector<Eigen::Matrix<double, D, D - 1>> tangents_;
  std::vector<std::vector<Side>> sides_;  ///< by body
};

template <Layout Y>
StepProblem DiscreteForm<Y>::of(const Problem<Y>& problem, const Iterate<Y>& free, const Column<Reaction<Y>>& reaction,
                                ProblemForm wanted) {
  const DiscreteForm form(problem);
  StepProblem step{wanted};
  step.problem.block = block;
  for (std::size_t c = 0; c < form.kept_.size(); ++c) {
    const std::size_t k = form.kept_[c];
    if constexpr (Y.friction) step.problem.mu.push_back(problem.laws[problem.law[k]].friction);
    if constexpr (!Y.friction) step.problem.mu.push_back(0);
    if constexpr (Y.rolling) step.problem.mu_r.push_back(problem.laws[problem.law[k]].rolling);
    append(form.local(c, law_motion(problem, free, free.gradient, k, Components<Y>{})), step.problem.q);
    append(form.local(c, components<Y>(problem.normal[k], reaction[k])), step.r);
  }
  if (wanted == ProblemForm::global) {
    form.make_global(free, step);
    return step;
  }
  form.fill_matrix(step.problem);
  step.u = step.problem.q;
  for (int a = 0; a < step.problem.rows(); ++a)
    for (std::int64_t e = step.problem.start[a]; e < step.problem.start[a + 1]; ++e)
      step.u[a] += step.problem.value[e] * step.r[step.problem.column[e]];
  return step;
}

// Compiled in cd/solver_instances.cpp, and only there.
extern template class DiscreteForm<Layout{2, false}>;
extern template class DiscreteForm<Layout{2, true}>;
extern template class DiscreteForm<Layout{2, true, true}>;
extern template class DiscreteForm<Layout{3, false}>;
extern template class DiscreteForm<Layout{3, true}>;
extern template class DiscreteForm<Layout{3, true, true}>;

}  // namespace galet::cd
