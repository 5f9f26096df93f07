// Local solid fraction: each grain in its cell of the radical Voronoi (Laguerre) tessellation.
//   cell of grain i = points with |x - x_i|^2 - R_i^2 least;   local Phi_i = volume of the grain / volume of its cell
// Faces between two grains are where tangents to both have one length: grains that don't overlap lie inside their
// cells, whatever their sizes, and the volumes add up to that of the periodic cell. Disks are tessellated as a slab of
// spheres whose centres lie in one plane, periodic across it, whose cells are the prisms over the cells of the disks.
// By voro++ (Rycroft 2009). Source: Gellatly and Finney 1982 (radical planes). Cost: O(grains).
// The cell must be periodic in each direction, tilted or not, or open in all directions and rectangular, then the cells
// of outer grains end at its faces. Other mixtures are refused (std::invalid_argument).
#pragma once

#include <vector>

#include "common/engine/snapshot.hpp"

namespace galet {

/// Volume (area) of each grain's cell; 0 for a grain without one (covered by a larger one, or outside an open cell).
template <int D>
std::vector<double> voronoi_volumes(const Snapshot<D>& snapshot);

/// Phi_i of each grain; not a number for a grain without a cell.
template <int D>
std::vector<double> local_solid_fraction(const Snapshot<D>& snapshot);

extern template std::vector<double> voronoi_volumes<2>(const Snapshot<2>&);
extern template std::vector<double> voronoi_volumes<3>(const Snapshot<3>&);
extern template std::vector<double> local_solid_fraction<2>(const Snapshot<2>&);
extern template std::vector<double> local_solid_fraction<3>(const Snapshot<3>&);

}  // namespace galet
