// Exact volumes of parts of grains, for solid fractions of layers and rings.
//   volume_below    part of a grain of radius R below height t, measured from its centre: disk R^2 (pi/2 + asin(t/R)) +
//                   t sqrt(R^2 - t^2), sphere pi (R + t)^2 (2 R - t) / 3
//   volume_within   part of a grain of radius R, whose centre is at distance c from an axis, within distance r of the
//                   axis: disk, the lens of two circles; sphere, the integral of lenses over slices across the axis
//                   (double-exponential quadrature on pieces between tangencies: 1e-10 of the grain's volume)
// Lengths in one unit, volumes (2D: areas) in its power D. Cost: a few operations; a sphere's ring, some hundred
// lenses.
#pragma once

namespace galet {

template <int D>
double volume_below(double height, double radius);

template <int D>
double volume_within(double reach, double distance, double radius);

extern template double volume_below<2>(double, double);
extern template double volume_below<3>(double, double);
extern template double volume_within<2>(double, double, double);
extern template double volume_within<3>(double, double, double);

}  // namespace galet
