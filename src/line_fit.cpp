#include "src/line_fit.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "common/core/error.hpp"

namespace galet {

namespace {

struct WeightedMoments {
  double weight = 0, x = 0, y = 0, xx = 0, xy = 0;  ///< sums of w, w x, ..., with x and y about their means
  double mean_x = 0, mean_y = 0;
};

/// Moments about the means: differences of large sums would lose digits when x is tiny, as 1/kappa is.
WeightedMoments moments(std::span<const LinePoint> points, std::span<const double> weights) {
  WeightedMoments sums;
  for (std::size_t k = 0; k < points.size(); ++k) {
    sums.weight += weights[k];
    sums.mean_x += weights[k] * points[k].x;
    sums.mean_y += weights[k] * points[k].y.value;
  }
  sums.mean_x /= sums.weight;
  sums.mean_y /= sums.weight;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const double x = points[k].x - sums.mean_x;
    sums.xx += weights[k] * x * x;
    sums.xy += weights[k] * x * (points[k].y.value - sums.mean_y);
  }
  return sums;
}

bool same_x(std::span<const LinePoint> points) {
  return std::all_of(points.begin(), points.end(), [&](const LinePoint& point) { return point.x == points[0].x; });
}

double squared_residuals(std::span<const LinePoint> points, std::span<const double> weights, const LineFit& fit) {
  double sum = 0;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const double residual = points[k].y.value - fit.intercept.value - fit.slope.value * points[k].x;
    sum += weights[k] * residual * residual;
  }
  return sum;
}

}  // namespace

LineFit fit_line(std::span<const LinePoint> points) {
  require(!points.empty(), "a line needs at least one point");
  const bool known = std::all_of(points.begin(), points.end(), [](const LinePoint& p) { return p.y.error > 0; });
  std::vector<double> weights;
  for (const LinePoint& point : points) weights.push_back(known ? 1 / (point.y.error * point.y.error) : 1);

  const WeightedMoments sums = moments(points, weights);
  const bool flat = same_x(points);
  LineFit fit;
  fit.slope.value = flat ? 0 : sums.xy / sums.xx;
  fit.intercept.value = sums.mean_y - fit.slope.value * sums.mean_x;

  // Variances for weights 1/error^2; with unit weights they are in units of the scatter's variance.
  const double slope_variance = flat ? 0 : 1 / sums.xx;
  const double intercept_variance = 1 / sums.weight + sums.mean_x * sums.mean_x * slope_variance;
  const double squares = squared_residuals(points, weights, fit);
  const int left_over = static_cast<int>(points.size()) - (flat ? 1 : 2);
  const double scatter = known ? 1 : (left_over > 0 ? squares / left_over : 0);
  fit.slope.error = std::sqrt(scatter * slope_variance);
  fit.intercept.error = std::sqrt(scatter * intercept_variance);
  fit.chi_square = known ? squares : 0;
  return fit;
}

LineFit with_scatter(LineFit fit, std::size_t points) {
  if (points < 3) return fit;
  const double scatter = std::sqrt(fit.chi_square / static_cast<double>(points - 2));
  if (scatter > 1) fit.intercept.error *= scatter, fit.slope.error *= scatter;
  return fit;
}

}  // namespace galet
