#include "common/measure/block_average.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "common/core/error.hpp"

namespace galet {

namespace {

double mean(std::span<const double> values) {
  double sum = 0;
  for (double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

/// Standard error of the mean of uncorrelated values.
double naive_error(std::span<const double> values) {
  const double centre = mean(values);
  double squares = 0;
  for (double value : values) squares += (value - centre) * (value - centre);
  const double count = static_cast<double>(values.size());
  return std::sqrt(squares / (count * (count - 1)));
}

}  // namespace

Estimate block_average(std::span<const double> series, int least_blocks) {
  require(least_blocks >= 2, "block_average needs at least 2 blocks for an error");
  Estimate estimate;
  if (series.empty()) return estimate;
  estimate.value = mean(series);
  if (series.size() < 2) return estimate;

  estimate.error = naive_error(series);  // a short series has this level only
  std::vector<double> blocks(series.begin(), series.end());
  while (blocks.size() / 2 >= static_cast<std::size_t>(least_blocks)) {
    const std::size_t half = blocks.size() / 2;  // an odd last value has no neighbour: left out of this level
    for (std::size_t k = 0; k < half; ++k) blocks[k] = (blocks[2 * k] + blocks[2 * k + 1]) / 2;
    blocks.resize(half);
    estimate.error = std::max(estimate.error, naive_error(blocks));
  }
  return estimate;
}

}  // namespace galet
