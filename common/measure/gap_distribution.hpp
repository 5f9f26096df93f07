// How near the neighbours are that do not, or only just, touch.
//   coordination(g) = 2 (pairs of grains with a gap <= g) / N
// for g = 0 the geometric coordination number, whatever forces the pairs carry. Gaps in units of length; N all grains;
// a grain and its own image count twice for it, as in coordination.hpp; planes are left out. All pairs are searched
// anew, so that engines need not list those that are far from touching.
// Source: Agnolin and Roux 2007 (part I, near neighbours). Cost: a neighbour search.
#pragma once

#include <vector>

#include "common/engine/snapshot.hpp"

namespace galet {

struct GapRow {
  double gap = 0;           ///< g
  double coordination = 0;  ///< of pairs with a gap up to g
};

/// Rows at `intervals` + 1 equally spaced gaps from 0 to `largest`.
template <int D>
std::vector<GapRow> gap_distribution(const Snapshot<D>& snapshot, double largest, int intervals);

extern template std::vector<GapRow> gap_distribution<2>(const Snapshot<2>&, double, int);
extern template std::vector<GapRow> gap_distribution<3>(const Snapshot<3>&, double, int);

}  // namespace galet
