// Memory that the arrays of an engine hold, by what their length follows: grains or listed pairs. Capacities are
// counted, not sizes, so that room kept for growth and second buffers are in it; arrays of constant size are not.
#pragma once

#include <cstddef>
#include <vector>

#include "common/core/column.hpp"

namespace galet {

struct MemoryUse {
  std::size_t grains = 0;  ///< bytes of arrays with an entry per grain
  std::size_t pairs = 0;   ///< bytes of arrays with an entry per listed pair
  std::size_t listed = 0;  ///< pairs in the neighbour list now

  MemoryUse& operator+=(const MemoryUse& other) {
    grains += other.grains, pairs += other.pairs, listed += other.listed;
    return *this;
  }
};

/// Bytes that the arrays hold.
template <class T>
std::size_t bytes_of(const std::vector<T>& values) {
  return values.capacity() * sizeof(T);
}
template <class T>
std::size_t bytes_of(const Column<T, false>&) {
  return 0;
}
template <class First, class Second, class... Rest>
std::size_t bytes_of(const First& first, const Second& second, const Rest&... rest) {
  return bytes_of(first) + bytes_of(second, rest...);
}

}  // namespace galet
