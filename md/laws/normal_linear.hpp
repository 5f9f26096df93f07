// Linear normal law with viscous damping.
//   F_N = K_N h - alpha u_N                     `elastic`: may be attractive at the end of a contact
//   F_N = max(0, K_N h - alpha u_N)             `total`: no attraction
// h deflection (length), u_N relative normal velocity (> 0 opening), alpha = zeta 2 sqrt(m* K_N) (mass / time).
// Coulomb's bound uses the elastic part K_N h (`elastic`) or the total force (`total`).
// Sign: F_N > 0 repulsive. Source: chapter, eqs. linuni and visco, sec. visq. Restitution: scene/derive.hpp.
#pragma once

#include <algorithm>

#include "common/scene/scene.hpp"

namespace galet::md {

struct NormalForce {
  double force;  ///< F_N
  double bound;  ///< norm of F_T is at most mu times this
};

inline NormalForce normal_linear(double stiffness, double alpha, DampingConvention convention, double deflection,
                                 double opening_velocity) {
  const double elastic = stiffness * deflection;
  const double total = elastic - alpha * opening_velocity;
  if (convention == DampingConvention::elastic) return {total, elastic};
  const double clipped = std::max(0.0, total);
  return {clipped, clipped};
}

}  // namespace galet::md
