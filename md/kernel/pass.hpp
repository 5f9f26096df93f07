// The contact pass over blocks of rows, compiled once per width of the lanes.
#pragma once

#include "md/kernel/rows.hpp"

namespace galet::md {

/// Where the next rows are is found before the law of the present ones is applied: its long chain of operations waits
/// for none of them, nor they for it. (After the last block comes one that only fills up.)
template <Layout Y, Kernel K, int W>
void evaluate_blocks(const PassView& given, std::size_t begin, std::size_t end, LaneSums& sums) {
  if (begin == end) return;
  const PassView view = given;  // a copy that nothing else can change: it stays in registers
  Rows<Y, K, W> rows(view, sums);
  const auto place = [&](std::size_t index, int lane) { return place_of<Y, W>(view, view.blocks[index], lane); };
  if constexpr (W == 1) {
    for (std::size_t index = begin; index < end; ++index)
      for (int lane = 0; lane < block_rows; ++lane) rows.evaluate(place(index, lane), index, lane);
  } else if constexpr (W == block_rows) {
    Place<Y, W> present = place(begin, 0);
    for (std::size_t index = begin; index < end; ++index) {
      const Place<Y, W> next = place(index + 1, 0);
      rows.evaluate(present, index, 0);
      present = next;
    }
  } else {
    static_assert(2 * W == block_rows);
    Place<Y, W> low = place(begin, 0);
    for (std::size_t index = begin; index < end; ++index) {
      const Place<Y, W> high = place(index, W);
      rows.evaluate(low, index, 0);
      low = place(index + 1, 0);
      rows.evaluate(high, index, W);
    }
  }
}

/// The kernels of one layout.
template <Layout Y, int W>
PassFunction pass_of_width(Kernel kernel) {
  if (kernel.account) return evaluate_blocks<Y, Kernel{true, false, true}, W>;
  if (kernel.general) return evaluate_blocks<Y, Kernel{true, false, false}, W>;
  if (kernel.hertz) return evaluate_blocks<Y, Kernel{false, true, false}, W>;
  return evaluate_blocks<Y, Kernel{false, false, false}, W>;
}

}  // namespace galet::md
