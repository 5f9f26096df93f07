// Whether a discrete contact problem can have a solution at all.
//
// For any weights l >= 0 of the normal motions a solution has 0 <= l.u_N = (W^T l).r + l.q_N (l as impulses along the
// normals), so that in the scaled problem
//   |r| >= -l.q_N / |W^T l|
// Where l exists with W^T l = 0 and l.q_N < 0 there is no solution: these contacts close against each other whatever
// the impulses. It exists exactly where the frictionless problem has no solution; its impulses then grow along such an
// l, so that l is looked for in the differences r_N^(2k) - r_N^(k) of its Gauss-Seidel iterates, and in what of them
// W^T really leaves out. (Where the motions of the bodies can make all u_N > mu |u_T| + mu_R |u_R| there is a solution:
// Acary, Cadoux, Lemarechal and Malick 2011. Between the two, where something slides that nothing can stop, friction
// decides, and no such proof is known.)
// Cost per sweep: one product with W; per doubling of the sweeps a decomposition of the columns of at most 100
// contacts.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <Eigen/SVD>

#include "cd/discrete/scaled_problem.hpp"

namespace galet::cd {

template <int B>
class Contradiction {
 public:
  using Vector = typename ScaledProblem<B>::Vector;

  explicit Contradiction(const ScaledProblem<B>& problem)
      : problem_(problem), normal_(problem.size(), 0.0), half_(problem.size(), 0.0) {
    for (const Vector& q : problem.q) load_ += q.squaredNorm();
    load_ = std::sqrt(load_);
    for (int c = 0; c < problem.size(); ++c) {
      if (problem.own[c](0, 0) > 0 || problem.q[c][0] >= 0) continue;
      std::vector<double> alone(problem.size(), 0.0);
      alone[c] = 1;
      try_weights(alone);
    }
  }

  /// Up to `sweeps` more; true when it is known whether there is a solution.
  bool search(long sweeps) {
    for (long k = 0; k < sweeps && !decided(); ++k) {
      const auto [change, size] = sweep();
      solved_ = change <= 1e-24 * size;
      if (++count_ != next_) continue;
      std::vector<double> weights(normal_.size());
      for (std::size_t c = 0; c < weights.size(); ++c) weights[c] = std::max(0.0, normal_[c] - half_[c]);
      try_weights(weights);
      try_weights(unanswered(weights));
      half_ = normal_;
      next_ *= 2;
    }
    return decided();
  }

  /// No solution has impulses below this, in units of |q~|.
  double least_impulse() const { return least_; }
  /// Beyond this there is none.
  bool none() const { return least_ > most_impulse; }
  bool decided() const { return solved_ || none(); }
  /// The contacts that close against each other; empty unless none().
  std::vector<int> contacts() const {
    std::vector<int> list;
    if (!none()) return list;
    const double largest = *std::max_element(weights_.begin(), weights_.end());
    for (std::size_t c = 0; c < weights_.size(); ++c)
      if (weights_[c] > 1e-6 * largest) list.push_back(static_cast<int>(c));
    return list;
  }

  /// Impulses of solutions stay below this many times the load: beyond, rounding of W decides.
  static constexpr double most_impulse = 1e8;

 private:
  static constexpr Eigen::Index most_refined = 100;

  struct Change {
    double change, size;
  };
  /// One Gauss-Seidel sweep without friction: squared change, squared impulses.
  Change sweep() {
    Change sums{0, 0};
    for (int c = 0; c < problem_.size(); ++c) {
      const double weight = problem_.own[c](0, 0);
      if (!(weight > 0)) continue;
      double motion = problem_.q[c][0] + weight * normal_[c];
      for (int k = problem_.first[c]; k < problem_.first[c + 1]; ++k)
        motion += problem_.block[k](0, 0) * normal_[problem_.neighbour[k]];
      const double now = std::max(0.0, normal_[c] - motion / weight);
      sums.change += (now - normal_[c]) * (now - normal_[c]), sums.size += now * now;
      normal_[c] = now;
    }
    return sums;
  }

  /// The part of the weights that W^T maps to nothing but rounding; zero where too many contacts have one.
  std::vector<double> unanswered(const std::vector<double>& weights) const {
    std::vector<int> support;
    const double largest = *std::max_element(weights.begin(), weights.end());
    for (int c = 0; c < problem_.size(); ++c)
      if (weights[c] > 1e-3 * largest) support.push_back(c);
    std::vector<double> part(weights.size(), 0.0);
    const auto count = static_cast<Eigen::Index>(support.size());
    if (count == 0 || count > most_refined) return part;
    std::vector<int> place(weights.size(), -1);
    for (Eigen::Index a = 0; a < count; ++a) place[support[a]] = static_cast<int>(a);
    Eigen::MatrixXd square = Eigen::MatrixXd::Zero(count, count);  // W_NN: W^T l = 0 where l.W l = 0
    for (Eigen::Index a = 0; a < count; ++a) {
      const int c = support[a];
      square(a, a) = problem_.own[c](0, 0);
      for (int k = problem_.first[c]; k < problem_.first[c + 1]; ++k)
        if (const int b = place[problem_.neighbour[k]]; b >= 0) square(a, b) = problem_.block[k](0, 0);
    }
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(square, Eigen::ComputeFullV);
    Eigen::VectorXd kept = Eigen::VectorXd::Zero(count);
    for (Eigen::Index a = 0; a < count; ++a) {
      if (svd.singularValues()[a] > 1e-12 * svd.singularValues()[0]) continue;
      double along = 0;
      for (Eigen::Index b = 0; b < count; ++b) along += svd.matrixV()(b, a) * weights[support[b]];
      kept += along * svd.matrixV().col(a);
    }
    for (Eigen::Index a = 0; a < count; ++a) part[support[a]] = std::max(0.0, kept[a]);
    return part;
  }

  void try_weights(const std::vector<double>& weights) {
    double closing = 0, answer = 0;
    std::vector<Vector> motion(weights.size(), Vector::Zero());  // W^T l
    for (int c = 0; c < problem_.size(); ++c) {
      if (weights[c] == 0) continue;
      closing -= weights[c] * problem_.q[c][0];
      motion[c] += weights[c] * problem_.own[c].row(0).transpose();
      for (int k = problem_.first[c]; k < problem_.first[c + 1]; ++k)
        motion[problem_.neighbour[k]] += weights[c] * problem_.block[k].row(0).transpose();
    }
    for (const Vector& u : motion) answer += u.squaredNorm();
    if (!(closing > 0)) return;
    const double least = answer > 0 ? closing / std::sqrt(answer) / load_ : std::numeric_limits<double>::infinity();
    if (least > least_) least_ = least, weights_ = weights;
  }

  const ScaledProblem<B>& problem_;
  std::vector<double> normal_, half_, weights_;
  double load_ = 0, least_ = 0;
  long count_ = 0, next_ = 8;
  bool solved_ = false;
};

}  // namespace galet::cd
