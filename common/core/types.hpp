// Small vectors and tensors in D = 2 or 3 dimensions, and the rotation quantities that differ between them.
#pragma once

#include <array>
#include <cmath>
#include <numbers>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <Eigen/LU>

namespace galet {

template <int D>
using Vec = Eigen::Matrix<double, D, 1>;

template <int D>
using Mat = Eigen::Matrix<double, D, D>;

/// Lattice coordinates of a periodic image: the image of x is x + box * image.
template <int D>
using Image = std::array<int, D>;

/// Angular velocity, torque, rotation: a scalar for disks, a vector for spheres.
template <int D>
struct SpinOf;
template <>
struct SpinOf<2> {
  using type = double;
};
template <>
struct SpinOf<3> {
  using type = Vec<3>;
};
template <int D>
using Spin = typename SpinOf<D>::type;

template <int D>
inline Spin<D> zero_spin() {
  if constexpr (D == 2)
    return 0.0;
  else
    return Vec<3>::Zero();
}

/// a x b as a spin (a torque, when a is a lever arm and b a force).
inline double cross(const Vec<2>& a, const Vec<2>& b) { return a.x() * b.y() - a.y() * b.x(); }
inline Vec<3> cross(const Vec<3>& a, const Vec<3>& b) { return a.cross(b); }

/// spin x b: the velocity at b of a body that turns with `spin`.
inline Vec<2> cross(double spin, const Vec<2>& b) { return {-spin * b.y(), spin * b.x()}; }

/// Product of spins and squared norm, written alike for disks and spheres.
inline double dot(double a, double b) { return a * b; }
inline double dot(const Vec<3>& a, const Vec<3>& b) { return a.dot(b); }
inline double squared(double spin) { return spin * spin; }
inline double squared(const Vec<3>& spin) { return spin.squaredNorm(); }

/// Volume of a grain of diameter d (area for D = 2).
template <int D>
inline double grain_volume(double d) {
  if constexpr (D == 2)
    return std::numbers::pi * d * d / 4;
  else
    return std::numbers::pi * d * d * d / 6;
}

/// I / (m R^2): 1/2 for a disk, 2/5 for a sphere.
template <int D>
inline constexpr double inertia_ratio = D == 2 ? 0.5 : 0.4;

template <int D>
inline Vec<D> lattice(const Mat<D>& box, const Image<D>& image) {
  Vec<D> shift = Vec<D>::Zero();
  for (int a = 0; a < D; ++a)
    if (image[a] != 0) shift += image[a] * box.col(a);
  return shift;
}

}  // namespace galet
