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

/// values.assign(count, value) with room to spare when it must grow, so that a size that wanders allocates seldom.
template <class Values>
void refill(Values& values, std::size_t count, const typename Values::value_type& value) {
  if (count > values.capacity()) values.reserve(count + count / 2);
  values.assign(count, value);
}

/// to = from, with room to spare when it must grow.
template <class Values>
void copy_with_room(const Values& from, Values& to) {
  if (from.size() > to.capacity()) to.reserve(from.size() + from.size() / 2);
  to.assign(from.begin(), from.end());
}

static_assert(sizeof(Column<double, false>) == 1, "an absent column is an empty type");

}  // namespace galet
