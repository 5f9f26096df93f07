#include "common/measure/autocorrelation.hpp"

#include <limits>

namespace galet {

double autocorrelation_time(std::span<const double> series) {
  constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
  const std::size_t count = series.size();
  if (count < 8) return nothing;
  double mean = 0, variance = 0;
  for (const double value : series) mean += value / static_cast<double>(count);
  for (const double value : series) variance += (value - mean) * (value - mean);
  if (!(variance > 0)) return nothing;
  double time = 0.5;
  for (std::size_t window = 1; window <= count / 4; ++window) {
    double sum = 0;
    for (std::size_t i = 0; i + window < count; ++i) sum += (series[i] - mean) * (series[i + window] - mean);
    time += sum / variance;
    if (static_cast<double>(window) >= 5 * time) return time;
  }
  return nothing;
}

}  // namespace galet
