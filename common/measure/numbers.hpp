// Scalar numbers of a state: solid fraction, overlaps, stress ratio, and the control numbers as realised.
//   Phi = sum of grain volumes / V           mu* = |sigma_xy| / sigma_yy
//   P   = tr(sigma) / D
//   I     = |L_xy| sqrt(m / (P d^(D-2)))     with P = sigma_yy in shear (chapter, eq. defI)
//   kappa: common/scene/pair_law.hpp
// d and m: mean diameter and mass of a grain of mean diameter.
#pragma once

#include "common/engine/snapshot.hpp"

namespace galet {

template <int D>
double solid_fraction(const Snapshot<D>& snapshot);

struct Overlap {
  double mean = 0;     ///< mean of max(0, -g) over the contacts, a length
  double largest = 0;  ///< largest -g, a length; 0 without overlap
};

template <int D>
Overlap overlap(const Snapshot<D>& snapshot);

template <int D>
double stress_ratio(const Mat<D>& sigma) {
  return std::abs(sigma(0, 1)) / sigma(1, 1);
}

template <int D>
double mean_pressure(const Mat<D>& sigma) {
  return sigma.trace() / D;
}

/// I for shear rate `rate` under pressure P (a force per length in 2D).
double inertial_number(int dim, double rate, double pressure, double mean_mass, double mean_diameter);

extern template double solid_fraction<2>(const Snapshot<2>&);
extern template double solid_fraction<3>(const Snapshot<3>&);
extern template Overlap overlap<2>(const Snapshot<2>&);
extern template Overlap overlap<3>(const Snapshot<3>&);

}  // namespace galet
