#include "common/measure/numbers.hpp"

#include <algorithm>
#include <cmath>

namespace galet {

template <int D>
double solid_fraction(const Snapshot<D>& snapshot) {
  double volume = 0;
  for (double radius : snapshot.radius) volume += grain_volume<D>(2 * radius);
  return volume / snapshot.cell->volume();
}

template <int D>
Overlap overlap(const Snapshot<D>& snapshot) {
  Overlap result;
  if (snapshot.contacts->size() == 0) return result;
  double sum = 0;
  long touching = 0;
  for (std::size_t c = 0; c < snapshot.contacts->size(); ++c) {
    if (!snapshot.contacts->touches(c)) continue;
    const double deflection = std::max(0.0, -snapshot.contacts->gap[c]);
    sum += deflection;
    ++touching;
    result.largest = std::max(result.largest, deflection);
  }
  if (touching > 0) result.mean = sum / static_cast<double>(touching);
  return result;
}

namespace {
/// P d^(D-2): a force per length, the scale of stiffness in both dimensions.
double pressure_scale(int dim, double pressure, double mean_diameter) {
  return dim == 2 ? pressure : pressure * mean_diameter;
}
}  // namespace

double inertial_number(int dim, double rate, double pressure, double mean_mass, double mean_diameter) {
  return std::abs(rate) * std::sqrt(mean_mass / pressure_scale(dim, pressure, mean_diameter));
}

template double solid_fraction<2>(const Snapshot<2>&);
template double solid_fraction<3>(const Snapshot<3>&);
template Overlap overlap<2>(const Snapshot<2>&);
template Overlap overlap<3>(const Snapshot<3>&);

}  // namespace galet
