// Split of a strain increment of a packing between two of its states.
//   total  = strain(after) - strain(before)
//   type I = C^-1 (sigma(after) - sigma(before))     deformation of the contacts of an unchanged network
//   type II = total - type I                         sliding and rearrangement of the network
// C: elastic moduli of the contact network of the first state (elastic_moduli.hpp), Voigt components xx, yy, (zz,) xy,
// (xz, yz) with strain xy = 2 e_xy; compression positive in strain and stress. Type I shrinks like 1 / kappa at given
// stress, type II does not. C is that of the first state: meant for increments small enough for it to stay, and states
// in equilibrium. Defined where C is regular, its least eigenvalue above 1e-6 of the largest: else the network has
// strains that need no stress, and there is no answer. Sources: Roux 2000; Roux and Combe 2002. Cost: D^6.
#pragma once

#include <optional>

#include <Eigen/Core>

#include "common/core/types.hpp"
#include "common/measure/elastic_moduli.hpp"

namespace galet {

struct StrainSplit {
  Eigen::VectorXd total, type_one, type_two;
};

/// Stress and strain of a state as symmetric tensors, e_xy in both places.
template <int D>
struct StressStrain {
  Mat<D> stress = Mat<D>::Zero();
  Mat<D> strain = Mat<D>::Zero();
};

template <int D>
std::optional<StrainSplit> strain_split(const StressStrain<D>& before, const StressStrain<D>& after,
                                        const ElasticModuli& moduli);

extern template std::optional<StrainSplit> strain_split<2>(const StressStrain<2>&, const StressStrain<2>&,
                                                           const ElasticModuli&);
extern template std::optional<StrainSplit> strain_split<3>(const StressStrain<3>&, const StressStrain<3>&,
                                                           const ElasticModuli&);

}  // namespace galet
