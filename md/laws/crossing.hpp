// Contacts that begin or end within a time step.
//
// The time scheme takes forces at the steps, each for a whole dt: the trapezoidal rule. Where a force starts or ends in
// the middle of a step that rule is wrong at first order (a jump), at dt^2 (a corner) or at a power between (a root of
// the deflection). With theta the fraction of the step spent in contact and f(s) = C s^a the force at the time s dt
// after the beginning (before the end), samples at s = theta, theta + 1, ... add up to
//   sum f(theta + k) = integral / dt + C zeta(-a, theta)       (zeta: Hurwitz; Navot 1961, end corrections)
// so that the force -C zeta(-a, theta) added at the crossing step cures it:
//   a = 0    C (theta - 1/2)              viscous force of the linear law, cohesion without range
//   a = 1    C theta (theta - 1) / 2      that is (theta - 1) / 2 times the force at theta: elastic and frictional
//   forces
//                                         of the linear law (the rule's usual error, C / 12, is left as it is)
//   a = 1/2  square-root cohesion;  a = 1/4  viscous force of Hertz's law: Euler and Maclaurin's formula from theta + 1
//   on
//   a = 1/2  stiffness of Hertz's springs that stick: midpoint sums of K u, half a step ahead of the forces, lack
//            -zeta(-1/2, theta) of the root; the force at theta itself is K u dt 2 theta / 3
// Smoother ones (elastic and sliding forces of Hertz's law) need nothing; at the end springs slide. Both crossings are
// seen after the fact, from the geometry of the step that finds a pair in (out of) contact that was not (was) so
// before; at the end the force at theta is that of the last step. Impulses then are right to the order of the scheme;
// they act up to one step late, which costs dt^2. In the `total` convention the repulsive force ends by itself before
// contact does: nothing jumps there.
#pragma once

#include "md/laws/normal.hpp"

namespace galet::md {

/// -zeta(-a, theta) of the root x^a, a = 1/2 or 1/4; theta in [0, 1]: the integral up to 1 + theta, with Euler and
/// Maclaurin's end terms there, less the sample at theta.
template <class V>
GALET_INLINE V root_correction(V theta, bool quarter) {
  const double a = quarter ? 0.25 : 0.5;
  const V end = V(1.0) + theta;
  V sample = sqrt(theta), power = sqrt(end);
  if (quarter) sample = sqrt(sample), power = sqrt(power);
  return power * (end / V(1 + a) - V(0.5) + V(a / 12) / end) - sample;
}

/// What crossings change, in the lanes that cross.
template <class V>
struct Crossings {
  V normal{0.0};     ///< added to F_N
  V springs{1.0};    ///< beginning: factor of the forces of springs that stick
  V sliders{1.0};    ///< beginning: factor of the forces of those that slide
  V jump{0.0};       ///< beginning: what a dashpot beside a spring lacks, over its force
  V head{0.0};       ///< beginning: time that springs have moved for, beyond half a step, as the force counts it
  V ahead{0.0};      ///< beginning: time that is added to what springs have moved for half a step ahead
  V last{0.0};       ///< end: share of the last step's forces and torques that is added
  V unbounded{0.0};  ///< end: what F_N lacked at the last step of the force that Coulomb's bound refers to
  V viscous{0.0};    ///< power that normal dashpots take, added to that at the step
};

/// `deflection` is negative after the end; `opening`: u_N; `bound`: as in NormalForce; `dt`: the step that led here;
/// `ends`: which crossings are ends.
template <class V, class M>
GALET_INLINE Crossings<V> crossings(const LawKind& kind, const PairTerms<V>& law, V coefficient, V critical,
                                    V deflection, V opening, V bound, V dt, M ends) {
  const V path = max(opening, -opening) * dt;  // length of a step's approach
  const V inside = min(max(deflection, -deflection) / path, V(1.0));
  // A pair that crosses against its velocity (a corner of its path): nothing is known, nothing corrected.
  const M known = (ends & (V(0.0) < opening)) | without(opening < V(0.0), ends);
  const V theta = select(known, select(ends, V(1.0) - inside, inside), V(0.5));
  const V jump = theta - V(0.5), corner = only(known, V(0.5) * (theta - V(1.0)));
  const M dashpot = kind.total ? without(known, ends) : known;

  Crossings<V> result;
  result.jump = jump, result.head = jump * dt;
  const V speed_force = law.damping * critical * opening;  // minus F_N^v of the linear law
  V viscous;                                               // minus what the viscous force lacks
  if (kind.hertz) {
    const V fourth = root_correction(theta, true);  // of the dashpots
    viscous = only(dashpot, speed_force * sqrt(sqrt(path)) * fourth);
    result.normal = V(0.0) - viscous;
    const V root = sqrt(max(theta, V(1e-12))), moved = V(2.0 / 3) * theta;
    result.head = only(known, (moved - V(0.5)) * dt);
    result.ahead = only(known, (V(0.5) + root_correction(theta, false) / root - moved) * dt);
    result.jump = only(known, fourth / sqrt(root));
  } else {
    viscous = only(dashpot, jump * speed_force);
    // At an end the share of the last force has part of it already.
    result.normal = corner * max(coefficient * deflection, V(0.0)) -
                    select(ends, only(dashpot, V(0.5) * theta * speed_force), viscous);
    result.springs = result.sliders = V(1.0) + corner;
    result.last = only(ends, corner);
  }
  result.viscous = viscous * opening;
  if (kind.total) result.sliders = V(1.0) + select(V(0.0) < bound, result.normal / bound, V(0.0));
  V regular = law.cohesion;  // attraction that `last` holds and that has no corner
  if (kind.square_root) {
    const V whole = sqrt(V(4.0) * coefficient * law.cohesion * path);
    regular = whole * sqrt(theta);
    result.normal = result.normal - only(known, whole * root_correction(theta, false));
  } else {
    result.normal = result.normal - select(V(0.0) < law.range, V(0.0), law.cohesion * jump);
  }
  result.normal = result.normal + result.last * regular;
  result.unbounded = regular + (kind.total ? V(0.0) : speed_force);
  return result;
}

}  // namespace galet::md
