// How far the grains are from equilibrium: resultants against contact forces.
//   force  = <|sum of contact forces + m gravity|> / <|F|>
//   torque = <|sum of contact torques|> / (<|F|> d/2)
// means of resultants over the grains that are no rattlers, <|F|> over the contacts that end on them; d mean diameter.
// Zero in equilibrium; of the order of sqrt(z) where forces on a grain are independent. In steady flow it does not
// vanish. Not a number where no force acts. Source: Radjai et al. 1996; Agnolin and Roux 2007 (tolerances on forces and
// moments). Cost: one pass.
#pragma once

#include <vector>

#include "common/engine/snapshot.hpp"

namespace galet {

struct Balance {
  double force = 0;
  double torque = 0;  ///< 0 in layouts without rotations
};

/// `loose`: 1 for a grain that is left out (rattlers, and grains of rigid bodies).
template <int D>
Balance unbalance(const Snapshot<D>& snapshot, const std::vector<char>& loose, const Vec<D>& gravity = Vec<D>::Zero());

extern template Balance unbalance<2>(const Snapshot<2>&, const std::vector<char>&, const Vec<2>&);
extern template Balance unbalance<3>(const Snapshot<3>&, const std::vector<char>&, const Vec<3>&);

}  // namespace galet
