// Small spheres on a shaken cubic lattice with large ones in its middle, for benchmarks of unlike sizes.
#pragma once

#include <algorithm>
#include <vector>

#include "common/core/random.hpp"
#include "common/scene/sample.hpp"

namespace galet::bench {

/// `side`^3 sites `spacing` apart for grains of diameter 1; `large`^3 grains of diameter `ratio`, regularly spaced, in
/// place of the small ones that they would touch. Periodic.
inline Sample<3> unlike_sample(int side, double spacing, double ratio, int large) {
  Sample<3> sample;
  const double edge = side * spacing;
  sample.cell.box = edge * Mat<3>::Identity();
  sample.cell.periodic.fill(true);
  std::vector<Vec<3>> centres;
  for (int k = 0; k < large * large * large; ++k)
    centres.push_back(edge / large * Vec<3>(k % large + 0.5, k / large % large + 0.5, k / large / large + 0.5));
  sample.position = centres;
  sample.radius.assign(centres.size(), ratio / 2);
  const double shake = 0.4 * std::min(0.5, spacing - 1);
  for (int k = 0; k < side * side * side; ++k) {
    RandomStream random(1, static_cast<std::uint64_t>(k));
    Vec<3> x = spacing * Vec<3>(k % side + 0.5, k / side % side + 0.5, k / side / side + 0.5);
    for (int a = 0; a < 3; ++a) x[a] += random.uniform(-shake, shake);
    const bool free = std::none_of(centres.begin(), centres.end(),
                                   [&](const Vec<3>& centre) { return (x - centre).norm() < (ratio + 1) / 2; });
    if (!free) continue;
    sample.position.push_back(x);
    sample.radius.push_back(0.5);
  }
  return sample;
}

}  // namespace galet::bench
