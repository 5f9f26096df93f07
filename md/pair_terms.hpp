// From the law of a pair of materials (common/scene/pair_law.hpp) to the constants that kernels read (laws/terms.hpp).
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/core/types.hpp"
#include "common/geometry/contact_frame.hpp"
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

/// |F_T| of a contact over Coulomb's bound (laws/normal.hpp), at most 1; not a number without friction. With
/// tangential viscosity of the `elastic` convention F_T holds a part that the bound does not limit.
template <int D>
double mobilised_friction(const LawKind& kind, const PairTerms<double>& law, double coefficient,
                          const ContactFrame<D>& frame, const Vec<D>& force) {
  if (!(law.friction > 0)) return std::numeric_limits<double>::quiet_NaN();
  const double deflection = std::max(0.0, -frame.gap), normal = force.dot(frame.normal);
  double bound = coefficient * deflection * (kind.hertz ? std::sqrt(deflection) : 1);
  if (kind.total)
    bound = normal + (kind.square_root ? std::sqrt(4 * coefficient * law.cohesion * deflection) : law.cohesion);
  const double tangential = (force - normal * frame.normal).norm();
  return tangential > 0 ? tangential / std::max(law.friction * bound, tangential) : 0;
}

}  // namespace galet::md
