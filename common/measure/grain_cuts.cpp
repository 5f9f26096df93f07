#include "common/measure/grain_cuts.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace galet {

namespace {

using std::numbers::pi;

/// Area common to two disks of radii a and b whose centres are c apart: two circular segments on one chord.
double lens(double a, double b, double c) {
  if (c >= a + b) return 0;
  const double small = std::min(a, b);
  if (c <= std::abs(a - b)) return pi * small * small;
  const auto segment = [c](double own, double other) {
    const double foot = (c * c + own * own - other * other) / (2 * c);  // of the chord, from the own centre
    const double half_chord = std::sqrt(std::max(0.0, own * own - foot * foot));
    return own * own * std::atan2(half_chord, foot) - foot * half_chord;
  };
  return segment(a, b) + segment(b, a);
}

/// Integral over [from, to] of f, smooth inside and with roots at the ends: tanh-sinh rule.
template <class F>
double integral(double from, double to, const F& f) {
  constexpr double step = 0.125, last = 3.25;  // beyond, weights are below 1e-16
  const double middle = 0.5 * (from + to), half = 0.5 * (to - from);
  double sum = 0;
  for (int k = -static_cast<int>(last / step); k <= static_cast<int>(last / step); ++k) {
    const double t = k * step, inner = 0.5 * pi * std::sinh(t);
    const double weight = 0.5 * pi * std::cosh(t) / (std::cosh(inner) * std::cosh(inner));
    sum += weight * f(middle + half * std::tanh(inner));
  }
  return half * step * sum;
}

}  // namespace

template <int D>
double volume_below(double height, double radius) {
  const double t = std::clamp(height, -radius, radius);
  if constexpr (D == 2) {
    const double half_chord = std::sqrt((radius - t) * (radius + t));
    return radius * radius * (pi / 2 + std::atan2(t, half_chord)) + t * half_chord;
  } else {
    return pi * (radius + t) * (radius + t) * (2 * radius - t) / 3;
  }
}

template <int D>
double volume_within(double reach, double distance, double radius) {
  if constexpr (D == 2) {
    return lens(radius, reach, distance);
  } else {
    if (reach <= 0 || distance >= reach + radius) return 0;
    if (distance + radius <= reach) return 4 * pi / 3 * radius * radius * radius;
    // Heights at which the slice's circle touches the axis's: there the area bends.
    std::vector<double> ends = {0, radius};
    for (const double touching : {std::abs(reach - distance), reach + distance})
      if (touching < radius) ends.push_back(std::sqrt((radius - touching) * (radius + touching)));
    std::sort(ends.begin(), ends.end());
    double half = 0;
    for (std::size_t k = 0; k + 1 < ends.size(); ++k)
      half += integral(ends[k], ends[k + 1], [&](double z) {
        return lens(std::sqrt(std::max(0.0, (radius - z) * (radius + z))), reach, distance);
      });
    return 2 * half;
  }
}

template double volume_below<2>(double, double);
template double volume_below<3>(double, double);
template double volume_within<2>(double, double, double);
template double volume_within<3>(double, double, double);

}  // namespace galet
