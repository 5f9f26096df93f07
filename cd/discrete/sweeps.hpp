// Sweeps over the contacts of a discrete problem: each contact in turn is given a new impulse for the motion that the
// others cause at that moment. A sweep is a map of impulses to impulses whose fixed points are the solutions; what is
// made of it (momentum, conjugate directions) is cd/discrete/iterations.hpp.
#pragma once

#include <algorithm>
#include <vector>

#include "cd/discrete/one_contact.hpp"
#include "cd/discrete/scaled_problem.hpp"

namespace galet::cd {

/// Gauss-Seidel with the exact solution of each contact (Moreau 1994; Jean 1999).
template <int B>
class ExactSweep {
 public:
  using Vector = typename ScaledProblem<B>::Vector;
  explicit ExactSweep(const ScaledProblem<B>& problem) : problem_(problem) {}
  const ScaledProblem<B>& problem() const { return problem_; }

  void operator()(std::vector<Vector>& r) {
    if (problem_.diagonal) {
      for (int c = 0; c < problem_.size(); ++c)
        r[c] = solve_plain_contact<B>(problem_.own[c], problem_.free_motion(c, r), problem_.cone[c]);
    } else {
      for (int c = 0; c < problem_.size(); ++c)
        r[c] = solve_contact(problem_.own[c], problem_.free_motion(c, r), problem_.cone[c], r[c]);
    }
  }

 private:
  const ScaledProblem<B>& problem_;
};

/// Projected Gauss-Seidel: r <- P_K(r - w (u + s e_N)) with w = 1 / (1.02 lambda_max(W_cc)), s the term of De Saxce.
/// With `frozen` = 0 s is that of the present motion; else it is renewed once in so many sweeps, which are then steps
/// of a convex problem. No contact is solved, so blocks of any shape cost the same.
template <int B>
class ProjectedSweep {
 public:
  using Vector = typename ScaledProblem<B>::Vector;
  ProjectedSweep(const ScaledProblem<B>& problem, int frozen, const std::vector<Vector>& r)
      : problem_(problem), frozen_(frozen), step_(problem.size()), term_(problem.size()), motion_(problem.size()) {
    for (int c = 0; c < problem.size(); ++c) {
      // The largest singular value also where W is not quite symmetric.
      const auto& own = problem.own[c];
      const double largest = std::sqrt(largest_eigenvalue(own.transpose() * own));
      step_[c] = largest > 0 ? 1 / (1.02 * largest) : 0;
      motion_[c] = problem.motion(c, r);
    }
    renew();
  }
  const ScaledProblem<B>& problem() const { return problem_; }

  void operator()(std::vector<Vector>& r) {
    if (frozen_ > 0 && ++age_ > frozen_) renew();
    for (int c = 0; c < problem_.size(); ++c) {
      const Cone<B>& cone = problem_.cone[c];
      Vector u = problem_.motion(c, r);
      motion_[c] = u;
      u[0] += frozen_ > 0 ? term_[c] : cone.corrected(u);
      r[c] = cone.project(r[c] - step_[c] * u);
    }
  }

 private:
  static double largest_eigenvalue(const Eigen::Matrix<double, B, B>& square) {
    Vector x = Vector::LinSpaced(1, 1.4);
    double largest = 0;
    for (int round = 0; round < 60; ++round) {
      const Vector y = square * x;
      largest = y.norm() / x.norm();
      if (!(largest > 0)) return 0;
      x = y / y.norm();
    }
    return largest;
  }
  void renew() {
    age_ = 1;
    for (int c = 0; c < problem_.size(); ++c) term_[c] = problem_.cone[c].corrected(motion_[c]);
  }

  const ScaledProblem<B>& problem_;
  int frozen_, age_ = 0;
  std::vector<double> step_, term_;
  std::vector<Vector> motion_;
};

}  // namespace galet::cd
