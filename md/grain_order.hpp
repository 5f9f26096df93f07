// The order in which md keeps its grains in memory: along Morton's curve through the cell, so that the grains of a pair
// lie near each other and most of them are found in a cache. Grains have the user's numbers outside (scenes, snapshots,
// checkpoints, messages); the order is a permutation of these.
//
// Spread of a list: mean over its pairs of grains of the number of bits of |k_j - k_i|, k the places in memory. It
// grows by 1 when the pairs lie twice as far apart. Grains are sorted anew, before the list is made, when the spread
// has grown by `decay` over the least one since they were sorted. It is counted, never timed, so that runs are
// repeatable, and order and spread are part of the state: sums are taken in the order of the memory.
//
// Cost: one pass over the pairs per list. Fewer grains than `least_sorted_grains` lie in the caches in any order and
// keep theirs.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <numeric>
#include <span>
#include <string>
#include <vector>

#include "common/core/archive_columns.hpp"
#include "common/core/column.hpp"
#include "common/core/permutation.hpp"
#include "common/neighbour/neighbour_search.hpp"
#include "common/scene/spatial_order.hpp"

namespace galet::md {

inline constexpr int least_sorted_grains = 1000;

template <int D>
class GrainOrder {
 public:
  static constexpr double decay = 0.5;  ///< bits

  /// The order of the user's numbers.
  void start(int grains) {
    number_.resize(static_cast<std::size_t>(grains));
    std::iota(number_.begin(), number_.end(), 0);
    same_ = true;
    least_ = present_ = unknown;
  }

  /// Whether places and numbers are the same.
  bool same() const { return same_; }
  /// number()[k]: the user's number of the grain that lies k-th in memory.
  std::span<const int> number() const { return number_; }

  /// Whether the grains should be sorted before the next list is made.
  bool decayed() const {
    if (number_.size() < static_cast<std::size_t>(least_sorted_grains)) return false;
    return least_ < 0 || present_ > least_ + decay;
  }

  /// The new order: how the grains of today must be moved. The caller moves them and says so to moved().
  const Permutation& sorted(const Cell<D>& cell, std::span<const Vec<D>> position) {
    // Steps of the curve are as long in all directions.
    const Vec<D> width = cell.box.colwise().norm().transpose();
    const Mat<D> to_curve = (width / width.maxCoeff()).asDiagonal() * cell.box.inverse();
    sort_along_curve<D>(to_curve, position, places_);
    order_.resize(places_.size());
    for (std::size_t k = 0; k < places_.size(); ++k) order_[k] = places_[k].second;
    least_ = unknown;
    step_.set(order_);
    return step_;
  }

  void moved(const Permutation& step) {
    if (step.identity()) return;
    step.apply(number_);
    same_ = std::is_sorted(number_.begin(), number_.end());
  }

  /// The way back to the order of the user's numbers.
  Permutation back() const {
    std::vector<int> place(number_.size());
    for (std::size_t k = 0; k < number_.size(); ++k) place[number_[k]] = static_cast<int>(k);
    Permutation to_numbers;
    to_numbers.set(place);
    return to_numbers;
  }

  /// Looks at a list that has been made.
  void look_at(const PairColumns<D>& pairs) {
    std::int64_t bits = 0, count = 0;
    const int grains = static_cast<int>(number_.size());
    for (std::size_t row = 0; row < pairs.size(); ++row) {
      if (pairs.j[row] >= grains) continue;
      bits += std::bit_width(static_cast<unsigned>(pairs.j[row] - pairs.i[row]));
      ++count;
    }
    present_ = static_cast<double>(bits) / static_cast<double>(std::max<std::int64_t>(1, count));
    least_ = least_ < 0 ? present_ : std::min(least_, present_);
  }

  /// Puts the columns whose names begin so, entries of grains in the order of the memory, into that of the numbers.
  void to_numbers(Archive& archive, const std::string& start) const {
    if (same_) return;
    for (auto& [name, column] : archive.reals) {
      if (!name.starts_with(start)) continue;
      const std::vector<double> inside = column;
      const std::size_t width = column.size() / number_.size();
      for (std::size_t k = 0; k < number_.size(); ++k)
        std::copy_n(inside.data() + k * width, width, column.data() + static_cast<std::size_t>(number_[k]) * width);
    }
  }

  void save(Archive& archive) const {
    archive.integers["md.order"].assign(number_.begin(), number_.end());
    archive.reals["md.order_spread"] = {present_, least_};
  }

  /// From the order of the user's numbers to that of the archive. The caller moves the grains and says so to moved().
  const Permutation& restore(const Archive& archive) {
    const std::vector<std::int64_t>& stored = integer_column(archive, "md.order");
    if (stored.size() != number_.size()) throw InputError("column 'md.order' of the checkpoint has the wrong length");
    std::vector<bool> seen(stored.size(), false);
    order_.resize(stored.size());
    for (std::size_t k = 0; k < stored.size(); ++k) {
      const auto number = static_cast<std::size_t>(stored[k]);
      if (number >= stored.size() || seen[number])
        throw InputError("column 'md.order' of the checkpoint does not name each grain once");
      seen[number] = true;
      order_[k] = static_cast<int>(stored[k]);
    }
    std::vector<double> spread(2);
    take_column(archive, "md.order_spread", spread);
    present_ = spread[0], least_ = spread[1];
    step_.set(order_);
    return step_;
  }

  std::size_t bytes() const { return bytes_of(number_, order_, places_) + step_.bytes(); }

 private:
  static constexpr double unknown = -1;  ///< no list has been made since the grains were sorted

  std::vector<int> number_, order_;
  std::vector<PlaceOnCurve> places_;
  Permutation step_;
  bool same_ = true;
  double present_ = unknown, least_ = unknown;
};

}  // namespace galet::md
