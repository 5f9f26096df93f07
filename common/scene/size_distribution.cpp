#include "common/scene/size_distribution.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace galet {

namespace {

/// Shares by number of a discrete distribution.
std::vector<double> shares_by_number(const SizeDistribution& sizes, int dimension) {
  std::vector<double> share = sizes.fractions;
  if (!sizes.by_volume) return share;
  double sum = 0;
  for (std::size_t k = 0; k < share.size(); ++k) sum += share[k] /= std::pow(sizes.diameters[k], dimension);
  for (double& one : share) one /= sum;
  return share;
}

bool spread_by_volume(const SizeDistribution& sizes) {
  return sizes.kind == SizeKind::uniform && sizes.by_volume && sizes.spread > 0;
}

/// Integral of x^power between a and b.
double power_integral(double a, double b, int power) {
  if (power == -1) return std::log(b / a);
  return (std::pow(b, power + 1) - std::pow(a, power + 1)) / (power + 1);
}

}  // namespace

double diameter_at(const SizeDistribution& sizes, int dimension, double u) {
  if (sizes.kind == SizeKind::monodisperse) return sizes.mean;
  if (spread_by_volume(sizes)) {
    // x^(1-D) is distributed evenly.
    const double low = std::pow(1 - sizes.spread, 1 - dimension), high = std::pow(1 + sizes.spread, 1 - dimension);
    return sizes.mean * std::pow(low - u * (low - high), 1.0 / (1 - dimension));
  }
  if (sizes.kind == SizeKind::uniform) return sizes.mean * (1 + sizes.spread * (2 * u - 1));
  const std::vector<double> share = shares_by_number(sizes, dimension);
  double sum = 0;
  for (std::size_t k = 0; k + 1 < sizes.diameters.size(); ++k) {
    sum += share[k];
    if (u < sum) return sizes.diameters[k];
  }
  return sizes.diameters.back();  // also when rounding leaves the sum a little under 1
}

double mean_power(const SizeDistribution& sizes, int dimension, int power) {
  if (sizes.kind == SizeKind::discrete) {
    const std::vector<double> share = shares_by_number(sizes, dimension);
    double sum = 0;
    for (std::size_t k = 0; k < sizes.diameters.size(); ++k) sum += share[k] * std::pow(sizes.diameters[k], power);
    return sum;
  }
  double factor = 1;
  const double s = sizes.kind == SizeKind::uniform ? sizes.spread : 0;
  if (spread_by_volume(sizes))
    factor = power_integral(1 - s, 1 + s, power - dimension) / power_integral(1 - s, 1 + s, -dimension);
  else if (s > 0 && power > 1)
    factor = power_integral(1 - s, 1 + s, power) / (2 * s);
  return std::pow(sizes.mean, power) * factor;
}

double largest_diameter(const SizeDistribution& sizes) {
  if (sizes.kind != SizeKind::discrete) return sizes.mean * (sizes.kind == SizeKind::uniform ? 1 + sizes.spread : 1);
  double largest = 0;
  for (const double diameter : sizes.diameters) largest = std::max(largest, diameter);
  return largest;
}

}  // namespace galet
