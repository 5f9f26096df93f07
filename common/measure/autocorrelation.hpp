// How long a series remembers: its integrated autocorrelation time, in units of the interval between its values,
//   tau = 1/2 + sum_{k=1}^{W} rho_k,   rho_k = sum_i (x_i - <x>)(x_{i+k} - <x>) / sum_i (x_i - <x>)^2
// with the smallest window W >= 5 tau(W) (Sokal's rule: what lies beyond is noise). rho = exp(-k/T) gives tau = T for
// T >> 1, values without memory 1/2. The mean of n values has the variance of 2 tau n^-1 times that of one value; the
// errors of block_average.hpp say the same by another way.
// No meaning, hence not a number: fewer than 8 values, all equal, or a window that doesn't close within a quarter of
// the series (a memory that the series is too short to show).
// Source: Madras and Sokal 1988, appendix C. Cost: n W.
#pragma once

#include <span>

namespace galet {

double autocorrelation_time(std::span<const double> series);

}  // namespace galet
