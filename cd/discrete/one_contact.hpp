// The contact problem of one contact alone, solved exactly: u = W r + b with Coulomb's law.
//   b_N >= 0: r = 0; else stick, r = -W^-1 b, where that lies in the cone; else slip.
// Slip in 2D: r_T = s mu r_N with s = +-1 against the motion. In 3D the impulse opposes the sliding velocity,
//   r_T = -(S + a I)^-1 beta,  a > 0 the root of |r_T| = mu r_N     (a = |u_T| / |r_T|)
// with S the Schur complement of W_NN, found by Newton's iteration within a bracket. Blocks of spheres have a closed
// form in every dimension. Blocks that roll and are not diagonal are iterated by projections.
// Source: Jourdan, Alart and Jean 1998; De Saxce and Feng 1998. Errors: none; where W_NN = 0 the answer is r = 0.
#pragma once

#include <cmath>
#include <limits>
#include <utility>

#include <Eigen/LU>

#include "cd/discrete/cone.hpp"

namespace galet::cd {

template <int B>
using BlockOf = Eigen::Matrix<double, B, B, Eigen::RowMajor>;

/// For W_NN, W_TT I and W_RR I.
template <int B>
inline typename Cone<B>::Vector solve_plain_contact(const BlockOf<B>& w, const typename Cone<B>::Vector& b,
                                                    const Cone<B>& cone) {
  typename Cone<B>::Vector r = Cone<B>::Vector::Zero();
  if (b[0] >= 0 || !(w(0, 0) > 0)) return r;
  r[0] = -b[0] / w(0, 0);
  const auto held = [](const auto& motion, double weight, double bound) {
    const double norm = motion.norm();
    // What would stop the motion, or all that the bound allows.
    if (norm > bound * weight) return -bound / norm;
    return weight > 0 ? -1 / weight : 0.0;
  };
  const auto sliding = Cone<B>::sliding(b);
  r.template segment<Cone<B>::tangential>(1) = held(sliding, w(1, 1), cone.mu * r[0]) * sliding;
  if constexpr (Cone<B>::rolling) {
    const auto turning = Cone<B>::turning(b);
    r.template tail<2>() = held(turning, w(3, 3), cone.mu_r * r[0]) * turning;
  }
  return r;
}

inline Eigen::Vector2d solve_contact(const BlockOf<2>& w, const Eigen::Vector2d& b, const Cone<2>& cone,
                                     const Eigen::Vector2d&) {
  if (b[0] >= 0 || !(w(0, 0) > 0)) return Eigen::Vector2d::Zero();
  const double determinant = w.determinant();
  double side = b[1] > 0 ? -1 : 1;
  if (determinant > 1e-12 * w(0, 0) * w(1, 1)) {
    const Eigen::Vector2d r(-(w(1, 1) * b[0] - w(0, 1) * b[1]) / determinant,
                            -(w(0, 0) * b[1] - w(1, 0) * b[0]) / determinant);
    if (r[0] >= 0 && std::abs(r[1]) <= cone.mu * r[0]) return r;
    side = r[1] > 0 ? 1 : -1;
  }
  for (int attempt = 0; attempt < 2; ++attempt, side = -side) {
    const double weight = w(0, 0) + side * cone.mu * w(0, 1);
    if (!(weight > 0)) continue;
    const double normal = -b[0] / weight;
    const double sliding = b[1] + (w(1, 0) + side * cone.mu * w(1, 1)) * normal;
    if (side * sliding <= 0 || attempt == 1) return {normal, side * cone.mu * normal};
  }
  return Eigen::Vector2d::Zero();
}

/// The slipping impulse as a function of a = |u_T| / |r_T|.
struct SlipOfSpheres {
  Eigen::Matrix2d schur;
  Eigen::Vector2d beta, coupling;  ///< coupling: W_NT
  double b_n, w_n;

