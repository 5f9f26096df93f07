// Does a parameter matter? An effect is the relative change of a quantity between two values of the parameter, with its
// standard error s. It is compared with the change that counts as one, the threshold t, by the interval that holds the
// true change with 95 %: change +- k s, k from Student's distribution where s comes from n samples (n - 1 degrees of
// freedom), 2 where it comes from long averages.
//   Y   the whole interval is beyond the threshold: |change| - k s > t
//   N   the whole interval is within it:            |change| + k s < t   (a test of equivalence, Schuirmann 1987)
//   ?   neither: the runs are too short to tell
// Of several quantities: Y if one says Y, N if all say N, else ?.
#pragma once

#include <span>
#include <vector>

#include "common/measure/block_average.hpp"

namespace galet {

struct Effect {
  Estimate change;       ///< relative
  double threshold = 0;  ///< > 0
  double quantile = 2;   ///< k
};

/// 97.5 % quantile of Student's distribution.
double student_quantile(int degrees_of_freedom);

/// changed / reference - 1, of independent averages.
Effect effect_of_averages(const Estimate& reference, const Estimate& changed, double threshold);

/// The same of samples in pairs (one seed each): mean of the changes and the error of their scatter. NaN when there are
/// fewer than two pairs.
Effect effect_of_pairs(std::span<const double> reference, std::span<const double> changed, double threshold);

/// 'Y', 'N' or '?'.
char letter_of(const Effect& effect);
char letter_of(std::span<const Effect> effects);

/// The effect that the letter rests on: for `Y` the one that is farthest beyond its threshold, else the one that may
/// be. Needs at least one.
const Effect& decisive_effect(std::span<const Effect> effects);

/// |change| / threshold, with an error such that two of it are k s.
Estimate in_thresholds(const Effect& effect);

}  // namespace galet
