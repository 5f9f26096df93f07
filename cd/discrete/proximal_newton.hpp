// Proximal semismooth Newton for the discrete contact problem: the fixed point of
//   r = P_K(r_k - sigma u^(r)),   u^ = W r + q + (mu |u_T| + mu_R |u_R|) e_N
// is found by Newton's method with a line search, then r_k moves there. The proximal term keeps the Newton matrix
// I + sigma P' T W (T: derivative of u^ by u) regular where W is singular; a large sigma makes few outer steps.
// Sources: Rockafellar 1976; Alart and Curnier 1991. Cost per step: one factorisation, of the size of W or of the
// bodies.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "cd/discrete/monitor.hpp"
#include "cd/discrete/newton_matrix.hpp"

namespace galet::cd {

template <int B>
class ProximalNewton {
 public:
  using Vector = typename ScaledProblem<B>::Vector;
  using Block = typename ScaledProblem<B>::Block;

  ProximalNewton(const ScaledProblem<B>& problem, NewtonMatrix<B>& matrix, std::vector<Vector> start)
      : problem_(problem),
        matrix_(matrix),
        centre_(start),
        r_(std::move(start)),
        tried_(r_.size()),
        mapped_(r_.size()),
        argument_(r_.size()),
        motion_(r_.size()),
        left_(r_.size()),
        identity_(r_.size(), Block::Identity()) {}

  /// Up to `steps` Newton steps; true when the monitor says stop.
  bool solve(long steps, Monitor<B>& monitor) {
    double miss = evaluate(r_);
    for (long taken = 0, inner = 0; taken < steps; ++taken, ++inner) {
      double moved = 0;
      for (std::size_t c = 0; c < r_.size(); ++c) moved += (mapped_[c] - centre_[c]).squaredNorm();
      if (inner > 0 && miss <= inner_accuracy * std::sqrt(moved)) {
        centre_ = mapped_;
        if (inner <= 4) sigma_ = std::min(4 * sigma_, 1e6);
        miss = evaluate(r_), inner = 0;
      } else if (inner >= most_inner) {
        sigma_ = std::max(sigma_ / 4, 1.0);
        centre_ = r_ = mapped_;
        miss = evaluate(r_), inner = 0;
      }
      if (!step(miss)) return false;
      if (monitor.after(mapped_, true)) return true;
    }
    return false;
  }

 private:
  static constexpr double inner_accuracy = 0.1;
  static constexpr long most_inner = 15;

  /// |r - P_K(r_k - sigma u^(r))|; leaves the motion, the argument and the projection.
  double evaluate(const std::vector<Vector>& r) {
    double square = 0;
    for (int c = 0; c < problem_.size(); ++c) {
      motion_[c] = problem_.motion(c, r);
      Vector corrected = motion_[c];
      corrected[0] += problem_.cone[c].corrected(motion_[c]);
      argument_[c] = centre_[c] - sigma_ * corrected;
      mapped_[c] = problem_.cone[c].project(argument_[c]);
      square += (r[c] - mapped_[c]).squaredNorm();
    }
    return std::sqrt(square);
  }

  /// A Newton step with halving; `miss` is renewed.
  bool step(double& miss) {
    Eigen::VectorXd right(B * problem_.size());
    for (int c = 0; c < problem_.size(); ++c) {
      Block change = Block::Identity();
      change.row(0) += problem_.cone[c].corrected_slope(motion_[c]).transpose();
      left_[c] = sigma_ * problem_.cone[c].derivative(argument_[c]) * change;
      right.template segment<B>(B * c) = mapped_[c] - r_[c];
    }
    if (!matrix_.factorise(left_, identity_)) return false;
    const Eigen::VectorXd direction = matrix_.solve(right);
    if (!direction.allFinite()) return false;
    double length = 1, best = std::numeric_limits<double>::infinity(), best_length = 1;
    const auto go = [&](double along) {
      for (int c = 0; c < problem_.size(); ++c) tried_[c] = r_[c] + along * direction.template segment<B>(B * c);
      return evaluate(tried_);
    };
    for (int halving = 0; halving < 8; ++halving, length *= 0.5) {
      const double now = go(length);
      if (now < best) best = now, best_length = length;
      if (now <= (1 - 1e-4 * length) * miss) break;
    }
    miss = go(best_length);
    r_ = tried_;
    return std::isfinite(miss);
  }

  const ScaledProblem<B>& problem_;
  NewtonMatrix<B>& matrix_;
  double sigma_ = 100;
  std::vector<Vector> centre_, r_, tried_, mapped_, argument_, motion_;
  std::vector<Block> left_, identity_;
};

}  // namespace galet::cd
