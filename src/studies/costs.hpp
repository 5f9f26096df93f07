// What each engine of a study costs at equal error. A mean over a long run to a standard error of 1 % takes
//   seconds (100 error / value)^2;
// a mean over samples (rows that differ in their seed alone) takes
//   (seconds of a sample) (100 s)^2,  s their standard deviation over their mean,
// because what is uncertain there is the packing, not the average over its time. For the same reason s is taken as one
// number for both engines, from the deviations of all samples from the mean of their engine. Neither cost depends on
// how long the runs were or how many. s of n samples is known to 1 / sqrt(2 (n - 2)) only, the ratio of costs much
// better: it is that of the seconds of a sample.
#pragma once

#include <string>
#include <vector>

#include "src/studies/study.hpp"

namespace galet {

struct CostPair {
  std::string state;  ///< "I = 0.1, mu = 0.4": what the rows of both engines share
  double md = 0, cd = 0;
};
/// Of the states that both engines have. Rows of md and of cd with one kappa are a pair; rigid grains have the stiffest
/// of md's beside them. A single run that came to rest says nothing about its error and is left out.
std::vector<CostPair> cost_pairs(const Study& study, const std::vector<StudyRow>& rows);

/// Processor seconds to a standard error of 1 %, of a long run; NaN when the error is not known.
double seconds_to_one_percent(const StudyRow& row, Observable observable);

}  // namespace galet
