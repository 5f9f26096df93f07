// Linear tangential spring with Coulomb's bound.
//   F_T = -K_T q,  dq/dt = u_T,  norm(F_T) <= mu bound by radial return (q shortened along itself).
// q: tangential elongation of the spring (length), u_T relative tangential velocity.
//
// Integration: q(t) = stored + dt_before/2 u_T(t), and stored' = q(t) + dt_after/2 u_T(t), the trapezoidal rule with
// one velocity per step; the stored column is the elongation half a step ahead.
// In 2D q is a component along the tangent (-n_y, n_x), which turns with the contact: nothing to transport. In 3D q is
// carried by `transport` before use.
// Source: chapter, eqs. linuni and coulomb, sec. lois; objectivity: physics of the rolling contact frame.
#pragma once

#include <cmath>

#include "common/geometry/contact_frame.hpp"

namespace galet::md {

struct TangentialLaw {
  double stiffness;    ///< K_T
  double friction;     ///< mu
  double half_before;  ///< dt_before / 2
  double half_after;   ///< dt_after / 2
};

/// F_T along the tangent in 2D; updates the stored elongation.
inline double tangential_linear(const TangentialLaw& law, double bound, double slip, double& spring) {
  double elongation = spring + law.half_before * slip;
  const double limit = law.friction * bound;
  if (law.stiffness * std::abs(elongation) > limit) elongation = std::copysign(limit / law.stiffness, elongation);
  spring = elongation + law.half_after * slip;
  return -law.stiffness * elongation;
}

/// The same for spheres; `slip` and `spring` lie in the tangent plane.
inline Vec<3> tangential_linear(const TangentialLaw& law, double bound, const Vec<3>& slip, Vec<3>& spring) {
  Vec<3> elongation = spring + law.half_before * slip;
  const double limit = law.friction * bound;
  const double force_squared = law.stiffness * law.stiffness * elongation.squaredNorm();
  if (force_squared > limit * limit) elongation *= limit / std::sqrt(force_squared);
  spring = elongation + law.half_after * slip;
  return -law.stiffness * elongation;
}

/// Carries a vector of the tangent plane of `before` to that of `after` (unit normals): by the smallest rotation that
/// takes one normal to the other, then by the angle `twist` about the new normal (mean spin of the two grains times
/// dt). Both steps keep the norm to rounding, so that a loaded pair that turns rigidly keeps its tangential force.
inline Vec<3> transport(const Vec<3>& value, const Vec<3>& before, const Vec<3>& after, double twist) {
  const Vec<3> moved = carried(value, before, after);
  // The rotation by `twist`, with tan(twist/2) ~ twist/2: exact in norm, third order in the angle.
  const double half = 0.5 * twist, scale = 1 / (1 + half * half);
  return (1 - half * half) * scale * moved + 2 * half * scale * after.cross(moved);
}

}  // namespace galet::md
