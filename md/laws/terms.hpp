// The constants that the contact kernel reads: those of a pair of materials, and those of one row.
//
// A row keeps what depends on the two grains:
//   coefficient k   linear: K_N; hertz: (4/3) E* sqrt(R*)
//   critical        linear: 2 sqrt(m* K_N); hertz: 2 sqrt(m* 3/2 k), times h^(1/4) it is 2 sqrt(m* K_N(h))
// so that alpha_N = zeta critical(h), and with 1/m_T = (1 + 1/k_I)/m* for bodies of inertia k_I m R^2
// alpha_T = zeta_T 2 sqrt(m_T K_T) = zeta_T sqrt(K_T/K_N k_I/(1 + k_I)) critical(h).
#pragma once

#include <cmath>
#include <vector>

#include "common/core/types.hpp"
#include "common/scene/pair_law.hpp"

namespace galet::md {

/// What a kernel is compiled for: a plain scene (one material, no cohesion, no tangential viscosity, no account of
/// energy) has kernels that do not even ask for the rest.
struct Kernel {
  bool general;  ///< every term, as the run-time constants say
  bool hertz;    ///< of a plain kernel
  bool account;  ///< powers are wanted (general only)
};

struct PairTerms {
  bool hertz = false;
  bool total = false;               ///< viscous convention
  bool square_root = false;         ///< cohesion law
  double damping = 0;               ///< zeta
  double friction = 0;              ///< mu
  double tangential_ratio = 0;      ///< K_T / K_N
  double tangential_viscosity = 0;  ///< alpha_T / critical
  double cohesion = 0;              ///< F0
  double range = 0;                 ///< D0
  double rolling_friction = 0;      ///< mu_R
  double pivoting_friction = 0;     ///< mu_P
  double rolling_stiffness = 0;     ///< K_R / K_N (length^2)
  double pivoting_stiffness = 0;    ///< the same for pivoting
};

template <int D>
PairTerms terms_of(const PairLaw& law) {
  PairTerms terms;
  terms.hertz = law.normal_law == NormalLaw::hertz;
  terms.total = law.convention == DampingConvention::total;
  terms.square_root = law.cohesion_law == CohesionLaw::square_root;
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

/// critical of a row with coefficient k and reduced mass m*.
inline double critical_damping(const PairTerms& terms, double coefficient, double reduced_mass) {
  return 2 * std::sqrt(reduced_mass * (terms.hertz ? 1.5 * coefficient : coefficient));
}

}  // namespace galet::md
