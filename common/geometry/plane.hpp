// A smooth boundary: a plane, or the surface of a cylinder. Grains stay on the side that its normal points to.
//
// A plane moves with an imposed velocity, or, with a mass, freely along its normal under the grains' forces and a force
// of its own (across the normal always as imposed). A cylinder of radius R_c about an axis through `point` (disks:
// about that point) moves with an imposed velocity and turns about its axis with an imposed spin; grains are inside or
// outside. Next to a grain at x it is its tangent plane at the foot of x, with r the vector from the axis to x and e =
// r / |r|:
//   distance R_c - |r| inside, |r| - R_c outside; normal -e inside, e outside; velocity V + w x (R_c e)
// so that frames, laws and engines know planes only.
#pragma once

#include <cmath>
#include <span>
#include <string>

#include "common/core/types.hpp"

namespace galet {

template <int D>
struct Plane {
  Vec<D> point = Vec<D>::Zero();
  Vec<D> normal = Vec<D>::UnitY();  ///< of a plane: unit vector, from the plane into the grains' side
  Vec<D> velocity = Vec<D>::Zero();
  double inverse_mass = 0;            ///< 1 / mass of a plane that is free along its normal; 0: imposed velocity
  double force = 0;                   ///< on a free plane, along its normal
  double radius = 0;                  ///< R_c of a cylinder; 0: a plane
  bool inside = true;                 ///< of a cylinder: grains are in it, not around it
  Vec<D> axis = Vec<D>::Unit(D - 1);  ///< 3D: unit vector along the axis of a cylinder
  Spin<D> spin = zero_spin<D>();      ///< of a cylinder, about its axis

  bool curved() const { return radius > 0; }
  /// The tip of the lever arm that its surface has in a contact: v_surface = V - lever w x n, n from grain to surface.
  double lever() const { return inside ? -radius : radius; }
};

/// The plane that touches the boundary next to x; a plane itself.
template <int D>
inline Plane<D> tangent_plane(const Plane<D>& boundary, const Vec<D>& x) {
  if (!boundary.curved()) return boundary;
  const Vec<D> away = x - boundary.point;
  Vec<D> along = Vec<D>::Zero();
  if constexpr (D == 3) along = away.dot(boundary.axis) * boundary.axis;
  Vec<D> out = away - along;
  const double distance = out.norm();
  if (distance > 0)
    out /= distance;
  else  // on the axis any direction is as good
    out = D == 2 ? Vec<D>(Vec<D>::UnitX()) : Vec<D>(boundary.axis.unitOrthogonal());
  const Vec<D> arm = boundary.radius * out;
  Plane<D> flat;
  flat.point = boundary.point + along + arm;
  flat.normal = boundary.inside ? Vec<D>(-out) : out;
  flat.velocity = boundary.velocity + cross(boundary.spin, arm);
  return flat;
}

/// "plane 1", "cylinder 0": cylinders come after the planes and are counted from 0 again.
template <int D>
std::string boundary_name(std::span<const Plane<D>> boundaries, std::size_t index) {
  std::size_t before = 0;
  for (std::size_t k = 0; k < index; ++k) before += boundaries[k].curved() == boundaries[index].curved();
  return (boundaries[index].curved() ? "cylinder " : "plane ") + std::to_string(before);
}

/// Distance of x from the boundary, negative behind it.
template <int D>
inline double distance_from(const Plane<D>& boundary, const Vec<D>& x) {
  const Plane<D> flat = tangent_plane(boundary, x);
  return (x - flat.point).dot(flat.normal);
}

/// R* of a grain of radius R at the boundary, for Hertz' law: R at a plane. At a cylinder the contact is an ellipse
/// with the curvatures 1/R along it and 1/R -+ 1/R_c across (- inside); the circle of the mean, R* = sqrt(R_1 R_2), has
/// the same deflection to a few per mille up to R_1 / R_2 = 3 (Johnson 1985, sec. 4.2).
template <int D>
inline double reduced_radius_at(const Plane<D>& boundary, double radius) {
  if (!boundary.curved()) return radius;
  const double share = radius / boundary.radius;
  return radius / std::sqrt(1 + (boundary.inside ? -share : share));
}

}  // namespace galet
