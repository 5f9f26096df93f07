// From the law of a pair of materials (common/scene/pair_law.hpp) to the constants that kernels read (laws/terms.hpp).
#pragma once

#include <cmath>

#include "common/core/types.hpp"
#include "common/scene/pair_law.hpp"
#include "md/laws/terms.hpp"

namespace galet::md {

inline LawKind kind_of(const PairLaw& law) {
  return {law.normal_law == NormalLaw::hertz, law.convention == DampingConvention::total,
          law.cohesion_law == CohesionLaw::square_root};
}

template <int D>
PairTerms<double> terms_of(const PairLaw& law) {
  PairTerms<double> terms;
  terms.damping = law.damping_ratio;
  terms.friction = law.friction;
  terms.tangential_ratio = law.tangential_ratio;
  terms.tangential_viscosity =
      law.tangential_damping_ratio * std::sqrt(law.tangential_ratio * inertia_ratio<D> / (1 + inertia_ratio<D>));
  terms.cohesion = law.cohesion;
  terms.range = law.cohesion_range;
  terms.rolling_friction = law.rolling_friction;
  terms.pivoting_friction = law.pivoting_friction;
  terms.rolling_stiffness = law.rolling_ratio * law.rolling_friction * law.rolling_friction;
  terms.pivoting_stiffness = law.rolling_ratio * law.pivoting_friction * law.pivoting_friction;
  return terms;
}

/// `critical` of a row with coefficient k and reduced mass m*.
inline double critical_damping(const LawKind& kind, double coefficient, double reduced_mass) {
  return 2 * std::sqrt(reduced_mass * (kind.hertz ? 1.5 * coefficient : coefficient));
}

/// Elastic energy of the deflection h.
inline double elastic_energy(const LawKind& kind, double coefficient, double deflection) {
  return kind.hertz ? 0.4 * coefficient * deflection * deflection * std::sqrt(deflection)
                    : 0.5 * coefficient * deflection * deflection;
}

/// Energy of the attraction, zero at the end of its range.
inline double cohesive_energy(const LawKind& kind, const PairTerms<double>& law, double coefficient, double gap) {
  if (law.cohesion == 0) return 0;
  if (gap > 0)
    return gap < law.range ? -0.5 * law.cohesion * law.range * (1 - gap / law.range) * (1 - gap / law.range) : 0;
  if (kind.square_root) return -2.0 / 3 * std::sqrt(-4 * coefficient * law.cohesion * gap) * -gap;
  return -law.cohesion * (0.5 * law.range - gap);
}

}  // namespace galet::md
