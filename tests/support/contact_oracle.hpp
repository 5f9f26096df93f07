// Small contact problems by enumeration, apart from every solver and residual: each contact is open, or closed with
// each of its bounds (friction, rolling) held or sliding. One choice of states for all contacts is a system of
// equations
//
//   open r = 0;   closed u_N = 0;   held u_p = 0;   sliding r_p = -bound r_N e, u_p = a e, |e| = 1
//
// in r, a and the angle of e (a sign where the bound is on one number), linear but for the angles: Newton's method with
// the least step that solves it (complete orthogonal decomposition), in long double. What solves it is a solution where
// u_N >= 0 (open), r_N >= 0 (closed), |r_p| <= bound r_N (held), a >= 0 (sliding) hold too.
//
// Where a problem in 2D has a solution, it has one whose system is regular (a basic solution of the linear
// complementarity problem that it is), so that the enumeration of regular systems decides whether there is any.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include <Eigen/Dense>

#include "cd/discrete/problem.hpp"

namespace galet::cd {

class ContactOracle {
 public:
  using Real = long double;
  using VectorX = Eigen::Matrix<Real, Eigen::Dynamic, 1>;
  using MatrixX = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;

  /// State of a contact: open, or for each bound whether it slides; in 2D also which way.
  struct State {
    bool closed = false;
    bool sliding[2] = {false, false};
    Real angle[2] = {0, 0};  ///< of e
    Real speed[2] = {0, 0};  ///< a
  };

  /// W and q with every contact's rows (and those of rolling) scaled to a mean diagonal of one.
  explicit ContactOracle(const DiscreteProblem& problem)
      : block_(problem.block), contacts_(problem.contacts()), w_(MatrixX::Zero(problem.rows(), problem.rows())) {
    for (int a = 0; a < problem.rows(); ++a)
      for (std::int64_t k = problem.start[a]; k < problem.start[a + 1]; ++k)
        w_(a, problem.column[k]) = problem.value[k];
    q_ = Eigen::Map<const Eigen::VectorXd>(problem.q.data(), problem.rows()).cast<Real>();
    scale_ = VectorX::Ones(problem.rows());
    const int translations = block_ == 5 ? 3 : block_;
    for (int c = 0; c < contacts_; ++c) {
      const auto diagonal = w_.diagonal().segment(block_ * c, block_);
      const Real size = scale_of(diagonal.head(translations).mean());
      scale_.segment(block_ * c, translations).setConstant(size);
      bound_.push_back({problem.mu[c], 0});
      if (block_ < 5) continue;
      const Real turn = scale_of(diagonal.tail(2).mean());
      scale_.segment(block_ * c + 3, 2).setConstant(turn);
      bound_.back()[1] = problem.mu_r[c] * size / turn;
    }
    w_ = (scale_.asDiagonal() * w_ * scale_.asDiagonal()).eval();
    q_ = scale_.cwiseProduct(q_).eval();
  }

  VectorX scaled(const std::vector<double>& r) const {
    return Eigen::Map<const Eigen::VectorXd>(r.data(), w_.rows()).cast<Real>().cwiseQuotient(scale_);
  }
  VectorX motion(const VectorX& r) const { return w_ * r + q_; }

  /// The state that each contact of r is in or nearest to.
  std::vector<State> states_of(const VectorX& r) const {
    const VectorX u = motion(r);
    std::vector<State> states(contacts_);
    for (int c = 0; c < contacts_; ++c) {
      State& state = states[c];
      state.closed = r[block_ * c] > u[block_ * c];
      for (int part = 0; part < parts(); ++part) {
        const auto force = r.segment(row_of(c, part), size()), speed = u.segment(row_of(c, part), size());
        state.speed[part] = speed.norm();
        state.sliding[part] = bound_[c][part] * r[block_ * c] - force.norm() < speed.norm();
        const VectorX along = force.norm() > 0 ? VectorX(-force) : VectorX(speed);
        state.angle[part] = size() == 2 ? std::atan2(along[1], along[0]) : along[0] < 0 ? pi() : 0;
      }
    }
    return states;
  }

  /// The solution in these states that Newton's steps from r lead to, if they do. `least_regular`: reciprocal condition
  /// below which a system is left out (0: none is). `slack`: what inequalities may miss, relative to |r| + |q|.
  std::optional<VectorX> solution(std::vector<State> states, VectorX r, Real least_regular, Real slack) const {
    const Real accuracy = 1e-15L;
    for (int step = 0; step < 30; ++step) {
      const System system = system_of(states, r);
      Eigen::CompleteOrthogonalDecomposition<MatrixX> factor;
      factor.setThreshold(1e-13L);  // rounding of a singular W, in double, is below
      factor.compute(system.slope);
      if (least_regular > 0) {
        const auto pivots = factor.matrixQTZ().diagonal().cwiseAbs();
        if (!(pivots.minCoeff() > least_regular * pivots.maxCoeff())) return std::nullopt;
      }
      const VectorX change = factor.solve(system.miss);
      if (!change.allFinite()) return std::nullopt;
      take_step(change, states, r);
      if (change.norm() <= accuracy * (r.norm() + q_.norm())) break;
    }
    const Real size_r = r.norm() + q_.norm(), size_u = size_r * std::max<Real>(1, w_.norm());
    if (!(system_of(states, r).miss.norm() <= 1e-12L * size_u)) return std::nullopt;
    return holds(states, r, slack * size_r, slack * size_u) ? std::optional(r) : std::nullopt;
  }

