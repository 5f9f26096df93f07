// The cone of the bounds of one contact in blocks of B numbers, K = {|r_T| <= mu r_N, |r_R| <= mu_R r_N}, and the term
// of De Saxce that makes Coulomb's law a complementarity on it: K* contains u^ = u + (mu |u_T| + mu_R |u_R|) e_N.
// Source: De Saxce and Feng 1998; with rolling Acary and Bourrier 2021.
#pragma once

#include <Eigen/Core>

#include "cd/laws/cone_projection.hpp"

namespace galet::cd {

template <int B>
struct Cone {
  static_assert(B == 2 || B == 3 || B == 5, "blocks: disks, spheres, spheres that roll");
  static constexpr int tangential = B == 2 ? 1 : 2;
  static constexpr bool rolling = B == 5;
  using Vector = Eigen::Matrix<double, B, 1>;

  double mu = 0, mu_r = 0;

  static auto sliding(const Vector& x) { return x.template segment<tangential>(1); }
  static auto turning(const Vector& x) { return x.template tail<2>(); }

  /// mu |u_T| + mu_R |u_R|.
  double corrected(const Vector& u) const {
    double term = mu * sliding(u).norm();
    if constexpr (rolling) term += mu_r * turning(u).norm();
    return term;
  }

  Vector project(const Vector& x) const {
    Vector r;
    const double norm = sliding(x).norm();
    if constexpr (!rolling) {
      if (mu * norm <= -x[0]) return Vector::Zero();  // first: without friction the next holds for x_N < 0 too
      if (norm <= mu * x[0]) return x;
      r[0] = (x[0] + mu * norm) / (1 + mu * mu);
      r.template segment<tangential>(1) = (mu * r[0] / norm) * sliding(x);
    } else {
      const double turned = turning(x).norm();
      r[0] = projected_normal<2>(x[0], {norm, turned}, {mu, mu_r});
      r.template segment<2>(1) = kept(norm, mu * r[0]) * sliding(x);
      r.template tail<2>() = kept(turned, mu_r * r[0]) * turning(x);
    }
    return r;
  }

  using Matrix = Eigen::Matrix<double, B, B>;

  /// A generalised derivative of project() at x.
  Matrix derivative(const Vector& x) const {
    const Vector r = project(x);
    if (r[0] <= 0) return Matrix::Zero();
    Matrix result = Matrix::Zero();
    Vector edge = Vector::Unit(0);  // how r changes with its normal part
    double weight = 1;
    const auto add_part = [&](int at, auto part, double bound) {
      constexpr int count = decltype(part)::RowsAtCompileTime;
      const double norm = part.norm();
      auto square = result.template block<count, count>(at, at);
      if (norm <= bound * r[0]) {
        square.diagonal().array() += 1;
        return;
      }
      const Eigen::Matrix<double, count, 1> direction = part / norm;
      edge.template segment<count>(at) = bound * direction;
      weight += bound * bound;
      square.diagonal().array() += bound * r[0] / norm;
      square -= bound * r[0] / norm * direction * direction.transpose();
    };
    add_part(1, Eigen::Matrix<double, tangential, 1>(sliding(x)), mu);
    if constexpr (rolling) add_part(3, Eigen::Vector2d(turning(x)), mu_r);
    result += edge * edge.transpose() / weight;
    return result;
  }

  /// The derivative of corrected() at u.
  Vector corrected_slope(const Vector& u) const {
    Vector slope = Vector::Zero();
    const double norm = sliding(u).norm();
    if (norm > 0) slope.template segment<tangential>(1) = mu / norm * sliding(u);
    if constexpr (rolling) {
      const double turned = turning(u).norm();
      if (turned > 0) slope.template tail<2>() = mu_r / turned * turning(u);
    }
    return slope;
  }
};

}  // namespace galet::cd
