// An order of grains in which neighbours in space are near each other in memory: along Morton's curve (1966) through
// the cell, that is by the interleaved bits of the fractional coordinates. What works on pairs then finds most grains
// in the cache. Cost: one sort.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <vector>

#include "common/core/types.hpp"
#include "common/geometry/cell.hpp"

namespace galet {

/// Interleaved bits of 2^(60/D) steps across each cell vector; coordinates are taken modulo 1.
template <int D>
std::uint64_t morton_code(const Vec<D>& fraction) {
  constexpr int bits = 60 / D;
  std::uint64_t code = 0;
  for (int a = 0; a < D; ++a) {
    const double inside = fraction[a] - std::floor(fraction[a]);
    const auto step = static_cast<std::uint64_t>(std::min(inside, 1 - 1e-9) * static_cast<double>(1L << bits));
    for (int bit = 0; bit < bits; ++bit) code |= (step >> bit & 1) << (D * bit + a);
  }
  return code;
}

/// order[k]: the grain that comes k-th.
template <int D>
std::vector<int> spatial_order(const Cell<D>& cell, const std::vector<Vec<D>>& position) {
  const Mat<D> to_fraction = cell.box.inverse();
  std::vector<std::uint64_t> code;
  for (const Vec<D>& x : position) code.push_back(morton_code<D>(to_fraction * x));
  std::vector<int> order(position.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return code[a] < code[b]; });
  return order;
}

}  // namespace galet