  /// The exact solution next to r: in the states of r, or with other states where r is within `edge` of two.
  std::optional<VectorX> next_to(const VectorX& r, Real edge) const {
    const VectorX u = motion(r);
    const std::vector<State> states = states_of(r);
    struct Doubt {
      int contact, part;  // part -1: open or closed
    };
    std::vector<Doubt> doubts;
    const Real near_r = edge * (r.norm() + load()), near_u = near_r * std::max<Real>(1, w_.norm());
    for (int c = 0; c < contacts_; ++c) {
      if (r[block_ * c] < near_r && u[block_ * c] < near_u) doubts.push_back({c, -1});
      for (int part = 0; part < parts(); ++part)
        if (bound_[c][part] * r[block_ * c] - r.segment(row_of(c, part), size()).norm() < near_r &&
            states[c].speed[part] < near_u)
          doubts.push_back({c, part});
    }
    const int most_doubts = 10;
    const int choices = 1 << std::min<int>(most_doubts, static_cast<int>(doubts.size()));
    for (int choice = 0; choice < choices; ++choice) {
      std::vector<State> tried = states;
      for (int d = 0; (1 << d) < choices; ++d) {
        if ((choice >> d & 1) == 0) continue;
        State& state = tried[doubts[d].contact];
        bool& flag = doubts[d].part < 0 ? state.closed : state.sliding[doubts[d].part];
        flag = !flag;
      }
      const auto exact = solution(tried, r, 0, 10 * edge);
      if (exact && (*exact - r).norm() <= 1e-2L * (r.norm() + load())) return exact;
    }
    return std::nullopt;
  }

  /// All solutions that the states of all contacts lead to, each once. Angles start from `starts` directions.
  std::vector<VectorX> enumerate(int starts, Real least_regular) const {
    std::vector<VectorX> found;
    std::vector<State> states(contacts_);
    enumerate_from(0, starts, least_regular, states, found);
    return found;
  }

  /// -min l.q_N over l >= 0 with W l = 0 and sum l = 1 (l along the normals), by the extreme rays of that cone; above
  /// zero: no solution, since l.u_N = l.q_N. Not a number where rounding may decide.
  Real contradiction() const {
    Real worst = -std::numeric_limits<Real>::infinity();
    bool sure = true;
    for (int set = 1; set < 1 << contacts_; ++set) {
      std::vector<int> rows;
      for (int c = 0; c < contacts_; ++c)
        if (set >> c & 1) rows.push_back(block_ * c);
      const Eigen::JacobiSVD<MatrixX> svd(w_(Eigen::all, rows), Eigen::ComputeFullV);
      const VectorX values = svd.singularValues();
      const Eigen::Index last = values.size() - 1;
      const VectorX ray = svd.matrixV().col(last) * (svd.matrixV().col(last).sum() < 0 ? -1 : 1);
      if (values[last] > 1e-6L) continue;
      if (values[last] > 1e-14L) {
        sure = sure && ray.minCoeff() < -1e-3L;
        continue;
      }
      if (last > 0 && values[last - 1] <= 1e-14L) continue;  // not extreme: its faces are other sets
      if (ray.minCoeff() <= 0) continue;
      worst = std::max(worst, -ray.dot(q_(rows)) / ray.sum());
    }
    return sure || worst > 1e-9L * load() ? worst : std::numeric_limits<Real>::quiet_NaN();
  }

  Real load() const { return q_.norm(); }

 private:
  struct System {
    MatrixX slope;
    VectorX miss;
  };

  static Real pi() { return 3.14159265358979323846L; }
  static Real scale_of(Real mean) { return mean > 0 ? 1 / std::sqrt(mean) : 1; }
  int parts() const { return block_ == 5 ? 2 : 1; }
  int size() const { return block_ == 2 ? 1 : 2; }  ///< numbers of a part
  int row_of(int c, int part) const { return block_ * c + 1 + 2 * part; }
  VectorX direction(Real angle) const {
    VectorX e(size());
    if (size() == 1)
      e[0] = std::abs(angle) > 1 ? -1 : 1;
    else
      e << std::cos(angle), std::sin(angle);
    return e;
  }

