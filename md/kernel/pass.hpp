// The contact pass over blocks of rows, compiled once per width of the lanes.
#pragma once

#include "md/kernel/rows.hpp"

namespace galet::md {

/// The geometry of a block that has rows with planes: row by row.
template <Layout Y, int W>
[[gnu::noinline]] Geometry<Y, W> mixed_geometry(const PassView& view, const RowBlock& block, int lane) {
  static_assert(sizeof(Geometry<Y, 1>) % sizeof(double) == 0);
  constexpr int fields = sizeof(Geometry<Y, 1>) / sizeof(double);
  alignas(64) double lanes[fields][W];
  for (int k = 0; k < W; ++k) {
    const bool plane = block.planes >> (lane + k) & 1;
    const Geometry<Y, 1> one =
        plane ? plane_geometry<Y>(view, block, lane + k) : grain_geometry<Y, 1>(view, block, lane + k);
    double values[fields];
    __builtin_memcpy(values, &one, sizeof one);
    for (int field = 0; field < fields; ++field) lanes[field][k] = values[field];
  }
  Geometry<Y, W> result;
  static_assert(sizeof result == sizeof lanes);
  __builtin_memcpy(&result, lanes, sizeof result);
  return result;
}

template <Layout Y, int W>
GALET_INLINE Geometry<Y, W> geometry_of(const PassView& view, const PassView& shared, std::size_t index, int lane) {
  const RowBlock& block = view.blocks[index];
  if (__builtin_expect(block.planes != 0, 0)) return mixed_geometry<Y, W>(shared, block, lane);
  return grain_geometry<Y, W>(view, block, lane);
}

/// Power of moving planes on the grains of a block.
template <Layout Y>
GALET_INLINE void add_plane_power(const PassView& view, std::size_t index, LaneSums& sums) {
  const RowBlock& block = view.blocks[index];
  for (int k = 0; k < block_rows; ++k) {
    if (!(block.planes >> k & 1)) continue;
    const double* force = view.out + (index * block_rows + k) * out_size(Y);
    const PlaneRecord& plane = view.planes[block.j[k] - view.first_plane];
    for (int a = 0; a < Y.dim; ++a) sums.plane_power[k] -= force[a] * plane.velocity[a];
  }
}

/// The geometry of the next rows is found while the law of the present ones is applied: neither waits for the other.
template <Layout Y, Kernel K, int W>
void evaluate_blocks(const PassView& given, std::size_t begin, std::size_t end, LaneSums& sums) {
  if (begin == end) return;
  const PassView view = given;  // a copy that nothing else can change: it stays in registers
  Rows<Y, K, W> rows(view, sums);
  constexpr int parts = block_rows / W;
  const std::size_t first = begin * parts, last = end * parts;
  for (std::size_t part = first; part < last; ++part) {
    const int lane = static_cast<int>(part % parts) * W;
    rows.evaluate(geometry_of<Y, W>(view, given, part / parts, lane), part / parts, lane);
  }
  if constexpr (K.account)
    for (std::size_t index = begin; index < end; ++index)
      if (view.blocks[index].planes != 0) add_plane_power<Y>(view, index, sums);
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
