// Restitution of a head-on collision from the damping ratio, and back; exact for each law.
//   linear, `elastic` (contact until h = 0):  e = exp(-pi zeta / s), s = sqrt(1 - zeta^2); 0 for zeta >= 1
//   linear, `total` (contact until F_N = 0):  e = exp(-(zeta / s)(pi - 2 asin zeta)), continued above zeta = 1
//   hertz with alpha = zeta 2 sqrt(m* K_N(h)): the same with sqrt(6/5) zeta, at every speed
// Source: Schwager and Poschel 2007 (total); Tsuji et al. 1992, Antypov and Elliott 2011 (hertz: y = h^(5/4) makes the
// equation linear).
#pragma once

#include "common/scene/scene.hpp"

namespace galet {

double restitution_of_damping(double zeta, DampingConvention convention, NormalLaw law = NormalLaw::linear);

/// Its inverse: zeta for which the collision has restitution e, 0 < e <= 1.
double damping_of_restitution(double e, DampingConvention convention, NormalLaw law = NormalLaw::linear);

/// Duration of the collision with the linear law, for reduced mass m* and stiffness K.
double collision_duration(double zeta, DampingConvention convention, double reduced_mass, double stiffness);

}  // namespace galet
