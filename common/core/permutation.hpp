// A permutation of grains, and its application to what is stored per grain, in place: along its cycles, so that nothing
// is allocated. Cost: one pass over what moves.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "common/core/error.hpp"
#include "common/core/memory_use.hpp"

namespace galet {

class Permutation {
 public:
  /// order[k]: where the entry that comes k-th was before. Each index stands in it once.
  void set(std::span<const int> order) {
    from_.assign(order.begin(), order.end());
    to_.assign(order.size(), -1);
    for (std::size_t k = 0; k < order.size(); ++k) {
      const auto old = static_cast<std::size_t>(order[k]);
      require(order[k] >= 0 && old < order.size() && to_[old] < 0, "a permutation holds each index once");
      to_[old] = static_cast<int>(k);
    }
    find_cycles();
  }

  std::size_t size() const { return from_.size(); }
  bool identity() const { return cycles_.empty(); }
  /// Where entry k was before.
  int from(int k) const { return from_[k]; }
  /// Where an entry has gone.
  int to(int old) const { return to_[old]; }

  /// Puts `values` into the new order.
  template <class Values>
  void apply(Values& values) const {
    require(values.size() == size(), "a permutation has one index per entry");
    for (const int start : cycles_) {
      const auto first = values[start];
      int k = start;
      for (; from_[k] != start; k = from_[k]) values[k] = values[from_[k]];
      values[k] = first;
    }
  }

  /// The same for groups of `width` numbers (16 at most) that lie one behind the other.
  void apply(double* groups, std::size_t width) const {
    std::array<double, 16> first;
    require(width <= first.size(), "a group has 16 numbers at most");
    const auto group = [&](int k) { return groups + static_cast<std::size_t>(k) * width; };
    for (const int start : cycles_) {
      std::copy_n(group(start), width, first.data());
      int k = start;
      for (; from_[k] != start; k = from_[k]) std::copy_n(group(from_[k]), width, group(k));
      std::copy_n(first.data(), width, group(k));
    }
  }

  std::size_t bytes() const { return bytes_of(from_, to_, cycles_); }

 private:
  /// One entry of each cycle that moves anything: the first.
  void find_cycles() {
    cycles_.clear();
    cycles_.reserve(size() / 2);
    seen_.assign(size(), false);
    for (std::size_t start = 0; start < size(); ++start) {
      if (seen_[start] || from_[start] == static_cast<int>(start)) continue;
      cycles_.push_back(static_cast<int>(start));
      for (std::size_t k = start; !seen_[k]; k = static_cast<std::size_t>(from_[k])) seen_[k] = true;
    }
  }

  std::vector<int> from_, to_, cycles_;
  std::vector<bool> seen_;
};

}  // namespace galet
