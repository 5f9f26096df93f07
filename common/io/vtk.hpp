// Files for ParaView and VTK: PolyData (.vtp) and collections of them in time (.pvd).
//   grains    points, with id, radius, mass, material, velocity (v + L x), fluctuation (v), angular_velocity, the
//             number of contacts, body (its rigid body, -1: none) and boundary (1: of a body that does not move as
//             grains do, such as a rough wall) (glyph: sphere, scaled by radius * 2)
//   contacts  lines along the branches, with force (on j), normal_force, tangential_force, gap, i, j, touching and,
//   with
//             friction, mobilised (not a number: no friction); a plane's number follows the grains'
//   cell      the edges of the cell, with periodic (1: along a direction in which it is)
//   walls     planes and cylinders, cut to the sample (geometry/boundary_surface.hpp): polygons, or lines of disks,
//   with
//             j (their number in contacts), velocity of the surface, and normal (to the grains' side)
// Grains lie inside the cell; a branch goes from grain i to the image of j that it meets. Disks lie in the plane z = 0,
// their spins along z. Numbers are the snapshot's 64-bit floats, bit for bit (base64 in XML). Format: VTK file formats,
// version 1.0, header_type UInt64, little endian.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "common/engine/snapshot.hpp"

namespace galet {

/// `material`: of each grain; empty: all 0.
template <int D>
std::string vtp_grains(const Snapshot<D>& snapshot, const std::vector<int>& material = {});
template <int D>
std::string vtp_contacts(const Snapshot<D>& snapshot);
template <int D>
std::string vtp_cell(const Snapshot<D>& snapshot);
template <int D>
std::string vtp_walls(const Snapshot<D>& snapshot);

/// A collection: files (relative to its own folder) and their times.
std::string pvd(const std::vector<std::pair<double, std::string>>& files);

extern template std::string vtp_grains<2>(const Snapshot<2>&, const std::vector<int>&);
extern template std::string vtp_grains<3>(const Snapshot<3>&, const std::vector<int>&);
extern template std::string vtp_contacts<2>(const Snapshot<2>&);
extern template std::string vtp_contacts<3>(const Snapshot<3>&);
extern template std::string vtp_cell<2>(const Snapshot<2>&);
extern template std::string vtp_cell<3>(const Snapshot<3>&);
extern template std::string vtp_walls<2>(const Snapshot<2>&);
extern template std::string vtp_walls<3>(const Snapshot<3>&);

}  // namespace galet
