// The frame of a contact: what a law needs to know of the geometry. Signs: core/conventions.hpp.
#pragma once

#include "common/core/inline.hpp"
#include "common/core/types.hpp"
#include "common/geometry/plane.hpp"

namespace galet {

template <int D>
struct ContactFrame {
  Vec<D> normal;    ///< n, unit vector from i to j
  Vec<D> branch;    ///< b = distance * n
  double distance;  ///< |b|
  double gap;       ///< g = |b| - R_i - R_j
  double stretch;   ///< |b| / (R_i + R_j): lever arms are l = stretch * R
};

/// Frame of grains i and j, `branch` from i to the image of j; `distance_squared` its square.
template <int D>
inline ContactFrame<D> grain_frame(const Vec<D>& branch, double distance_squared, double radius_i, double radius_j) {
  ContactFrame<D> frame;
  frame.distance = std::sqrt(distance_squared);
  frame.normal = branch / frame.distance;
  frame.branch = branch;
  frame.gap = frame.distance - (radius_i + radius_j);
  frame.stretch = frame.distance / (radius_i + radius_j);
  return frame;
}

/// Frame of a grain and a boundary. The branch ends on the boundary.
template <int D>
inline ContactFrame<D> plane_frame(const Vec<D>& position, double radius, const Plane<D>& boundary) {
  const Plane<D> plane = tangent_plane(boundary, position);
  ContactFrame<D> frame;
  frame.distance = (position - plane.point).dot(plane.normal);
  frame.normal = -plane.normal;
  frame.branch = frame.distance * frame.normal;
  frame.gap = frame.distance - radius;
  frame.stretch = frame.distance / radius;
  return frame;
}

/// A vector of the tangent plane of `before`, carried to that of `after` (unit normals) by the smallest rotation that
/// takes one normal to the other; its norm is kept to rounding.
GALET_INLINE Vec<3> carried(const Vec<3>& value, const Vec<3>& before, const Vec<3>& after) {
  const Vec<3> turned = value - (after.dot(value) / (1 + before.dot(after))) * (before + after);
  return turned - after.dot(turned) * after;  // keeps rounding from building up along the normal
}

/// The tangent that makes (n, t) right-handed in 2D: u_T and F_T of a disk contact are scalars along it.
inline Vec<2> tangent(const Vec<2>& normal) { return {-normal.y(), normal.x()}; }

}  // namespace galet
