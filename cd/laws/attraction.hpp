// Attraction of a pair of rigid grains over one step: cohesion F0 with range D0, as in the soft engine's constant law.
//   F_a = F0                 in contact
//   F_a = F0 (1 - g / D0)    across a gap 0 < g < D0
// Its impulse s = F_a dt acts along the branch as an external force of known size, and the contact problem is solved
// for the repulsive part q = r_N + s >= 0. Coulomb's bound mu (r_N + F_a dt) and those of rolling and pivoting are then
// mu q and so on, and traction never exceeds F_a. A rigid contact has no deflection that tells contact from gap:
// without a range, a pair is in contact while it overlaps or its repulsive part was not zero in the step before.
// Source: Gilabert, Roux and Castellanos 2007 (law); first order in dt, as the force is that of the step's start.
#pragma once

#include "common/scene/pair_law.hpp"

namespace galet::cd {

/// F_a at gap g; `pressed`: the pair's repulsive impulse was not zero in the step before.
inline double attraction(const PairLaw& law, double gap, bool pressed) {
  if (law.cohesion == 0) return 0;
  if (gap <= 0) return law.cohesion;
  if (law.cohesion_range > 0) return gap < law.cohesion_range ? law.cohesion * (1 - gap / law.cohesion_range) : 0;
  return pressed ? law.cohesion : 0;
}

/// Potential energy of that force, zero out of range.
inline double attraction_energy(const PairLaw& law, double gap, bool pressed) {
  if (attraction(law, gap, pressed) == 0) return 0;
  const double range = law.cohesion_range;
  if (gap <= 0 || range == 0) return law.cohesion * ((gap < 0 ? gap : 0) - range / 2);
  return -law.cohesion * (range - gap) * (range - gap) / (2 * range);
}

}  // namespace galet::cd
