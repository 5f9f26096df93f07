// A column: one quantity of all grains or of all contacts, contiguous in memory (structure of arrays).
// A column that a layout does not need is declared absent: it has no storage and no operations, so that code
// which would touch it does not compile.
#pragma once

#include <cstddef>
#include <vector>

namespace galet {

template <class T, bool Present = true>
class Column : public std::vector<T> {
 public:
  using std::vector<T>::vector;
  static constexpr bool present = true;
};

template <class T>
class Column<T, false> {
 public:
  static constexpr bool present = false;
  void resize(std::size_t) {}
  void resize(std::size_t, const T&) {}
  void assign(std::size_t, const T&) {}
  void reserve(std::size_t) {}
  void clear() {}
  void swap(Column&) {}
};

static_assert(sizeof(Column<double, false>) == 1, "an absent column is an empty type");

}  // namespace galet
