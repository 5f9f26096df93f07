// Distributions of the contact forces between grains: the densities P(F_N / <F_N>) and P(|F_T| / <|F_T|>).
// Over the contacts between grains that touch; F_N may be negative with cohesion or, in md, at the end of a collision
// (then counted as `below`). Scaled by the mean, so that both axes are pure numbers; a mean that is not above 0 leaves
// the distribution without values. Source: Radjai et al. 1996. Cost: one pass.
#pragma once

#include "common/engine/snapshot.hpp"
#include "common/measure/histogram.hpp"

namespace galet {

struct ForceDistribution {
  double mean_normal = 0;      ///< <F_N>
  double mean_tangential = 0;  ///< <|F_T|>
  Histogram normal;            ///< of F_N / <F_N>, on [0, largest]
  Histogram tangential;        ///< of |F_T| / <|F_T|>, on [0, largest]
};

template <int D>
ForceDistribution force_distribution(const Snapshot<D>& snapshot, double largest = 6, int intervals = 60);

extern template ForceDistribution force_distribution<2>(const Snapshot<2>&, double, int);
extern template ForceDistribution force_distribution<3>(const Snapshot<3>&, double, int);

}  // namespace galet
