// Normal laws, on lanes.
//   linear   F_el = K_N h                        K_N(h) = K_N
//   hertz    F_el = (4/3) E* sqrt(R*) h^(3/2)    K_N(h) = 2 E* sqrt(R* h)
//   viscous  F_v = -alpha_N u_N, alpha_N = zeta 2 sqrt(m* K_N(h))
//   repulsive part   F_r = F_el + F_v, bound F_el        `elastic`: F_r may be attractive at the end of a contact
//                    F_r = max(0, F_el + F_v), bound F_r  `total`
//   cohesion F_a = F0, or sqrt(4 K_N F0 h) (square-root law); across a gap 0 < g < D0: F_a = F0 (1 - g / D0)
//   F_N = F_r - F_a
// h deflection (length, not negative), u_N relative normal velocity (> 0 opening). Sign: F_N > 0 repulsive. Coulomb's
// and rolling's bounds refer to `bound`, which knows nothing of attraction.
// Sources: chapter, eqs. linuni, hertz, visco, sec. visq and Cohesion; Gilabert et al. 2007 (constant), Rognon et al.
// 2006 (square root). Restitution: common/scene/restitution.hpp.
#pragma once

#include "md/kernel/lanes.hpp"
#include "md/laws/terms.hpp"

namespace galet::md {

template <class V>
struct NormalForce {
  V force;      ///< F_N
  V bound;      ///< norm of F_T is at most mu times this
  V stiffness;  ///< K_N(h)
  V critical;   ///< 2 sqrt(m* K_N(h))
};

template <Kernel K, class V>
GALET_INLINE NormalForce<V> normal_force(const LawKind& kind, const PairTerms<V>& law, V coefficient, V critical,
                                         V deflection, V opening_velocity) {
  NormalForce<V> result{V(0.0), V(0.0), coefficient, critical};
  V elastic = coefficient * deflection;
  if (K.general ? kind.hertz : K.hertz) {
    const V root = sqrt(deflection);
    elastic = elastic * root;
    result.stiffness = V(1.5) * coefficient * root;
    result.critical = critical * sqrt(root);
  }
  V repulsion = nmadd(law.damping * result.critical, opening_velocity, elastic);
  // Without a branch: which convention holds is the same for all contacts, but neither is worth a kernel of its own.
  repulsion = max(repulsion, V(kind.total ? 0.0 : -__builtin_huge_val()));
  result.bound = select(V(0.0) < V(kind.total ? 1.0 : 0.0), repulsion, elastic);
  result.force = repulsion;
  if (K.general)
    result.force =
        result.force - (kind.square_root ? sqrt(V(4.0) * coefficient * law.cohesion * deflection) : law.cohesion);
  return result;
}

/// F_N of a pair that attracts across the gap g, 0 <= g < D0.
template <class V>
GALET_INLINE V distant_force(const PairTerms<V>& law, V gap) {
  return -law.cohesion * (V(1.0) - gap / law.range);
}

}  // namespace galet::md
