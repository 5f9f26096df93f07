// Mean of a correlated series with its standard error, by blocking (Flyvbjerg and Petersen 1989): the series is
// halved repeatedly by averaging neighbours, and the error is the largest of the naive errors of the levels that
// still have at least `least_blocks` blocks (a plateau from below).
#pragma once

#include <span>

namespace galet {

struct Estimate {
  double value = 0;
  double error = 0;  ///< standard error of the mean; 0 for fewer than 2 values
};

Estimate block_average(std::span<const double> series, int least_blocks = 16);

}  // namespace galet
