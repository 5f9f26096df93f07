// Primal-dual interior point for the discrete contact problem, with the term of De Saxce inside the Newton matrix.
//
// With x = (mu r_N, r_T) and z in the Lorentz cone (a second pair for rolling, sharing r_N), the problem is
//   u_T = z_T,   u_N = sum over the pairs of mu (z_0 - |z_T|),   x o z = 0,   u = W r + q
// and x o z is driven from nu to zero. In the scaling of Nesterov and Todd a step solves
//   (W + sum K G L) dr = sum K c - residual,   L = diag(mu, 1, 1), K = L with -mu z_T / |z_T| in its first row,
//   c = -z + sigma nu x^-1 - correction,   dz = c - G L dr      (Mehrotra's predictor and corrector).
// |z_T| is not smoothed: a smoothed norm floors the error at 1e-6. Reaches high accuracy in few steps on small and
// hyperstatic problems; jams on large frictional piles.
// Sources: Mehrotra 1992; Acary, Armand and Nguyen 2023. Cost per step: one factorisation of W + block diagonal, or of
// the bodies.
#pragma once

#include <array>
#include <vector>

#include "cd/discrete/lorentz.hpp"
#include "cd/discrete/monitor.hpp"
#include "cd/discrete/newton_matrix.hpp"

namespace galet::cd {

template <int B>
class InteriorPoint {
 public:
  static constexpr int M = B == 2 ? 2 : 3;      ///< numbers of a cone
  static constexpr int pairs = B == 5 ? 2 : 1;  ///< cones of a contact
  using Vector = typename ScaledProblem<B>::Vector;
  using Block = typename ScaledProblem<B>::Block;
  using Point = typename Lorentz<M>::Vector;

  InteriorPoint(const ScaledProblem<B>& problem, NewtonMatrix<B>& matrix)
      : problem_(problem),
        matrix_(matrix),
        r_(problem.size()),
        added_(problem.size()),
        cones_(pairs * problem.size()) {}

  /// Up to `steps` steps from the middle of the cones; true when the monitor says stop.
  bool solve(long steps, Monitor<B>& monitor) {
    if (problem_.size() == 0) return true;
    start();
    for (long step = 0; step < steps; ++step) {
      if (!advance()) return false;
      if (monitor.after(r_, true)) return true;
    }
    return false;
  }

 private:
  struct ConePair {
    Point x, z, dx, dz, right;
    NesterovTodd<M> scaling;
  };

  double bound(int c, int pair) const {
    const Cone<B>& cone = problem_.cone[c];
    return std::max(pair == 0 ? cone.mu : cone.mu_r, 1e-10);  // a cone needs an inside
  }
  /// L r: the point of a pair that belongs to an impulse.
  Point point_of(int c, int pair, const Vector& r) const {
    Point x;
    x[0] = bound(c, pair) * r[0];
    x.template tail<M - 1>() = r.template segment<M - 1>(1 + 2 * pair);
    return x;
  }
  /// K y: adds a pair's point to the motions that it stands for.
  void add_motion(int c, int pair, const Point& z, const Point& y, Vector& u) const {
    const auto tangent = z.template tail<M - 1>();
    const double norm = tangent.norm();
    const double along = norm > 0 ? tangent.dot(y.template tail<M - 1>()) / norm : 0;
    u[0] += bound(c, pair) * (y[0] - along);
    u.template segment<M - 1>(1 + 2 * pair) += y.template tail<M - 1>();
  }

  void start() {
    double square = 0;
    for (const Vector& q : problem_.q) square += q.squaredNorm();
    const double size = std::max(1e-12, std::sqrt(square / problem_.size()));
    for (int c = 0; c < problem_.size(); ++c) {
      r_[c] = size * Vector::Unit(0);
      for (int pair = 0; pair < pairs; ++pair) {
        cones_[pairs * c + pair].x = point_of(c, pair, r_[c]);
        cones_[pairs * c + pair].z = size * Point::Unit(0);
      }
    }
  }

