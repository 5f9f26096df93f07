// Differences, ratios and means of independent estimates, with first-order errors. NaN goes through.
#pragma once

#include <span>

#include "common/measure/block_average.hpp"

namespace galet {

Estimate operator-(const Estimate& a, const Estimate& b);
Estimate operator*(double factor, const Estimate& a);
/// a / b; relative errors add in quadrature.
Estimate ratio(const Estimate& a, const Estimate& b);
/// Mean with weights 1/error^2; plain mean with the error of its scatter when an error is unknown (0). NaN for none.
Estimate weighted_mean(std::span<const Estimate> values);

}  // namespace galet
