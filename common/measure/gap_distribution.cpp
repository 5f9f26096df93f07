#include "common/measure/gap_distribution.hpp"

#include <algorithm>
#include <cmath>

#include "common/core/error.hpp"
#include "common/neighbour/verlet_list.hpp"

namespace galet {

template <int D>
std::vector<GapRow> gap_distribution(const Snapshot<D>& snapshot, double largest, int intervals) {
  require(largest > 0 && intervals > 0, "a distribution of gaps needs a range");
  std::vector<Vec<D>> position(snapshot.position.begin(), snapshot.position.end());
  Cell<D> cell = *snapshot.cell;
  VerletList<D> list;
  list.configure(largest, largest / intervals);  // pairs just beyond the last row are listed and not counted
  list.build(position, snapshot.radius, cell, {});

  const double width = largest / intervals;
  std::vector<GapRow> rows(intervals + 1);
  const PairColumns<D>& pairs = list.pairs();
  for (std::size_t row = 0; row < pairs.size(); ++row) {
    const int i = pairs.i[row], j = pairs.j[row];
    const Vec<D> branch = position[j] + lattice<D>(cell.box, pairs.image[row]) - position[i];
    const double gap = branch.norm() - snapshot.radius[i] - snapshot.radius[j];
    const double first = std::max(0.0, std::ceil(gap / width));  // the first row that this pair counts in
    if (first <= intervals) rows[static_cast<std::size_t>(first)].coordination += 2.0 / snapshot.grains();
  }
  for (int k = 0; k <= intervals; ++k) {
    rows[k].gap = k * width;
    if (k > 0) rows[k].coordination += rows[k - 1].coordination;
  }
  return rows;
}

template std::vector<GapRow> gap_distribution<2>(const Snapshot<2>&, double, int);
template std::vector<GapRow> gap_distribution<3>(const Snapshot<3>&, double, int);

}  // namespace galet
