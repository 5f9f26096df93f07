#include "common/measure/histogram.hpp"

#include <cmath>

#include "common/core/error.hpp"

namespace galet {

Histogram histogram(std::span<const double> values, double low, double high, int intervals) {
  require(high > low && intervals > 0, "a histogram needs an interval");
  Histogram result;
  result.low = low;
  result.width = (high - low) / intervals;
  result.density.assign(intervals, 0);
  for (double value : values) {
    if (std::isnan(value)) continue;
    ++result.values;
    if (value < low) {
      ++result.below;
    } else if (value > high) {
      ++result.above;
    } else {
      const int k = static_cast<int>((value - low) / result.width);
      ++result.density[std::min(k, intervals - 1)];
    }
  }
  if (result.values == 0) return result;
  const double all = static_cast<double>(result.values);
  result.below /= all, result.above /= all;
  for (double& density : result.density) density /= all * result.width;
  return result;
}

}  // namespace galet
