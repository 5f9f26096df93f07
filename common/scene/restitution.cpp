#include "common/scene/restitution.hpp"

#include <cmath>
#include <numbers>

#include "common/core/error.hpp"

namespace galet {

namespace {

using std::numbers::pi;

double linear_restitution(double zeta, DampingConvention convention) {
  if (zeta == 0) return 1;
  if (convention == DampingConvention::elastic) return zeta < 1 ? std::exp(-pi * zeta / std::sqrt(1 - zeta * zeta)) : 0;
  // Both branches meet at zeta = 1, where e = exp(-2); near it the closed forms are 0/0, the limit is exact to 1e-9.
  if (std::abs(zeta - 1) < 1e-9) return std::exp(-2.0);
  if (zeta < 1) return std::exp(-zeta / std::sqrt(1 - zeta * zeta) * (pi - 2 * std::asin(zeta)));
  return std::exp(-2 * zeta * std::acosh(zeta) / std::sqrt(zeta * zeta - 1));
}

double linear_damping(double e, DampingConvention convention) {
  if (e == 1) return 0;
  if (convention == DampingConvention::elastic) {
    const double log_e = std::log(e);
    return -log_e / std::sqrt(pi * pi + log_e * log_e);
  }
  // e falls monotonically with zeta, like zeta^-2 at large zeta.
  double low = 0, high = 1;
  while (linear_restitution(high, convention) > e) high *= 2;
  for (int k = 0; k < 200 && high - low > 1e-16 * high; ++k) {
    const double middle = 0.5 * (low + high);
    (linear_restitution(middle, convention) > e ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

/// zeta of the linear collision that is like the hertzian one with damping ratio 1.
double equivalent(NormalLaw law) { return law == NormalLaw::hertz ? std::sqrt(1.2) : 1; }

}  // namespace

double restitution_of_damping(double zeta, DampingConvention convention, NormalLaw law) {
  return linear_restitution(equivalent(law) * zeta, convention);
}

double damping_of_restitution(double e, DampingConvention convention, NormalLaw law) {
  require(e > 0 && e <= 1, "restitution must be in (0, 1]");
  return linear_damping(e, convention) / equivalent(law);
}

double collision_duration(double zeta, DampingConvention convention, double reduced_mass, double stiffness) {
  const double omega = std::sqrt(stiffness / reduced_mass);
  if (convention == DampingConvention::elastic) {
    // An overdamped pair never separates: its slow relaxation time stands for the duration.
    return zeta < 1 ? pi / (omega * std::sqrt(1 - zeta * zeta)) : 2 * pi * zeta / omega;
  }
  if (std::abs(zeta - 1) < 1e-9) return 2 / omega;
  if (zeta < 1) return (pi - 2 * std::asin(zeta)) / (omega * std::sqrt(1 - zeta * zeta));
  return 2 * std::acosh(zeta) / (omega * std::sqrt(zeta * zeta - 1));
}

}  // namespace galet
