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

#include "md/kernel/lanes.hpp"
#include "md/laws/terms.hpp"

namespace galet::md {

template <class V>
struct SpringTerms {
  V stiffness;    ///< K now
  V limit;        ///< largest norm of the force now
  V viscosity;    ///< alpha
  bool total;     ///< viscous convention
  V half_before;  ///< dt_before / 2 (0 at the very start)
  V half_after;   ///< dt_after / 2
  // What plain kernels find once for all rows; the general one leaves it out.
  V softness{};   ///< 1 / K, linear law
  V overshoot{};  ///< dt / half_before, 1 at the very start
};

/// What is expected half a step ahead. Only springs that slide ask for it.
template <class V>
struct SpringAhead {
  V limit;      ///< largest norm of the force
  V softening;  ///< K over K now, where it falls; else 1
};

/// Power that contacts take out of the motion, by channel.
template <class V>
struct Losses {
  V viscous{};
  V plastic{};    ///< by the slider
  V unloading{};  ///< by a change of K
};

/// length / sqrt(squared), the root and the division side by side; not a number where `squared` is zero.
template <class V>
GALET_INLINE V share(V length, V squared) {
  return length * sqrt(squared) * (V(1.0) / squared);
}
/// The value (not zero), its norm made `length`.
template <class V>
GALET_INLINE V with_norm(V length, const V& value) {
  return select(value < V(0.0), -length, length);
}
template <class V>
GALET_INLINE Space<V> with_norm(V length, const Space<V>& value) {
  return share(length, squared(value)) * value;
}
/// The value, its norm made `most` where it is larger.
template <class V>
GALET_INLINE V shortened(V most, const V& value) {
  return max(min(value, most), -most);
}
template <class V>
GALET_INLINE Space<V> shortened(V most, const Space<V>& value) {
  return min(share(most, squared(value)), V(1.0)) * value;  // no number leaves the zero vector
}

/// What sliding makes of a trial force beyond the limit: the force, the stored elongation, and the power lost. Of no
/// use where the spring sticks.
template <class V, class Value>
struct Slide {
  Value force, stored;
  V plastic, viscous;
};

template <Kernel K, class V, class Value>
GALET_INLINE Slide<V, Value> slide(const SpringTerms<V>& law, const SpringAhead<V>& ahead, const Value& trial,
                                   const Value& rate, const Value& stored, V bounded_viscosity) {
  constexpr bool given = !K.general && !K.hertz;
  const V k = law.stiffness, step = law.half_before + law.half_after, inverse = given ? law.softness : V(1.0) / k;
  Slide<V, Value> to;
  to.force = with_norm(law.limit, trial);
  // Where the limit has fallen by more than a third in one step the midpoint rule resolves nothing: the spring first
  // falls with it. (Not one with a dashpot in series with the slider: it outlives the limit for a while.)
  const V longest = inverse * law.limit, length_squared = squared(stored);
  auto fallen = V(2.25) * longest * longest < length_squared;
  if (K.general) fallen = without(fallen, V(0.0) < bounded_viscosity);
  Value start = stored;
  if (__builtin_expect(any(fallen), 0)) start = select(fallen, with_norm(longest, stored), stored);
  // dq/dt from K (start + dt/2 dq/dt) + alpha dq/dt = F; at the very start q is F / K.
  V overshoot = law.overshoot, delay = law.half_before;
  if constexpr (K.general) {
    delay = madd(inverse, bounded_viscosity, law.half_before);
    overshoot = select(V(0.0) < delay, step / delay, V(1.0));
  }
  const Value free = madd(overshoot * inverse, to.force, (V(1.0) - overshoot) * start);
  // A hair within the limit: at rest rounding would have springs slide by nothing over and over.
  V most = inverse * (V(1 - 0x1p-49) * ahead.limit);
  // While K falls elongations are kept: the one allowed is that of the softer spring.
  if (K.general || K.hertz) most = most / ahead.softening;
  if (K.general) most = select(V(0.0) < bounded_viscosity, max(most, sqrt(length_squared)), most);
  to.stored = shortened(most, free);
  if (K.account) {
    const Value flow = only(V(0.0) < delay, V(1.0) / delay * (inverse * to.force - start));
    to.viscous = bounded_viscosity * squared(flow);
    to.plastic = dot(to.force, rate - flow) +
                 V(0.5) * k * (squared(stored) - squared(start) + squared(free) - squared(to.stored)) / step;
  }
  return to;
}

/// F of the touching pairs; updates the stored elongation and says which of them slide. Both are zero where not
/// touching. `losses` is filled by kernels that account for energy. `guess`: which slid a step ago (bit k: row k). It
/// changes no result: whether any does now is known late, and a processor that has guessed wrongly has to throw away
/// what it has begun of the next rows; the guess is known at once and seldom wrong. `ahead()`: SpringAhead.
template <Kernel K, int W, class Value, class Ahead>
GALET_INLINE Value spring_force(Mask<W> touching, const SpringTerms<Lanes<W>>& law, Ahead ahead, const Value& rate,
                                Value& stored, unsigned guess, Mask<W>& slides, Losses<Lanes<W>>& losses) {
  using V = Lanes<W>;
  const V k = law.stiffness, step = law.half_before + law.half_after;
  const V bounded_viscosity = K.general && law.total ? law.viscosity : V(0.0);
  Value force = k * madd(law.half_before, rate, stored);
  if (K.general) force = madd(bounded_viscosity, rate, force);
  force = only(touching, force);
  const V trial = squared(force);
  slides = touching & (law.limit * law.limit < trial);
  const Value before = stored;
  stored = only(touching, madd(step, rate, stored));
  Value sticking = force;
  if (K.general && !law.total) sticking = only(touching, madd(law.viscosity, rate, force));
  if (K.account) losses.viscous += only(without(touching, slides), law.viscosity * squared(rate));
  if (!guess) {
    // Kept apart from the test of the guess, else one test of both waits for the slides.
    asm volatile("");
    if (__builtin_expect(!any(slides), 1)) return sticking;
  }
  const Slide<V, Value> to = slide<K>(law, ahead(), force, rate, before, bounded_viscosity);
  stored = select(slides, to.stored, stored);
  if (K.account) losses.viscous += only(slides, to.viscous), losses.plastic += only(slides, to.plastic);
  return select(slides, to.force, sticking);
}

/// Adapts the stored elongation to a stiffness that has changed since the last step.
template <Kernel K, class V, class Value>
GALET_INLINE void adapt_spring(V stiffness_before, V stiffness, V step, Value& stored, Losses<V>& losses) {
  const Value before = stored;
  stored = select(stiffness_before < stiffness, stiffness_before / stiffness * stored, stored);
  if (K.account) losses.unloading += V(0.5) * (stiffness_before * squared(before) - stiffness * squared(stored)) / step;
}

/// A vector of the tangent plane of a pair, brought from the last step's frame to the present one (3D). With the
/// normal:
///   p = q - (q.n) (n - dt/2 dn/dt)      dn/dt = u_T / |b|, u_T the tangential velocity of the centres
/// which is the smallest rotation from the last normal to the present one, with the last one from the present motion:
/// nothing needs to be remembered for it. Then about the normal by the angle psi with the mean spin of the two grains,
///   tan(psi/2) = dt/4 (w_i + w_j).n
/// A steady turn of the normal by theta in a step shortens the vector by theta^4 / 24 (4e-18 for 1e-4, as in slow
/// flows), one about it leaves its norm to rounding and errs by psi^3 / 12 in the angle; both together err by theta^2
/// psi / 4. `half`: dt/2; `together`: w_i + w_j.
template <class V>
GALET_INLINE Space<V> carried(const Space<V>& value, const Space<V>& normal, V inverse_distance, const Space<V>& across,
                              const Space<V>& together, V half) {
  const V along = dot(value, normal);
  const Space<V> flat = madd(along * half * inverse_distance, across, nmadd(along, normal, value));
  const V t = V(0.5) * half * dot(together, normal), t2 = t * t;
  // sin(psi) = 2 t / (1 + t^2), 1 - cos(psi) = t sin(psi)
  const V sine = V(2.0) * t * (nmadd(t, t, V(1.0)) * madd(t2, t2, V(1.0)));
  return madd(sine, nmadd(t, flat, cross(normal, flat)), flat);
}

}  // namespace galet::md