  SlipOfSpheres(const BlockOf<3>& w, const Eigen::Vector3d& b)
      : schur(w.bottomRightCorner<2, 2>() - w.bottomLeftCorner<2, 1>() * w.topRightCorner<1, 2>() / w(0, 0)),
        beta(b.tail<2>() - w.bottomLeftCorner<2, 1>() * (b[0] / w(0, 0))),
        coupling(w.topRightCorner<1, 2>().transpose()),
        b_n(b[0]),
        w_n(w(0, 0)) {}

  Eigen::Vector3d impulse(double a) const {
    const Eigen::Vector2d t = -(schur + a * Eigen::Matrix2d::Identity()).inverse() * beta;
    return {-(b_n + coupling.dot(t)) / w_n, t[0], t[1]};
  }
  /// |r_T| - mu r_N and its derivative in a.
  std::pair<double, double> excess(double a, double mu, Eigen::Vector3d& r) const {
    const Eigen::Matrix2d inverse = (schur + a * Eigen::Matrix2d::Identity()).inverse();
    const Eigen::Vector2d t = -inverse * beta, change = -inverse * t;
    r = {-(b_n + coupling.dot(t)) / w_n, t[0], t[1]};
    const double norm = t.norm();
    return {norm - mu * r[0], (norm > 0 ? t.dot(change) / norm : 0) + mu * coupling.dot(change) / w_n};
  }
};

inline Eigen::Vector3d solve_contact(const BlockOf<3>& w, const Eigen::Vector3d& b, const Cone<3>& cone,
                                     const Eigen::Vector3d&) {
  if (b[0] >= 0 || !(w(0, 0) > 0)) return Eigen::Vector3d::Zero();
  if (cone.mu == 0) return {-b[0] / w(0, 0), 0, 0};
  const SlipOfSpheres slip(w, b);
  const double size = w(1, 1) + w(2, 2);
  Eigen::Vector3d r;
  if (slip.schur.determinant() > 1e-14 * w(1, 1) * w(2, 2)) {
    r = slip.impulse(0);
    if (std::hypot(r[1], r[2]) <= cone.mu * r[0]) return r;
  }
  double low = 0, high = std::numeric_limits<double>::infinity();
  double a = std::max(slip.beta.norm() / (cone.mu * -b[0] / w(0, 0)) - 0.25 * size, 1e-8 * size);
  for (int round = 0; round < 60; ++round) {
    const auto [excess, slope] = slip.excess(a, cone.mu, r);
    if (std::abs(excess) <= 1e-15 * (std::hypot(r[1], r[2]) + cone.mu * std::abs(r[0]))) break;
    (excess > 0 ? low : high) = a;
    double next = a - excess / slope;
    if (!(slope < 0) || !(next > low && next < high)) next = high < 1e300 ? 0.5 * (low + high) : 2 * a + size;
    if (std::abs(next - a) <= 1e-15 * a) break;
    a = next;
  }
  r[0] = std::max(0.0, r[0]);
  r.tail<2>() *= kept(r.tail<2>().norm(), cone.mu * r[0]);
  return r;
}

/// Projections with the step 1.6 / trace(W), from the impulse `before`.
inline Cone<5>::Vector solve_contact(const BlockOf<5>& w, const Cone<5>::Vector& b, const Cone<5>& cone,
                                     const Cone<5>::Vector& before) {
  if (b[0] >= 0 || !(w(0, 0) > 0)) return Cone<5>::Vector::Zero();
  Cone<5>::Vector r = before;
  const double step = 1.6 / w.trace();
  for (int round = 0; round < 200; ++round) {
    Cone<5>::Vector u = b + w * r;
    u[0] += cone.corrected(u);
    const Cone<5>::Vector next = cone.project(r - step * u);
    const double change = (next - r).squaredNorm();
    r = next;
    if (change <= 1e-28 * r.squaredNorm()) break;
  }
  return r;
}

}  // namespace galet::cd
