// An elastic spring in series with a slider of known limit, with an optional dashpot beside the spring: tangential
// force (sliding), rolling torque and pivoting torque are all of this kind.
//   F = K q (+ alpha dq/dt while it does not slide)     norm(K q) <= limit           `elastic` convention
//   F = K q + alpha dq/dt                               norm(F) <= limit             `total` convention
//   rate = dq/dt + slip, slip along F: the spring takes up what the slider leaves; -F acts on grain j
// K may change with the deflection (Mindlin: K proportional to K_N(h)). While it falls F is scaled along with it, that
// is q is kept; while it grows F is kept. Energy K q^2 / 2 then never grows by a change of h, so that no closed cycle
// yields work (Elata and Berryman 1996; Agnolin and Roux 2007).
//
// Integration (midpoint rule). The stored elongation is half a step ahead of the forces: with p the stored value and
// u the rate at t, q(t) = p + dt/2 dq/dt and p' = p + dt dq/dt. Sticking, dq/dt = u. Sliding, F is the trial force
// shortened to the limit, and dq/dt follows from it, so that work F.u dt = change of K p^2 / 2 + F.slip dt (+ viscous)
// holds to rounding and F.slip >= 0. p' is kept within the limit expected half a step ahead; this makes a slider's
// start and stop smooth and can only lose energy.
// In 2D q is a component along the tangent, which turns with the contact: nothing to transport. In 3D `transport`.
// Source: chapter, eqs. linuni, mindlin, coulomb, visco, secs. lois, visq, Resistance au roulement.
#pragma once

#include <algorithm>
#include <cmath>

#include "common/core/inline.hpp"
#include "common/geometry/contact_frame.hpp"
#include "md/laws/terms.hpp"

namespace galet::md {

struct SpringTerms {
  double stiffness;    ///< K now
  double limit;        ///< largest norm of the force now
  double limit_ahead;  ///< the same, expected half a step ahead
  double softening;    ///< K half a step ahead over K now, where it falls; else 1
  double viscosity;    ///< alpha
  bool total;          ///< viscous convention
  double half_before;  ///< dt_before / 2 (0 at the very start)
  double half_after;   ///< dt_after / 2
};

/// Power that a contact takes out of the motion, by channel.
struct Losses {
  double viscous = 0;
  double plastic = 0;    ///< by the slider
  double unloading = 0;  ///< by a change of K
};

inline double squared_norm(double value) { return value * value; }
inline double squared_norm(const Vec<3>& value) { return value.squaredNorm(); }
inline double norm(double value) { return std::abs(value); }
inline double norm(const Vec<3>& value) { return value.norm(); }
inline double dot(double a, double b) { return a * b; }
inline double dot(const Vec<3>& a, const Vec<3>& b) { return a.dot(b); }

/// F; updates the stored elongation. `losses` is filled by kernels that account for energy.
template <Kernel K, class Value>
GALET_INLINE Value spring_force(const SpringTerms& law, const Value& rate, Value& stored, Losses& losses) {
  const double k = law.stiffness, step = law.half_before + law.half_after;
  const double bounded_viscosity = K.general && law.total ? law.viscosity : 0;
  Value force = k * (stored + law.half_before * rate) + bounded_viscosity * rate;
  if (squared_norm(force) <= law.limit * law.limit) {
    stored += step * rate;
    if (K.general && !law.total) force += law.viscosity * rate;
    if (K.account) losses.viscous += law.viscosity * squared_norm(rate);
    return force;
  }
  const Value before = stored;
  const double inverse = 1 / k;
  force *= law.limit / norm(force);
  // Where the limit has fallen by more than a third in one step the midpoint rule resolves nothing: the spring first
  // falls with it. (Not one with a dashpot in series with the slider: it outlives the limit for a while.)
  const double longest = inverse * law.limit, length = norm(stored);
  if (length > 1.5 * longest && bounded_viscosity == 0) stored *= longest / length;
  const Value start = stored;
  const double modulus = k * law.half_before + bounded_viscosity;
  Value flow = 0 * rate;  // dq/dt
  if (modulus > 0) {
    flow = (force - k * stored) * (1 / modulus);
    stored += step * flow;
  } else {
    stored = inverse * force;
  }
  const Value free = stored;
  double most = inverse * law.limit_ahead;
  // While K falls elongations are kept: the one allowed is that of the softer spring.
  if (K.general || K.hertz) most /= law.softening;
  if (bounded_viscosity > 0) most = std::max(most, length);
  // Not a branch: while a contact slides steadily the two lengths are nearly equal. (0 / 0 leaves the zero spring.)
  const double shortening = most / norm(stored);
  stored *= shortening < 1 ? shortening : 1.0;
  if (K.account) {
    losses.viscous += bounded_viscosity * squared_norm(flow);
    losses.plastic +=
        dot(force, Value(rate - flow)) +
        0.5 * k * (squared_norm(before) - squared_norm(start) + squared_norm(free) - squared_norm(stored)) / step;
  }
  return force;
}

/// Adapts the stored elongation to a stiffness that has changed since the last step.
template <Kernel K, class Value>
GALET_INLINE void adapt_spring(double stiffness_before, double stiffness, double step, Value& stored, Losses& losses) {
  const double energy = K.account ? 0.5 * stiffness_before * squared_norm(stored) : 0;
  if (stiffness > stiffness_before) stored *= stiffness_before / stiffness;
  if (K.account) losses.unloading += (energy - 0.5 * stiffness * squared_norm(stored)) / step;
}

/// Carries a vector of the tangent plane of `before` to that of `after` (unit normals), for a pair that turns by the
/// rotation vector `turn` (mean spin of the two grains times dt): by the smallest rotation that takes one normal to the
/// other, then about the new normal by the angle psi with tan(psi/2) = tan(|turn|/2) turn.n/|turn|. A pair that turns
/// rigidly keeps its tangential force, norm and direction in its own frame, to rounding (for |turn| < 0.02; beyond that
/// the error is 4e-4 |turn|^7).
GALET_INLINE Vec<3> transport(const Vec<3>& value, const Vec<3>& before, const Vec<3>& after, const Vec<3>& turn) {
  const Vec<3> moved = carried(value, before, after);
  const double squared = turn.squaredNorm();
  const double half = 0.5 * turn.dot(after) * (1 + squared / 12 * (1 + squared / 10));
  const double scale = 1 / (1 + half * half);
  return (1 - half * half) * scale * moved + 2 * half * scale * after.cross(moved);
}

}  // namespace galet::md
