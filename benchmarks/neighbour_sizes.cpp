// Cost of making a neighbour list anew, per grain, for equal grains and for size ratios of 1:10 and
// 1:50, dense and dilute. One row per sample on stdout, comma separated; times are the best of several builds, in ns.
//
// Samples in 3D, periodic: small grains (diameter 1) on a shaken cubic lattice, large ones in its middle, in place of
// the small ones that they would touch. The list's skin is 0.1.
#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "benchmarks/unlike_sample.hpp"
#include "common/core/clock.hpp"
#include "common/neighbour/verlet_list.hpp"
#include "common/scene/sample.hpp"

using namespace galet;

namespace {

using bench::unlike_sample;

void measure(const char* name, Sample<3> sample, double ratio) {
  VerletList<3> list;
  list.configure(0, 0.1);
  double best = 1e300;
  for (int k = 0; k < 7; ++k) {
    const double start = wall_seconds();
    list.build(sample.position, sample.radius, sample.cell, {});
    best = std::min(best, wall_seconds() - start);
  }
  const double grains = static_cast<double>(sample.position.size()), pairs = static_cast<double>(list.size());
  double solid = 0;
  for (const double radius : sample.radius) solid += grain_volume<3>(2 * radius);
  fmt::print("{},{},{},{:.4g},{:.2f},{:.0f}\n", name, ratio, sample.position.size(), solid / sample.cell.volume(),
             pairs / grains, 1e9 * best / grains);
}

}  // namespace

int main() {
  fmt::print("sample,size_ratio,grains,solid_fraction,pairs_per_grain,ns_per_grain\n");
  measure("equal", unlike_sample(40, 1.05, 1, 0), 1);
  measure("one_in_ten", unlike_sample(42, 1.05, 10, 3), 10);
  measure("one_in_fifty", unlike_sample(60, 1.05, 50, 1), 50);
  measure("dilute", unlike_sample(40, 3, 1, 0), 1);
  measure("very_dilute", unlike_sample(40, 20, 1, 0), 1);
  measure("dilute_one_in_ten", unlike_sample(40, 3, 10, 3), 10);
}
