// An elastic contact inside the implicit step: deflections and stiffnesses of the soft engine at time steps that need
// not resolve collisions.
//
//   F_N = F_el(h) + alpha_N (-u_N) >= 0,   h = -(g + dt u_N+),   linearised at a deflection h*:
//   r_N = dt (F* + K* (h - h*)) - alpha dt u_N+  ->  0 <= u_N+ + offset + C_N r_N  perp  r_N >= 0,
//   C_N = 1 / (K* dt^2 + alpha dt),   offset = -C_N dt (F* - K* (g + h*))
//   r_T = r_T- - K_T dt^2 u_T+  inside Coulomb's bound,   C_T = 1 / (K_T dt^2),   lag = -C_T r_T-
//   rolling and pivoting likewise with K_R = ratio K_N mu_R^2.
//
// K* = dF_el/dh at h*; alpha = zeta 2 sqrt(m* K*); r_T- the tangential impulse of the step before, which was elastic.
// Linear contacts are exact; Hertz contacts are linearised again at the h that was found until forces agree (Newton's
// method, cd/elastic_contacts.hpp). As in the soft engine, r_T- shrinks with K_T when h falls (no closed cycle yields
// work). Equilibria are those of the soft engine with the same laws; waves and collisions shorter than dt are damped by
// the implicit step, which has no energy to give back: below tau_c a collision has the restitution of zeta, above it
// none. Source: Krabbenhoft, Huang, Vicente da Silva and Lyamin 2012 (granular contact dynamics with particle
// elasticity).
#pragma once

#include <algorithm>
#include <cmath>

#include "cd/problem.hpp"
#include "common/scene/pair_law.hpp"

namespace galet::cd {

/// A pair's elastic constants at a deflection.
struct ElasticPoint {
  double force;      ///< F_el
  double stiffness;  ///< K_N
};

inline ElasticPoint elastic_point(const PairLaw& law, double coefficient, double deflection) {
  const double stiffness = tangent_stiffness(law.normal_law, coefficient, deflection);
  return {law.normal_law == NormalLaw::linear ? stiffness * deflection : stiffness * deflection / 1.5, stiffness};
}

struct ImplicitContact {
  Compliance compliance;
  double offset;
};

/// The contact at gap g, linearised at h* = `deflection`; `reduced_mass` m*.
inline ImplicitContact implicit_contact(const PairLaw& law, double coefficient, double reduced_mass, double gap,
                                        double deflection, double dt) {
  const ElasticPoint at = elastic_point(law, coefficient, deflection);
  const double viscous = 2 * law.damping_ratio * std::sqrt(reduced_mass * at.stiffness);
  const auto spring = [&](double stiffness) { return stiffness > 0 ? 1 / (stiffness * dt * dt) : 0; };
  ImplicitContact contact;
  contact.compliance.normal = 1 / (at.stiffness * dt * dt + viscous * dt);
  contact.compliance.tangential = spring(law.tangential_ratio * at.stiffness);
  const double turning = law.rolling_ratio * at.stiffness;
  contact.compliance.rolling = spring(turning * law.rolling_friction * law.rolling_friction);
  contact.compliance.pivoting = spring(turning * law.pivoting_friction * law.pivoting_friction);
  contact.offset = -contact.compliance.normal * dt * (at.force - at.stiffness * (gap + deflection));
  return contact;
}

/// What is left of r_T- when the deflection goes from h to h* (Hertz: K_T follows it).
inline double kept_elastic(const PairLaw& law, double before, double deflection) {
  if (law.normal_law == NormalLaw::linear || deflection >= before || before <= 0) return 1;
  return std::sqrt(deflection / before);
}

}  // namespace galet::cd
