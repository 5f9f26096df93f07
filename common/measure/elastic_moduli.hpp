// Elastic moduli of the contact network in a periodic cell, from its stiffness matrix.
//   sigma_a = sum_b C_ab strain_b          (Voigt: xx, yy, (zz,) xy, (xz, yz); strain xy = 2 e_xy; compression positive
//                                           in both)
//   C = (K_ee - K_eg K_gg^-1 K_ge) / V,    [K_gg K_ge; K_eg K_ee] = G diag(k) G^T
// G: equilibrium matrix of the network with the unit strains of the cell (equilibrium_matrix.hpp), k: stiffness of each
// component of contact force, K_N along the normal, K_T across it. Grains move and turn so as to stay in equilibrium;
// the first term alone is the affine (Voigt) estimate, an upper bound. Isotropic averages over directions:
//   bulk  C_iijj / D^2          shear  (C_ijij - C_iijj / D) / ((D + 2)(D - 1))
// Response to small strains: no contact opens, closes or slides, and the turning of the forces themselves, smaller by
// the deflection over d, is left out. Rattlers are left out. Mechanisms cost nothing and are no mistake: K_gg is
// factorised (CHOLMOD) with a shift of 1e-10 of its largest element, which two rounds of refinement remove where it
// matters. Units: force / length^(D-1). Sources: Roux 2000; Agnolin and Roux 2007 (III). Cost: one sparse Cholesky
// factorisation.
#pragma once

#include <optional>
#include <vector>

#include "common/engine/snapshot.hpp"
#include "common/measure/equilibrium_matrix.hpp"
#include "common/scene/pair_law.hpp"

namespace galet {

/// K_N and K_T of one contact.
struct ContactStiffness {
  double normal = 0;
  double tangential = 0;  ///< 0: none (frictionless)
};

/// Stiffness of each contact by the scene's laws. `material` of each grain, `plane_material` of each plane (empty: 0).
/// The deflection is the overlap where there is one (md), else the one that the normal force would cause (rigid
/// grains). Viscous parts of the forces are not looked for: meant for equilibrium. Linear attraction by its slope:
/// K_N(h) - sqrt(K_N F0 / h) for the square-root law.
template <int D>
std::vector<ContactStiffness> contact_stiffness(const Snapshot<D>& snapshot, const LawTable& laws,
                                                const std::vector<int>& material,
                                                const std::vector<int>& plane_material);

struct ElasticModuli {
  Eigen::MatrixXd stiffness;  ///< C: 3 x 3 in 2D, 6 x 6 in 3D
  Eigen::MatrixXd affine;     ///< K_ee / V
  double bulk = 0, shear = 0;
  double affine_bulk = 0, affine_shear = 0;
};

/// None without a network, or in a cell that is open in some direction or has planes: it has no strain of its own.
template <int D>
std::optional<ElasticModuli> elastic_moduli(const Snapshot<D>& snapshot, const std::vector<ContactStiffness>& stiffness,
                                            const NetworkOptions& options);

extern template std::vector<ContactStiffness> contact_stiffness<2>(const Snapshot<2>&, const LawTable&,
                                                                   const std::vector<int>&, const std::vector<int>&);
extern template std::vector<ContactStiffness> contact_stiffness<3>(const Snapshot<3>&, const LawTable&,
                                                                   const std::vector<int>&, const std::vector<int>&);
extern template std::optional<ElasticModuli> elastic_moduli<2>(const Snapshot<2>&, const std::vector<ContactStiffness>&,
                                                               const NetworkOptions&);
extern template std::optional<ElasticModuli> elastic_moduli<3>(const Snapshot<3>&, const std::vector<ContactStiffness>&,
                                                               const NetworkOptions&);

}  // namespace galet
