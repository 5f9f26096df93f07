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
// A second, outer list has the pairs of a wider skin. While it holds (the same test, with the inner skin as reserve)
// narrow() takes the list anew from it, which costs a fraction of a search: so the inner skin can be thin, and few
// listed pairs are idle. Which of the two ways was taken changes no listed pair.
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
  /// `range`: largest gap at which a pair interacts (0 for contact laws without range). `skin`: see above. `outer`:
  /// skin of the outer list that the next build() makes; 0: none.
  void configure(double range, double skin, double outer = 0);

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

  /// Lists all pairs anew without wrapping anything, from the outer list; false where there is none that holds (nothing
  /// is changed then). origin() and flipped() as after build(). Arguments, and errors as for build().
  bool narrow(std::span<const Vec<D>> position, std::span<const double> radius, const Cell<D>& cell,
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
  /// Searches, and lists taken from the outer one.
  long builds() const { return builds_; }
  long narrowings() const { return narrowings_; }
  MemoryUse memory() const;

  /// In the archive grains have their `number`, or their indices where there is none.
  void save(Archive& archive, std::span<const int> number = {}) const;
  /// Indices are the archive's numbers. origin(): rows of the archive.
  void restore(const Archive& archive, int grains);

 private:
  /// What was where when a list was made.
  struct Reference {
    std::vector<Vec<D>> position, plane;
    Mat<D> box = Mat<D>::Identity();
    void set(std::span<const Vec<D>> positions, std::span<const Plane<D>> planes, const Mat<D>& box_then);
    void take(const double* from, std::size_t grains, std::size_t planes);
  };
  /// The largest displacements since then; not numbers where a position is not finite.
  struct Moves {
    double apart = 0;  ///< largest |s_i|
    double grain = 0;  ///< largest displacement of a grain, where there are planes
    double plane = 0;
  };
  static Moves moves_since(const Reference& then, std::span<const Vec<D>> position, const Cell<D>& cell,
                           std::span<const Plane<D>> planes);
  double room(const Reference& then, double skin, const Cell<D>& cell) const;
  bool holds(const Reference& then, double skin, const Moves& moved, const Cell<D>& cell, double reserve) const;

  void find_outer(std::span<const double> radius, const Cell<D>& cell, std::span<const Plane<D>> planes,
                  std::span<const int> group, std::span<const int> number);
  template <class Take>
  void take_near(std::span<const Vec<D>> position, std::span<const double> radius, const Cell<D>& cell,
                 std::span<const Plane<D>> planes, std::span<const int> number, Take take);
  void take_all_near(std::span<const Vec<D>> position, std::span<const double> radius, const Cell<D>& cell,
                     std::span<const Plane<D>> planes, std::span<const int> number);
  void match_outer_rows();

  void wrap(std::span<Vec<D>> position, Cell<D>& cell, std::span<const int> number);
  void carry_rows(const Eigen::Matrix<int, D, D>& inverse_remap);
  void keep_rows();
  void put_in_order(std::size_t row);
  void sort_old_rows(int grains);
  void take_old_rows(int grains);
  void index_rows(int grains);
  void match_old_rows();
  void forget_pairs(int grains);

  double range_ = 0;
  double skin_ = 0;
  double largest_radius_ = 0;
  mutable double largest_move_ = 0;
  long builds_ = 0, narrowings_ = 0;

  PairColumns<D> pairs_, old_pairs_;
  std::vector<int> first_, second_, rows_of_second_, origin_;
  std::vector<std::uint8_t> flipped_, old_flipped_;
  std::vector<int> old_order_;

  Reference reference_;

  double wanted_outer_skin_ = 0, outer_skin_ = 0;  ///< to come; of the present outer list, 0: there is none
  Reference outer_reference_;
  bool outer_known_ = false;  ///< whether outer_ is filled in; it follows from the reference
  PairColumns<D> outer_;
  std::vector<int> row_of_outer_;  ///< of each outer pair in the list, or -1

  NeighbourSearch<D> search_;
  std::vector<Image<D>> wraps_;
  std::vector<int> cursor_;
};

extern template class VerletList<2>;
extern template class VerletList<3>;

}  // namespace galet
