// Moreau's impact law with Signorini's condition, as the offset of one contact: u_N+ + offset >= 0.
//
//   touching (g <= 0), or closing within the step (u_N- < 0 and g + dt u_N- <= 0):   offset = e u_N-
//   otherwise:                         offset = max((g / dt + (1 - theta) u_N-) / theta, e u_N-)
//
// The first line is Newton's law u_N+ >= -e u_N-; the second keeps a pair apart that other contacts push together
// within the step, whose gap moves by dt (theta u_N+ + (1 - theta) u_N-). Taken over all contacts, v+ is then
// (1 + e) w - e v- with w the projection of v- on a set that contains 0, so that no step makes kinetic energy when
// every contact has the same e in [0, 1] and tangential motions the same e_T = e (or there is no friction). Other
// choices can make energy in theory, and the engine's account says when they do (cd/contact_account.hpp). A pair that
// separates (u_N- > 0) may come back by at most e u_N- dt in the step: a transient penetration of that size, which the
// next step's impact removes. With e = 1 a pair that only others could close within the step is left to the next step:
// the second line would take its energy (it stops the pair before the impact), and an elastic gas would cool at first
// order in dt. What such a pair overlaps meanwhile, u_N dt at most, is drift like any other. g gap, u_N- normal
// velocity at the start of the step. Source: Moreau 1988; Acary and Brogliato 2008, ch. 10.
#pragma once

#include <algorithm>
#include <limits>

namespace galet::cd {

inline double impact_offset(double gap, double opening_velocity, double restitution, double dt, double theta = 1) {
  const double impact = restitution * opening_velocity;
  const bool closing = gap <= 0 || (opening_velocity < 0 && gap + dt * opening_velocity <= 0);
  if (closing) return impact;
  if (restitution == 1) return std::numeric_limits<double>::infinity();
  return std::max((gap / dt + (1 - theta) * opening_velocity) / theta, impact);
}

}  // namespace galet::cd
