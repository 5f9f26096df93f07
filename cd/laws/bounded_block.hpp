// One contact whose block of W is full, with sliding, rolling and pivoting bounded at once: u = W r + b,
//
//   0 <= u_N  perp  r_N >= 0
//   |r_p| <= mu_p r_N,   r_p opposite to u_p where |r_p| = mu_p r_N, else u_p = 0        for each part p
//
// b_N >= 0: r = 0. Else parts are scaled to blocks of unit mean diagonal, and Newton's method goes over
//   u_N = 0,   r_p = P_p(r_p - u_p),   P_p: radial projection on |r_p| <= mu_p r_N
// Where it does not end, rounds of projections take r to another start. What nothing can move makes W
// singular: W + delta and b - delta r(before) take the places of W and b, delta = 1e-12 in scaled units, which leaves
// the fixed points of sweeps where they are.
// r: impulses (N s; N m s of rolling and pivoting), u: velocities and rates of rotation, mu_p: 1, or lengths.
// Source: Alart and Curnier 1991. Errors: none; where W_NN = 0 the answer is r = 0, and where there is no solution (a
// body on a fixed axis can jam) it is what projections reach. Cost: about two (disks) to five solutions of B equations.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include <Eigen/Core>
#include <Eigen/LU>

#include "cd/laws/cone_projection.hpp"

namespace galet::cd {

template <int B, std::size_t N>
class BoundedBlock {
 public:
  using Vector = Eigen::Matrix<double, B, 1>;
  using Matrix = Eigen::Matrix<double, B, B, Eigen::RowMajor>;

  /// Part p has the numbers first[p] .. first[p + 1] of the block and the bound mu[p]; number 0 is the normal one.
  BoundedBlock(const Matrix& w, const Vector& b, const std::array<int, N + 1>& first, const std::array<double, N>& mu)
      : first_(first), mu_(mu), movable_(w(0, 0) > 0) {
    if (!movable_) return;
    scale_[0] = std::sqrt(w(0, 0));
    for (std::size_t p = 0; p < N; ++p) {
      double mean = 0;
      for (int a = first[p]; a < first[p + 1]; ++a) mean += w(a, a) / (first[p + 1] - first[p]);
      if (!(mean > 0)) mu_[p] = 0;  // nothing turns the contact that way: no impulse, of the many that would do
      const double unit = mean > 0 ? std::sqrt(mean) : 1;
      for (int a = first[p]; a < first[p + 1]; ++a) scale_[a] = unit;
      mu_[p] *= unit / scale_[0];
    }
    w_ = scale_.cwiseInverse().asDiagonal() * w * scale_.cwiseInverse().asDiagonal();
    b_ = b.cwiseQuotient(scale_);
  }

  /// The impulse; `before` is where the search starts.
  Vector solve(const Vector& before) {
    if (!movable_ || b_[0] >= 0) return Vector::Zero();
    Vector r = before.cwiseProduct(scale_);
    w_.diagonal().array() += shift;
    b_ -= shift * r;
    if (!(r[0] > 0)) r = -b_[0] / w_(0, 0) * Vector::Unit(0);
    for (const int rounds : {20, 100, 500}) {
      if (newton(r)) break;
      project(r, rounds);
    }
    return r.cwiseQuotient(scale_);
  }

 private:
  static constexpr double shift = 1e-12;

  struct Linear {
    Vector miss;   ///< of the laws
    Matrix slope;  ///< how it changes with r
  };

  /// Norm of part p.
  double norm(const Vector& values, std::size_t p) const {
    double sum = 0;
    for (int a = first_[p]; a < first_[p + 1]; ++a) sum += values[a] * values[a];
    return std::sqrt(sum);
  }

  /// False where it does not end; r is then left as it was.
  bool newton(Vector& r) const {
    Vector now = r;
    for (int round = 0; round < 30; ++round) {
      const Linear at = linearised(now);
      const Vector step = at.slope.partialPivLu().solve(at.miss);
      if (!step.allFinite()) return false;
      now -= step;
      if (!(now[0] > 0)) {
        now[0] = -0.01 * b_[0] / w_(0, 0);
      } else if (step.squaredNorm() <= 1e-28 * now.squaredNorm()) {
        r = now;
        return true;
      }
    }
    return false;
  }

  Linear linearised(const Vector& r) const {
    const Vector u = w_ * r + b_;
    Linear at{u, w_};
    const Matrix turned = Matrix::Identity() - w_;  // how r - u changes with r
    const Vector wanted = r - u;
    for (std::size_t p = 0; p < N; ++p) {
      const double length = norm(wanted, p), bound = mu_[p] * r[0];
      if (length <= bound && bound > 0) continue;
      const Vector along = length > 0 ? Vector(wanted / length) : Vector(Vector::Zero());
      // The direction e turns by (I - e e^T) (I - W) / |r_p - u_p|.
      Eigen::Matrix<double, 1, B> own = Eigen::Matrix<double, 1, B>::Zero();
      for (int a = first_[p]; a < first_[p + 1]; ++a) own += along[a] * turned.row(a);
      for (int a = first_[p]; a < first_[p + 1]; ++a) {
        at.miss[a] = r[a] - bound * along[a];
        at.slope.row(a).setZero();
        if (bound > 0) at.slope.row(a) = (along[a] * own - turned.row(a)) * (bound / length);
        at.slope(a, a) += 1;
        at.slope(a, 0) -= mu_[p] * along[a];
      }
    }
    return at;
  }

  /// The normal part by its own law, then the others with a step below 2 / |W|.
  void project(Vector& r, int rounds) const {
    for (int round = 0; round < rounds; ++round) {
      r[0] = std::max(0.0, r[0] - (w_.row(0).dot(r) + b_[0]) / w_(0, 0));
      const Vector next = r - (w_ * r + b_) / (B - 1);
      for (std::size_t p = 0; p < N; ++p) {
        const double share = kept(norm(next, p), mu_[p] * r[0]);
        for (int a = first_[p]; a < first_[p + 1]; ++a) r[a] = share * next[a];
      }
    }
  }

  Matrix w_;
  Vector b_;
  Vector scale_ = Vector::Ones();
  std::array<int, N + 1> first_;
  std::array<double, N> mu_;
  bool movable_;
};

}  // namespace galet::cd
