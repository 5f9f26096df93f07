// What holds in a contact of two materials: every constant of the contact laws, after mixing.
//
// Mixing rules, where no [[material_pair]] says otherwise:
//   linear   K_N, K_T   two half springs in series, K = 2 K_i K_j / (K_i + K_j)
//   hertz    1/E* = (1 - nu_i^2)/E_i + (1 - nu_j^2)/E_j, 1/G* = 2 (2 - nu_i)(1 + nu_i)/E_i + the same of j,
//            K_T / K_N = 4 G* / E* (Johnson 1985; equal materials: (2 - 2 nu)/(2 - nu))
//   mu, mu_R, mu_P, e_T the smaller one: the weaker surface yields
//   zeta, zeta_T        arithmetic mean (in terms of e nearly the geometric mean)
//   F0                  geometric mean, as for surface energies
#pragma once

#include <optional>
#include <vector>

#include "common/scene/scene.hpp"

namespace galet {

struct PairLaw {
  NormalLaw normal_law = NormalLaw::linear;
  DampingConvention convention = DampingConvention::elastic;
  CohesionLaw cohesion_law = CohesionLaw::constant;
  double stiffness = 0;                 ///< linear: K_N (force / length); hertz: E* (force / length^2)
  double tangential_ratio = 0.5;        ///< K_T / K_N, the same at every deflection
  double damping_ratio = 0;             ///< zeta
  double tangential_damping_ratio = 0;  ///< zeta_T
  double restitution = 1;               ///< e of a head-on collision without cohesion
  double tangential_restitution = 0;    ///< e_T (cd): of sliding, rolling and pivoting
  double friction = 0;                  ///< mu
  double rolling_friction = 0;          ///< mu_R (length)
  double pivoting_friction = 0;         ///< mu_P (length)
  double rolling_ratio = 1;             ///< K_R / (K_N mu_R^2), likewise for pivoting
  double cohesion = 0;                  ///< F0 (force)
  double cohesion_range = 0;            ///< D0 (length)

  bool rotates() const { return friction > 0 || rolling_friction > 0 || pivoting_friction > 0; }
};

/// The laws of a scene: one per unordered pair of its materials (0: [material], 1..: the further ones).
struct LawTable {
  int materials = 1;
  bool stiff = false;          ///< the scene says how stiff contacts are (the md engine needs it)
  std::vector<PairLaw> pairs;  ///< materials * materials, symmetric

  const PairLaw& at(int a, int b) const { return pairs[a * materials + b]; }
  double cohesion_range() const;  ///< largest one
  bool any_rotation() const;
  bool any_rolling() const;
  bool any_cohesion() const;
  bool any_tangential_restitution() const;
};

/// `pressure`: what stiffness level and cohesion number refer to; `diameter`: d.
LawTable law_table(const Scene& scene, std::optional<double> pressure, double diameter);

/// R* = R_i R_j / (R_i + R_j).
inline double reduced_radius(double a, double b) { return a * b / (a + b); }

/// Factor k of F_N = k h (linear) or k h^(3/2) (hertz) for a pair of reduced radius R* (a plane: the grain's radius).
double normal_coefficient(const PairLaw& law, double reduced_radius);

/// h at which the elastic normal force of that coefficient is `force`, and K_N = dF_N/dh there.
double deflection_under(NormalLaw law, double coefficient, double force);
double tangent_stiffness(NormalLaw law, double coefficient, double deflection);

/// Largest elastic force in a head-on collision without damping, relative speed v, reduced mass m*.
double impact_force(NormalLaw law, double coefficient, double reduced_mass, double speed);

/// kappa = K_N / (P d^(D-2)) (linear) or (2 E* / (P d^(D-3)))^(2/3) (hertz; 2 E* = E / (1 - nu^2) between like grains).
double stiffness_level(const PairLaw& law, int dim, double pressure, double diameter);

}  // namespace galet