  int unknowns(const std::vector<State>& states) const {
    int count = static_cast<int>(w_.rows());
    for (const State& state : states)
      for (int part = 0; part < parts(); ++part)
        if (state.closed && state.sliding[part]) count += size();
    return count;
  }

  System system_of(const std::vector<State>& states, const VectorX& r) const {
    const VectorX u = motion(r);
    const int count = unknowns(states), rows = static_cast<int>(w_.rows());
    System system{MatrixX::Zero(count, count), VectorX::Zero(count)};
    int extra = rows;
    for (int c = 0; c < contacts_; ++c) {
      const State& state = states[c];
      const int first = block_ * c;
      if (!state.closed) {
        system.slope.block(first, first, block_, block_).setIdentity();
        system.miss.segment(first, block_) = r.segment(first, block_);
        continue;
      }
      system.slope.row(first).head(rows) = w_.row(first);
      system.miss[first] = u[first];
      for (int part = 0; part < parts(); ++part) {
        const int row = row_of(c, part);
        system.slope.block(row, 0, size(), rows) = w_.block(row, 0, size(), rows);
        system.miss.segment(row, size()) = u.segment(row, size());
        if (!state.sliding[part]) continue;
        const VectorX e = direction(state.angle[part]);
        const Real a = state.speed[part], bound = bound_[c][part];
        system.slope.block(row, extra, size(), 1) = -e;
        system.miss.segment(row, size()) -= a * e;
        system.slope.block(extra, row, size(), size()).setIdentity();
        system.slope.block(extra, first, size(), 1) = bound * e;
        system.miss.segment(extra, size()) = r.segment(row, size()) + bound * r[first] * e;
        if (size() == 2) {
          const VectorX turned = direction(state.angle[part] + pi() / 2);
          system.slope.block(row, extra + 1, 2, 1) = -a * turned;
          system.slope.block(extra, extra + 1, 2, 1) = bound * r[first] * turned;
        }
        extra += size();
      }
    }
    return system;
  }

  void take_step(const VectorX& change, std::vector<State>& states, VectorX& r) const {
    r -= change.head(r.size());
    Eigen::Index extra = r.size();
    for (State& state : states)
      for (int part = 0; part < parts(); ++part) {
        if (!state.closed || !state.sliding[part]) continue;
        state.speed[part] -= change[extra];
        if (size() == 2) state.angle[part] -= std::clamp<Real>(change[extra + 1], -1, 1);
        extra += size();
      }
  }

  bool holds(const std::vector<State>& states, const VectorX& r, Real tolerance_r, Real tolerance_u) const {
    const VectorX u = motion(r);
    for (int c = 0; c < contacts_; ++c) {
      const State& state = states[c];
      if (!state.closed && u[block_ * c] < -tolerance_u) return false;
      if (!state.closed) continue;
      const Real normal = r[block_ * c];
      if (normal < -tolerance_r) return false;
      for (int part = 0; part < parts(); ++part) {
        const Real force = r.segment(row_of(c, part), size()).norm();
        if (state.sliding[part] ? state.speed[part] < -tolerance_u : force > bound_[c][part] * normal + tolerance_r)
          return false;
      }
    }
    return true;
  }

  void enumerate_from(int c, int starts, Real least_regular, std::vector<State>& states,
                      std::vector<VectorX>& found) const {
    if (c == contacts_) {
      // Angles are found only where forces and speeds turn with them.
      std::vector<State> start = states;
      VectorX r = VectorX::Zero(w_.rows());
      for (int k = 0; k < contacts_; ++k) {
        if (states[k].closed) r[block_ * k] = load();
        for (Real& speed : start[k].speed) speed = load();
      }
      const auto solved = solution(start, r, least_regular, 1e-12L);
      if (!solved) return;
      for (const VectorX& other : found)
        if ((other - *solved).norm() <= 1e-9L * (solved->norm() + load())) return;
      found.push_back(*solved);
      return;
    }
    states[c] = {};
    enumerate_from(c + 1, starts, least_regular, states, found);
    const int ways = 1 + (size() == 1 ? 2 : starts);  // held, or sliding this way
    for (int choice = 0; choice < (parts() == 2 ? ways * ways : ways); ++choice) {
      states[c] = {};
      states[c].closed = true;
      for (int part = 0, rest = choice; part < parts(); ++part, rest /= ways) {
        if (rest % ways == 0) continue;
        states[c].sliding[part] = true;
        states[c].angle[part] = 2 * pi() * static_cast<Real>(rest % ways - 1) / static_cast<Real>(ways - 1);
      }
      enumerate_from(c + 1, starts, least_regular, states, found);
    }
  }

  int block_, contacts_;
  MatrixX w_;
  VectorX q_, scale_;
  std::vector<std::array<Real, 2>> bound_;
};

}  // namespace galet::cd
