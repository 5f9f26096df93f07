// The constants that the contact kernels read, and what a kernel is compiled for. Plain data.
//
// A row keeps what depends on its two grains:
//   coefficient k   linear: K_N; hertz: (4/3) E* sqrt(R*)
//   critical        linear: 2 sqrt(m* K_N); hertz: 2 sqrt(m* 3/2 k), times h^(1/4) it is 2 sqrt(m* K_N(h))
// so that alpha_N = zeta critical(h), and with 1/m_T = (1 + 1/k_I)/m* for bodies of inertia k_I m R^2
// alpha_T = zeta_T 2 sqrt(m_T K_T) = zeta_T sqrt(K_T/K_N k_I/(1 + k_I)) critical(h).
#pragma once

namespace galet::md {

/// What a kernel is compiled for: a plain scene (one material, no cohesion, no tangential viscosity, no account of
/// energy) has kernels that do not even ask for the rest.
struct Kernel {
  bool general;  ///< every term, as the run-time constants say
  bool hertz;    ///< of a plain kernel
  bool account;  ///< powers are wanted (general only)
};

/// What all pairs of a scene have in common.
struct LawKind {
  bool hertz = false;
  bool total = false;        ///< viscous convention
  bool square_root = false;  ///< cohesion law
};

/// The constants of a pair of materials; V = double, or lanes of different pairs.
template <class V>
struct PairTerms {
  V damping{};               ///< zeta
  V friction{};              ///< mu
  V tangential_ratio{};      ///< K_T / K_N
  V tangential_viscosity{};  ///< alpha_T / critical
  V cohesion{};              ///< F0
  V range{};                 ///< D0
  V rolling_friction{};      ///< mu_R
  V pivoting_friction{};     ///< mu_P
  V rolling_stiffness{};     ///< K_R / K_N (length^2)
  V pivoting_stiffness{};    ///< the same for pivoting
};

inline constexpr int pair_term_count = 10;
static_assert(sizeof(PairTerms<double>) == pair_term_count * sizeof(double));

}  // namespace galet::md
