// Proximal semismooth Newton with the term of De Saxce frozen: each proximal step
//   r = P_K(r_k - sigma (W r + q + s e_N)),    s = mu |u_T| + mu_R |u_R| of the motion at r_k
// is that of a convex problem, and its solution is the minimum of a function of the motions that is strictly convex and
// once differentiable. With u = W x + q it is
//   f = x.W x / 2 + |P_K(r_k - sigma (u + s e_N))|^2 / (2 sigma)
// Newton's matrix I + sigma P' W is, in body space, symmetric and positive definite (CHOLMOD), the step descends f, and
// halving by f converges from anywhere. (By the residual |x - P_K(..)|, which is no function's gradient in x, the line
// search of cd/discrete/proximal_newton.hpp jams on piles.) Converges to the solution where the renewal of s does.
// Sources: Rockafellar 1976; Zhao, Sun and Toh 2010; the term: Cadoux 2009. Cost per step: one factorisation.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "cd/discrete/monitor.hpp"
#include "cd/discrete/newton_matrix.hpp"

namespace galet::cd {

template <int B>
class ConvexNewton {
 public:
  using Vector = typename ScaledProblem<B>::Vector;
  using Block = typename ScaledProblem<B>::Block;
  using Vectors = std::vector<Vector>;

  ConvexNewton(const ScaledProblem<B>& problem, NewtonMatrix<B>& matrix, Vectors start)
      : problem_(problem),
        matrix_(matrix),
        centre_(start),
        x_(std::move(start)),
        motion_(x_.size()),
        argument_(x_.size()),
        mapped_(x_.size()),
        change_(x_.size()),
        answer_(x_.size()),
        term_(x_.size()),
        left_(x_.size()),
        identity_(x_.size(), Block::Identity()) {}

  /// Up to `steps` Newton steps; true when the monitor says stop.
  bool solve(long steps, Monitor<B>& monitor) {
    double error_before = monitor.best_error().scaled;
    for (long taken = 0; taken < steps;) {
      renew();
      int inner = 0;
      flat_ = 0;
      for (; inner < most_inner && taken < steps; ++inner) {
        if ((project() || flat_ > 1) && inner > 0) break;
        if (!step()) return false;
        ++taken;
        project();
        if (monitor.after(mapped_, true)) return true;
      }
      centre_ = x_ = mapped_;
      const double error = monitor.last();
      if (inner >= most_inner || error > 2 * error_before)
        sigma_ = std::max(sigma_ / 4, 1.0);
      else if (inner <= few_inner)
        sigma_ = std::min(sigma_ * 4, 1e6);
      error_before = error;
    }
    return false;
  }

 private:
  static constexpr double inner_accuracy = 0.01;
  static constexpr int few_inner = 8, most_inner = 40;

  /// The motion and the term at the centre of the next proximal step.
  void renew() {
    for (int c = 0; c < problem_.size(); ++c) {
      motion_[c] = problem_.motion(c, x_);
      term_[c] = problem_.cone[c].corrected(motion_[c]);
    }
  }

  Vector argument(int c, const Vector& motion) const {
    Vector corrected = motion;
    corrected[0] += term_[c];
    return centre_[c] - sigma_ * corrected;
  }

  /// W y.
  void multiply(const Vectors& y, Vectors& result) const {
    for (int c = 0; c < problem_.size(); ++c) {
      result[c] = problem_.own[c] * y[c];
      for (int k = problem_.first[c]; k < problem_.first[c + 1]; ++k)
        result[c].noalias() += problem_.block[k] * y[problem_.neighbour[k]];
    }
  }
  static double product(const Vectors& a, const Vectors& b) {
    double sum = 0;
    for (std::size_t c = 0; c < a.size(); ++c) sum += a[c].dot(b[c]);
    return sum;
  }

  /// Leaves the projection, its distance from x and W times that; true when the proximal step is near enough.
  bool project() {
    double moved = 0;
    for (int c = 0; c < problem_.size(); ++c) {
      argument_[c] = argument(c, motion_[c]);
      mapped_[c] = problem_.cone[c].project(argument_[c]);
      moved += (mapped_[c] - centre_[c]).squaredNorm();
      change_[c] = mapped_[c] - x_[c];
    }
    multiply(change_, answer_);
    return product(change_, answer_) <= inner_accuracy * inner_accuracy * moved / sigma_;
  }

  double value(double along, const Vectors& direction, const Vectors& moved) const {
    double sum = 0;
    for (int c = 0; c < problem_.size(); ++c) {
      const Vector motion = motion_[c] + along * moved[c], x = x_[c] + along * direction[c];
      sum += 0.5 * x.dot(motion - problem_.q[c]);
      sum += problem_.cone[c].project(argument(c, motion)).squaredNorm() / (2 * sigma_);
    }
    return sum;
  }

  /// A Newton step of x with halving by f. Two where f is flat to rounding are as good as it gets.
  bool step() {
    Eigen::VectorXd right(B * problem_.size());
    for (int c = 0; c < problem_.size(); ++c) {
      left_[c] = sigma_ * problem_.cone[c].derivative(argument_[c]);
      right.template segment<B>(B * c) = change_[c];
    }
    if (!matrix_.factorise(left_, identity_)) return false;
    const Eigen::VectorXd solved = matrix_.solve(right);
    if (!solved.allFinite()) return false;
    Vectors direction(x_.size()), moved(x_.size());
    for (int c = 0; c < problem_.size(); ++c) direction[c] = solved.template segment<B>(B * c);
    multiply(direction, moved);
    const double slope = -product(direction, answer_), here = value(0, direction, moved);
    const double rounding = 1e-12 * std::abs(here);
    flat_ = -slope <= rounding ? flat_ + 1 : 0;
    double along = 1;
    for (int halving = 0; halving < 16; ++halving, along *= 0.5)
      if (value(along, direction, moved) <= here + 1e-4 * along * slope + rounding) break;
    for (int c = 0; c < problem_.size(); ++c) x_[c] += along * direction[c], motion_[c] += along * moved[c];
    return true;
  }

  const ScaledProblem<B>& problem_;
  NewtonMatrix<B>& matrix_;
  double sigma_ = 100;
  int flat_ = 0;  ///< steps in a row, all whole ones, from which f falls by less than its rounding
  Vectors centre_, x_, motion_, argument_, mapped_, change_, answer_;
  std::vector<double> term_;
  std::vector<Block> left_, identity_;
};

}  // namespace galet::cd