  double gap(double step) const {
    double sum = 0;
    for (const ConePair& cone : cones_) sum += (cone.x + step * cone.dx).dot(cone.z + step * cone.dz);
    return sum;
  }

  bool advance() {
    for (ConePair& cone : cones_) cone.dx.setZero(), cone.dz.setZero();
    const double before = gap(0), nu = before / static_cast<double>(cones_.size());
    for (int c = 0; c < problem_.size(); ++c) {
      added_[c].setZero();
      for (int pair = 0; pair < pairs; ++pair) add_block(c, pair);
    }
    if (!matrix_.factorise(added_)) return false;
    set_right(0, nu, false);
    find_direction();
    predictor_ = std::min(1.0, largest_step());
    const double ratio = std::max(0.0, gap(predictor_) / before);
    set_right(std::min(1.0, ratio * ratio * ratio), nu, true);
    const Eigen::VectorXd change = find_direction();
    const double step = std::min(1.0, 0.995 * largest_step());
    if (!std::isfinite(step) || !change.allFinite()) return false;
    for (int c = 0; c < problem_.size(); ++c) {
      r_[c] += step * change.template segment<B>(B * c);
      for (int pair = 0; pair < pairs; ++pair) {
        ConePair& cone = cones_[pairs * c + pair];
        cone.z += step * cone.dz;
        cone.x = point_of(c, pair, r_[c]);
      }
    }
    return true;
  }

  /// Adds K G L of a pair.
  void add_block(int c, int pair) {
    ConePair& cone = cones_[pairs * c + pair];
    cone.scaling = NesterovTodd<M>(cone.x, cone.z);
    const typename Lorentz<M>::Matrix g = cone.scaling.matrix();
    for (int k = 0; k < M; ++k) {
      Vector column = Vector::Zero();
      add_motion(c, pair, cone.z, g.col(k), column);
      if (k == 0)
        added_[c].col(0) += bound(c, pair) * column;
      else
        added_[c].col(k + 2 * pair) += column;
    }
  }

  void set_right(double sigma, double nu, bool corrected) {
    for (ConePair& cone : cones_) {
      cone.right = sigma * nu * Lorentz<M>::inverse(cone.x) - cone.z;
      if (!corrected) continue;
      const NesterovTodd<M>& scaling = cone.scaling;
      const Point product =
          Lorentz<M>::product(scaling.root(predictor_ * cone.dx), scaling.inverse_root(predictor_ * cone.dz));
      cone.right -= scaling.root(Lorentz<M>::quotient(product, scaling.root(cone.x)));
    }
  }

  Eigen::VectorXd find_direction() {
    Eigen::VectorXd right(B * problem_.size());
    for (int c = 0; c < problem_.size(); ++c) {
      Vector sum = Vector::Zero();
      // The motion that z stands for, and what is asked of its change.
      for (int pair = 0; pair < pairs; ++pair) {
        const ConePair& cone = cones_[pairs * c + pair];
        add_motion(c, pair, cone.z, cone.z, sum);
        add_motion(c, pair, cone.z, cone.right, sum);
      }
      right.template segment<B>(B * c) = sum - problem_.motion(c, std::span<const Vector>(r_));
    }
    const Eigen::VectorXd change = matrix_.solve(right);
    for (int c = 0; c < problem_.size(); ++c)
      for (int pair = 0; pair < pairs; ++pair) {
        ConePair& cone = cones_[pairs * c + pair];
        cone.dx = point_of(c, pair, change.template segment<B>(B * c));
        cone.dz = cone.right - cone.scaling.matrix() * cone.dx;
      }
    return change;
  }

  double largest_step() const {
    double step = std::numeric_limits<double>::infinity();
    for (const ConePair& cone : cones_)
      step = std::min({step, Lorentz<M>::largest_step(cone.x, cone.dx), Lorentz<M>::largest_step(cone.z, cone.dz)});
    return step;
  }

  const ScaledProblem<B>& problem_;
  NewtonMatrix<B>& matrix_;
  std::vector<Vector> r_;
  std::vector<Block> added_;
  std::vector<ConePair> cones_;
  double predictor_ = 1;
};

}  // namespace galet::cd
