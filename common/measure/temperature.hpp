// Granular temperatures: energies of the fluctuations per degree of freedom.
//   T   = sum of m |v - V|^2 / (D N)           V: velocity of the centre of mass
//   T_r = sum of I |w - W|^2 / (D_r N)         W: mean spin; D_r = 1 for disks, 3 for spheres
// v is the fluctuation about the cell's affine flow (snapshot.hpp), so that a homogeneous shear flow is no temperature;
// where the flow is not homogeneous use the profile, whose layers have means of their own (profile.hpp).
// Units: energy (some authors divide by m). Source: Goldhirsch 2003. Cost: two passes over the grains.
#pragma once

#include "common/engine/snapshot.hpp"

namespace galet {

struct Temperature {
  double translational = 0;
  double rotational = 0;  ///< 0 in layouts without rotations
};

template <int D>
Temperature granular_temperature(const Snapshot<D>& snapshot);

extern template Temperature granular_temperature<2>(const Snapshot<2>&);
extern template Temperature granular_temperature<3>(const Snapshot<3>&);

}  // namespace galet
