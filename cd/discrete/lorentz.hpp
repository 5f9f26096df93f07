// The Lorentz cone {x : x_0 >= |x_T|} of M numbers, its Jordan algebra, and the scaling of Nesterov and Todd.
// Sources: Alizadeh and Goldfarb 2003; Nesterov and Todd 1998.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Core>

namespace galet::cd {

template <int M>
struct Lorentz {
  using Vector = Eigen::Matrix<double, M, 1>;
  using Matrix = Eigen::Matrix<double, M, M>;

  /// x_0^2 - |x_T|^2, without cancellation near the boundary.
  static double determinant(const Vector& x) {
    const double norm = x.template tail<M - 1>().norm();
    return std::max((x[0] - norm) * (x[0] + norm), 1e-300);
  }
  static Vector mirrored(const Vector& x) {
    Vector y = -x;
    y[0] = x[0];
    return y;
  }
  static Vector inverse(const Vector& x) { return mirrored(x) / determinant(x); }

  static Vector product(const Vector& a, const Vector& b) {
    Vector p = a[0] * b + b[0] * a;
    p[0] = a.dot(b);
    return p;
  }
  /// y with product(a, y) = p.
  static Vector quotient(const Vector& p, const Vector& a) {
    Vector y;
    y[0] = (a[0] * p[0] - a.template tail<M - 1>().dot(p.template tail<M - 1>())) / determinant(a);
    y.template tail<M - 1>() = (p.template tail<M - 1>() - y[0] * a.template tail<M - 1>()) / a[0];
    return y;
  }

  /// The largest s for which x + s d is in the cone, x inside; infinity when all are.
  static double largest_step(const Vector& x, const Vector& d) {
    const double a = d[0] * d[0] - d.template tail<M - 1>().squaredNorm();
    const double b = x[0] * d[0] - x.template tail<M - 1>().dot(d.template tail<M - 1>());
    const double c = determinant(x), discriminant = b * b - a * c;
    double step = std::numeric_limits<double>::infinity();
    const auto try_root = [&](double root) {
      if (root > 0) step = std::min(step, root);
    };
    if (a == 0) {
      if (b < 0) try_root(-c / (2 * b));
    } else if (discriminant >= 0) {
      const double sum = b + (b >= 0 ? 1 : -1) * std::sqrt(discriminant);
      try_root(-sum / a);
      if (sum != 0) try_root(-c / sum);
    }
    if (d[0] < 0) try_root(-x[0] / d[0]);
    return step;
  }
};

/// G = eta (2 w w^T - J), symmetric, with G x = z for x and z inside the cone.
template <int M>
struct NesterovTodd {
  using Vector = typename Lorentz<M>::Vector;
  using Matrix = typename Lorentz<M>::Matrix;

  Vector w = Vector::Unit(0);
  double eta = 1;

  NesterovTodd() = default;
  NesterovTodd(const Vector& x, const Vector& z) {
    const double size_x = std::sqrt(Lorentz<M>::determinant(x)), size_z = std::sqrt(Lorentz<M>::determinant(z));
    const double half_sum = std::sqrt(0.5 * (1 + x.dot(z) / (size_x * size_z)));
    w = (Lorentz<M>::mirrored(x) / size_x + z / size_z) / (2 * half_sum);
    eta = size_z / size_x;
  }

  Matrix matrix() const {
    Matrix g = 2 * w * w.transpose() + Matrix::Identity();
    g(0, 0) -= 2;
    return eta * g;
  }
  /// G^(1/2) v.
  Vector root(const Vector& v) const { return std::sqrt(eta) * half(w, v); }
  /// G^(-1/2) v.
  Vector inverse_root(const Vector& v) const { return half(Lorentz<M>::mirrored(w), v) / std::sqrt(eta); }

 private:
  static Vector half(const Vector& w, const Vector& v) {
    const double along = w.template tail<M - 1>().dot(v.template tail<M - 1>());
    Vector result = v + (v[0] + along / (1 + w[0])) * w;
    result[0] = w[0] * v[0] + along;
    return result;
  }
};

}  // namespace galet::cd
