// Verlet list of the pairs that may come into contact: grain-grain (with the image of the second grain) and
// grain-plane.
//
// A pair is listed when its gap is below `range + skin` at the time of building. The list is valid as long as no
// pair that is not listed can have come within `range`. With F the deformation of the cell since then and
// s_i = x_i - F x_i(then) the non-affine displacements, a branch vector is F b(then) + s_j - s_i, so that the list
// holds while
//     skin + (min(1, least singular value of F) - 1) (2 R_max + range + skin) >= 2 max |s_i| + reserve.
// This test is exact (it never misses a pair) and is made at every step; `reserve` lets a caller ask whether the
// list will still hold after a step that moves grains by at most reserve / 2.
//
// Building wraps the grains into the cell and brings a tilted cell back to its least tilt. Images of the pairs
// that stay are rewritten accordingly, so that contact histories are carried by (i, j, image) and never lost.
// Any cell works, also one narrower than a grain's interaction range (a grain then meets several images, its own
// included).
//
// The search for pairs: neighbour_search.hpp.
//
// Source: Allen and Tildesley 1987, ch. 5. Cost: O(grains) to build; one pass over the grains to test.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/core/archive.hpp"
#include "common/core/memory_use.hpp"
#include "common/core/permutation.hpp"
#include "common/core/types.hpp"
#include "common/geometry/cell.hpp"
#include "common/geometry/plane.hpp"
#include "common/neighbour/neighbour_search.hpp"

namespace galet {

template <int D>
class VerletList {
 public:
  /// `range`: largest gap at which a pair interacts (0 for contact laws without range). `skin`: see above.
  void configure(double range, double skin);

  /// Whether a pair that is not listed may be within range (after a further displacement of `reserve` in all).
  bool expired(std::span<const Vec<D>> position, const Cell<D>& cell, std::span<const Plane<D>> planes,
               double reserve = 0) const;

  /// Largest non-affine displacement |s_i| for which the list certainly holds in the cell (planes apart).
  double allowance(const Cell<D>& cell) const;
  /// The largest |s_i| that the last call of expired() has found; not a number where a position is not finite.
  double largest_move() const { return largest_move_; }

  /// Wraps positions and box, and lists all pairs anew. Throws RunError, naming the grains, when a position is not
  /// finite or absurdly far, a pair overlaps by more than half of the smaller radius, or a grain is behind a plane; the
  /// list is then empty. Grains of one group (>= 0) are not paired; no groups: all are. `number`: what messages call
  /// the grains; none: their indices.
  void build(std::span<Vec<D>> position, std::span<const double> radius, Cell<D>& cell,
             std::span<const Plane<D>> planes, std::span<const int> group = {}, std::span<const int> number = {});

  /// Gives the grains other indices: sorts the pairs anew by these, with origin() and flipped() as after build().
  void renumber(const Permutation& step);

  const PairColumns<D>& pairs() const { return pairs_; }
  std::size_t size() const { return pairs_.size(); }

  /// Rows of grain i as first member of its pairs: [first()[i], first()[i + 1]).
  std::span<const int> first() const { return first_; }
  /// Rows of grain j as second member: rows_of_second()[second()[j] .. second()[j + 1]), ascending.
  std::span<const int> second() const { return second_; }
  std::span<const int> rows_of_second() const { return rows_of_second_; }

  /// For each listed pair, its row in the list before the last build or change of indices, or -1.
  std::span<const int> origin() const { return origin_; }
  /// Whether i and j of a pair changed places in it (vector histories change sign).
  bool flipped(std::size_t row) const { return !flipped_.empty() && flipped_[row] != 0; }

  double skin() const { return skin_; }
  long builds() const { return builds_; }
  MemoryUse memory() const;

  /// In the archive grains have their `number`, or their indices where there is none.
  void save(Archive& archive, std::span<const int> number = {}) const;
  /// Indices are the archive's numbers. origin(): rows of the archive.
  void restore(const Archive& archive, int grains);

 private:
  void wrap(std::span<Vec<D>> position, Cell<D>& cell, std::span<const int> number);
  void carry_rows(const Eigen::Matrix<int, D, D>& inverse_remap);
  void keep_rows();
  void put_in_order(std::size_t row);
  void sort_old_rows(int grains);
  void take_old_rows(int grains);
  void index_rows(int grains);
  void forget_pairs(int grains);

  double range_ = 0;
  double skin_ = 0;
  double largest_radius_ = 0;
  mutable double largest_move_ = 0;
  long builds_ = 0;

  PairColumns<D> pairs_, old_pairs_;
  std::vector<int> first_, second_, rows_of_second_, origin_;
  std::vector<std::uint8_t> flipped_, old_flipped_;
  std::vector<int> old_order_;

  std::vector<Vec<D>> reference_;  ///< positions at the last build
  std::vector<Vec<D>> plane_reference_;
  Mat<D> box_reference_ = Mat<D>::Identity();

  NeighbourSearch<D> search_;
  std::vector<Image<D>> wraps_;
  std::vector<int> cursor_;
};

extern template class VerletList<2>;
extern template class VerletList<3>;

}  // namespace galet
