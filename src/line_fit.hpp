// A straight line through points with errors, by weighted least squares:
//   minimise sum_k (y_k - intercept - slope x_k)^2 / error_k^2
// Errors of the line follow from those of the points alone; with_scatter() widens them where the points scatter about
// the line by more than their errors, by sqrt(chi^2 / (n - 2)) (Birge 1932). Pure functions, cost O(n).
#pragma once

#include <cstddef>
#include <span>

#include "common/measure/block_average.hpp"

namespace galet {

struct LinePoint {
  double x = 0;
  Estimate y;
};

/// y = intercept + slope x.
struct LineFit {
  Estimate intercept;
  Estimate slope;         ///< 0 +- 0 when all x are the same: then the intercept is the weighted mean
  double chi_square = 0;  ///< sum of (residual / error)^2; 0 when the errors are unknown
};

/// Weighted least squares. When an error is unknown (0), all weights are 1 and the errors follow from the scatter
/// about the line (0 when no point is left over to show one). Needs at least one point.
LineFit fit_line(std::span<const LinePoint> points);

/// The line of n points with errors widened by their scatter; unchanged for n < 3 or a scatter within the errors.
LineFit with_scatter(LineFit fit, std::size_t points);

}  // namespace galet
