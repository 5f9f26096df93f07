// Profile by distance from an axis: rings of equal width about a centre (disks), or about an axis along z (spheres).
//   velocity        mean over the ring's grains (by centre) of the velocity's radial, tangential and axial components
//   shear_rate      d v_theta / dr - v_theta / r, from the neighbouring rings' means (one-sided at the ends)
//   fluctuation, temperature  as by layers (profile.hpp), of those components
//   solid_fraction  volume of grains inside the ring (each grain cut exactly at the ring's circles) / ring volume
//   stress          in components (r, theta, z): sum over contacts of F (x) b, each piece of the branch in the ring and
//                   the directions of its middle, over the ring volume; contact part only. Positive in compression.
// For annular shear: balance of torques makes r^2 sigma_r,theta constant. Along z the cell is taken whole (its third
// vector must be along z); across the axis there are no images: the axis belongs to the cell, not to a lattice, and a
// cell that is periodic across it is refused. Source: Koval et al. 2009 (annular shear). Cost: one pass.
#pragma once

#include <vector>

#include "common/engine/snapshot.hpp"

namespace galet {

struct RingRow {
  double position = 0;               ///< r, middle of the ring
  int grains = 0;                    ///< centres in the ring
  Vec<3> velocity = Vec<3>::Zero();  ///< (r, theta, z); 0 in a ring without grains
  double shear_rate = 0;
  double fluctuation = 0;  ///< sqrt(<|v - <v>|^2> / D) of the components (r, theta, z)
  double temperature = 0;  ///< <m |v - <v>|^2> / D, an energy
  double solid_fraction = 0;
  Mat<3> stress = Mat<3>::Zero();  ///< (r, theta, z)
};

/// Rings between the radii `inner` and `outer` about `centre` (z of no effect).
template <int D>
std::vector<RingRow> radial_profile(const Snapshot<D>& snapshot, const Vec<D>& centre, double inner, double outer,
                                    int rings);

extern template std::vector<RingRow> radial_profile<2>(const Snapshot<2>&, const Vec<2>&, double, double, int);
extern template std::vector<RingRow> radial_profile<3>(const Snapshot<3>&, const Vec<3>&, double, double, int);

}  // namespace galet
