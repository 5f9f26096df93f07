// Probability density of a sample of values on equal intervals.
//   density_k = (values in interval k) / (all values * width)
// so that the sum of density_k * width is 1 - below - above, the shares that lie outside. The last interval holds its
// upper end. Values that are not numbers are left out. Units: 1 / unit of the values. Cost: one pass.
#pragma once

#include <span>
#include <vector>

namespace galet {

struct Histogram {
  double low = 0;
  double width = 1;
  std::vector<double> density;
  double below = 0;  ///< share of the values under `low`
  double above = 0;  ///< share of the values over the last interval
  long values = 0;

  double centre(std::size_t k) const { return low + (static_cast<double>(k) + 0.5) * width; }
};

Histogram histogram(std::span<const double> values, double low, double high, int intervals);

}  // namespace galet
