// An order of grains in which neighbours in space are near each other in memory: along Morton's curve (1966), that is
// by the interleaved bits of the coordinates. What works on pairs then finds most grains in the cache. Cost: one sort.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "common/core/types.hpp"
#include "common/geometry/cell.hpp"

namespace galet {

/// Interleaved bits of 2^(60/D) steps across each unit; coordinates are taken modulo 1.
template <int D>
std::uint64_t morton_code(const Vec<D>& fraction) {
  constexpr int bits = 60 / D;
  std::uint64_t code = 0;
  for (int a = 0; a < D; ++a) {
    const double inside = fraction[a] - std::floor(fraction[a]);
    const double below_one = inside < 1 - 1e-9 ? inside : 1 - 1e-9;  // also where it is not a number
    const auto step = static_cast<std::uint64_t>(below_one * static_cast<double>(1L << bits));
    for (int bit = 0; bit < bits; ++bit) code |= (step >> bit & 1) << (D * bit + a);
  }
  return code;
}

/// A grain and its place on the curve.
using PlaceOnCurve = std::pair<std::uint64_t, int>;

/// Fills `places` with the grains in their order along the curve through to_curve * x; equal codes by index.
template <int D>
void sort_along_curve(const Mat<D>& to_curve, std::span<const Vec<D>> position, std::vector<PlaceOnCurve>& places) {
  places.resize(position.size());
  for (std::size_t i = 0; i < position.size(); ++i)
    places[i] = {morton_code<D>(to_curve * position[i]), static_cast<int>(i)};
  std::sort(places.begin(), places.end());
}

/// order[k]: the grain that comes k-th along the curve through the cell (fractional coordinates).
template <int D>
std::vector<int> spatial_order(const Cell<D>& cell, const std::vector<Vec<D>>& position) {
  std::vector<PlaceOnCurve> places;
  sort_along_curve<D>(cell.box.inverse(), position, places);
  std::vector<int> order;
  for (const PlaceOnCurve& place : places) order.push_back(place.second);
  return order;
}

}  // namespace galet
