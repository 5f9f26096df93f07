// Contacts and their forces by direction, in one plane: what a polar histogram shows.
//   sector k: normals n with an angle theta in [k, k + 1) pi / sectors from axis e_1 towards e_2 of the plane, n and -n
//             being one direction
//   density          contacts of the sector / contacts per sector of an isotropic packing:  (c_k / c) sectors
//   normal_force     <F_N> of the sector / <F_N> of all contacts
//   tangential_force <F_T.t> of the sector / <F_N> of all, t: n turned by +90 degrees in the plane; F force on j
// In space n and F are projected on the plane, where an isotropic packing has the density 1 again (its normals are
// uniform on the circle whatever their length); normals at right angles to the plane are left out. To first order the
// density is 1 + a_c cos 2(theta - theta_c), and the forces go like fabric.hpp says (2D).
// Contacts between grains that touch; contacts with planes have the planes' directions and are left out. A sector
// without contacts has no forces: NaN. Source: Rothenburg and Bathurst 1989. Cost: one pass.
#pragma once

#include <array>
#include <vector>

#include "common/engine/snapshot.hpp"

namespace galet {

struct DirectionRow {
  double angle = 0;  ///< middle of the sector, radians, in (0, pi)
  long contacts = 0;
  double density = 0;
  double normal_force = 0;
  double tangential_force = 0;
};

/// `axes`: the numbers of e_1 and e_2 (0, 1, 2: x, y, z), unlike. Empty without contacts.
template <int D>
std::vector<DirectionRow> contact_directions(const Snapshot<D>& snapshot, int sectors,
                                             std::array<int, 2> axes = {0, 1});

extern template std::vector<DirectionRow> contact_directions<2>(const Snapshot<2>&, int, std::array<int, 2>);
extern template std::vector<DirectionRow> contact_directions<3>(const Snapshot<3>&, int, std::array<int, 2>);

}  // namespace galet
