// Unbalanced force ratio: how far a packing is from equilibrium.
//
//   r = mean over the grains of |sum of contact forces + m g| / mean over the contacts of |F|
//
// Grains that are left out: those marked in `left_out` (rattlers: nothing balances them). Dimensionless, 0 at rest;
// static packings are usually accepted at 1e-3 to 1e-4. NaN without a grain that counts or without a force. In a cell
// that deforms the mean flow needs forces too: the ratio is meant for cells at rest. Cost: one pass over the contacts.
// Source: Cundall and Strack 1979; the usual definition of PFC and Yade.
#pragma once

#include <vector>

#include "common/engine/snapshot.hpp"

namespace galet {

template <int D>
double unbalanced_force_ratio(const Snapshot<D>& snapshot, const Vec<D>& gravity, const std::vector<char>& left_out);

extern template double unbalanced_force_ratio<2>(const Snapshot<2>&, const Vec<2>&, const std::vector<char>&);
extern template double unbalanced_force_ratio<3>(const Snapshot<3>&, const Vec<3>&, const std::vector<char>&);

}  // namespace galet
