// Normal laws.
//   linear   F_el = K_N h                        K_N(h) = K_N
//   hertz    F_el = (4/3) E* sqrt(R*) h^(3/2)    K_N(h) = 2 E* sqrt(R* h)
//   viscous  F_v = -alpha_N u_N, alpha_N = zeta 2 sqrt(m* K_N(h))
//   repulsive part   F_r = F_el + F_v, bound F_el        `elastic`: F_r may be attractive at the end of a contact
//                    F_r = max(0, F_el + F_v), bound F_r  `total`
//   cohesion F_a = F0, or sqrt(4 K_N F0 h) (square-root law); across a gap 0 < g < D0: F_a = F0 (1 - g / D0)
//   F_N = F_r - F_a
// h deflection (length), u_N relative normal velocity (> 0 opening). Sign: F_N > 0 repulsive. Coulomb's and rolling's
// bounds refer to `bound`, which knows nothing of attraction.
// Sources: chapter, eqs. linuni, hertz, visco, sec. visq and Cohesion; Gilabert et al. 2007 (constant), Rognon et al.
// 2006 (square root). Restitution: common/scene/restitution.hpp.
#pragma once

#include <algorithm>
#include <cmath>

#include "common/core/inline.hpp"
#include "md/laws/terms.hpp"

namespace galet::md {

struct NormalForce {
  double force;      ///< F_N
  double bound;      ///< norm of F_T is at most mu times this
  double stiffness;  ///< K_N(h)
  double critical;   ///< 2 sqrt(m* K_N(h))
};

template <Kernel K>
GALET_INLINE NormalForce normal_force(const PairTerms& law, double coefficient, double critical, double deflection,
                                      double opening_velocity) {
  NormalForce result{0, 0, coefficient, critical};
  double elastic = coefficient * deflection;
  if (K.general ? law.hertz : K.hertz) {
    const double root = std::sqrt(deflection);
    elastic *= root;
    result.stiffness = 1.5 * coefficient * root;
    result.critical = critical * std::sqrt(root);
  }
  double repulsion = elastic - law.damping * result.critical * opening_velocity;
  if (law.total) repulsion = std::max(0.0, repulsion);
  result.bound = law.total ? repulsion : elastic;
  result.force = repulsion;
  if (K.general && law.cohesion > 0)
    result.force -= law.square_root ? std::sqrt(4 * coefficient * law.cohesion * deflection) : law.cohesion;
  return result;
}

/// F_N of a pair that attracts across the gap g, 0 <= g < D0.
inline double distant_force(const PairTerms& law, double gap) { return -law.cohesion * (1 - gap / law.range); }

/// Elastic energy of the deflection h.
inline double elastic_energy(const PairTerms& law, double coefficient, double deflection) {
  return law.hertz ? 0.4 * coefficient * deflection * deflection * std::sqrt(deflection)
                   : 0.5 * coefficient * deflection * deflection;
}

/// Energy of the attraction, zero at the end of its range.
inline double cohesive_energy(const PairTerms& law, double coefficient, double gap) {
  if (law.cohesion == 0) return 0;
  if (gap > 0)
    return gap < law.range ? -0.5 * law.cohesion * law.range * (1 - gap / law.range) * (1 - gap / law.range) : 0;
  if (law.square_root) return -2.0 / 3 * std::sqrt(-4 * coefficient * law.cohesion * gap) * -gap;
  return -law.cohesion * (0.5 * law.range - gap);
}

}  // namespace galet::md
