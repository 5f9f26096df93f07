// A dense disordered packing by geometry alone, without any mechanics: grains are placed at random with reduced radii,
// which then grow step by step to their own, while overlaps are pushed apart after each step.
//
//   minimise  E = 1/2 sum of overlap^2 (pairs, boundaries, fixed grains)    at each radius, by descent with momentum
//   x += alpha f + beta (x - x before),   f = sum of overlap * n on the grain
// The last radii are larger than the true ones by 1 part in 2000, and it ends as soon as no true pair overlaps: below
// the density at which the packing jams E gets to zero in finitely many moves. Nothing touches in the end. It is a
// growth protocol like that of Lubachevsky and Stillinger (1990), with descent (O'Hern et al. 2003) in place of
// collisions. Reaches 0.83 (disks with some spread of sizes) and 0.62 (spheres); above, it ends with an error.
// Cost: some hundred to some ten thousand passes over the pairs; a second for 1000 disks at 0.82.
#pragma once

#include <cstdint>
#include <vector>

#include "common/geometry/cell.hpp"
#include "common/geometry/plane.hpp"
#include "common/scene/random_insertion.hpp"

namespace galet {

/// Positions for grains of the given radii, none overlapping another, a boundary or an obstacle. Throws InputError when
/// they don't fit.
template <int D>
std::vector<Vec<D>> dense_packing(const Cell<D>& cell, const std::vector<Plane<D>>& planes,
                                  const std::vector<double>& radius, std::uint64_t seed, const Obstacles<D>& obstacles);

extern template std::vector<Vec<2>> dense_packing<2>(const Cell<2>&, const std::vector<Plane<2>>&,
                                                     const std::vector<double>&, std::uint64_t, const Obstacles<2>&);
extern template std::vector<Vec<3>> dense_packing<3>(const Cell<3>&, const std::vector<Plane<3>>&,
                                                     const std::vector<double>&, std::uint64_t, const Obstacles<3>&);

}  // namespace galet
