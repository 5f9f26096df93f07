#include "common/graph/colouring.hpp"

#include <algorithm>
#include <bit>
#include <numeric>

namespace galet {

void Colouring::colour(std::span<const int> i, std::span<const int> j, int movable, std::size_t room) {
  const std::size_t contacts = i.size();
  colour_of_.reserve(room);
  order.reserve(room);
  start.reserve(most_colours + 2);
  used_.assign(movable, 0);
  colour_of_.resize(contacts);
  int groups = 0;
  for (std::size_t k = 0; k < contacts; ++k) {
    std::uint64_t taken = 0;
    if (i[k] < movable) taken |= used_[i[k]];
    if (j[k] < movable) taken |= used_[j[k]];
    const int colour = std::countr_one(taken);  // == most_colours when every colour is taken
    if (colour < most_colours) {
      const std::uint64_t bit = std::uint64_t{1} << colour;
      if (i[k] < movable) used_[i[k]] |= bit;
      if (j[k] < movable) used_[j[k]] |= bit;
    }
    colour_of_[k] = colour;
    groups = std::max(groups, colour + 1);
  }
  overflow = groups == most_colours + 1;
  start.assign(groups + 1, 0);
  for (std::size_t k = 0; k < contacts; ++k) ++start[colour_of_[k] + 1];
  std::partial_sum(start.begin(), start.end(), start.begin());
  order.resize(contacts);
  for (std::size_t k = 0; k < contacts; ++k) order[start[colour_of_[k]]++] = static_cast<int>(k);
  // `start` now holds each group's end: shift it back.
  std::rotate(start.begin(), start.end() - 1, start.end());
  start[0] = 0;
}

}  // namespace galet
