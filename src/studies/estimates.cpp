#include "src/studies/estimates.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace galet {

Estimate operator-(const Estimate& a, const Estimate& b) { return {a.value - b.value, std::hypot(a.error, b.error)}; }

Estimate operator*(double factor, const Estimate& a) { return {factor * a.value, std::abs(factor) * a.error}; }

Estimate ratio(const Estimate& a, const Estimate& b) {
  return {a.value / b.value, std::hypot(a.error, a.value / b.value * b.error) / std::abs(b.value)};
}

Estimate weighted_mean(std::span<const Estimate> values) {
  const bool known = std::all_of(values.begin(), values.end(), [](const Estimate& v) { return v.error > 0; });
  double weights = 0, sum = 0, squares = 0;
  for (const Estimate& v : values) {
    const double weight = known ? 1 / (v.error * v.error) : 1;
    weights += weight, sum += weight * v.value;
  }
  if (values.empty()) return {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::quiet_NaN()};
  const double mean = sum / weights;
  if (known) return {mean, 1 / std::sqrt(weights)};
  for (const Estimate& v : values) squares += (v.value - mean) * (v.value - mean);
  const double n = static_cast<double>(values.size());
  return {mean, n > 1 ? std::sqrt(squares / (n * (n - 1))) : 0};
}

}  // namespace galet
