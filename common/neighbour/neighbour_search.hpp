// The search for pairs of grains (with the image of the second one) and of grains and planes whose gap is below a
// limit.
//
// Grains are put into classes by factors of two of their radius, each with bins of its own, as wide as the
// largest of the class interact. A grain looks for grains of its class in the bins around it, and for larger ones in
// the bins of each class above: every pair is found once, from its smaller grain, among few candidates at any size
// ratio. Grains within a factor of two are one class.
//
// Any cell works, also one narrower than a grain's reach (a grain then meets several images, its own included).
//
// Source: Allen and Tildesley 1987, ch. 5; classes: Ogarko and Luding, Comput. Phys. Commun. 183, 931 (2012). Cost:
// O(grains) times the number of classes.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "common/core/memory_use.hpp"
#include "common/core/types.hpp"
#include "common/geometry/cell.hpp"
#include "common/geometry/contact_frame.hpp"
#include "common/geometry/plane.hpp"

namespace galet {

/// Listed pairs, sorted by (i, j, image); i < j, or i == j for a grain and its own image (first non-zero lattice
/// coordinate positive). j >= grains stands for plane j - grains, with image zero.
template <int D>
struct PairColumns {
  std::vector<int> i, j;
  std::vector<Image<D>> image;
  std::size_t size() const { return i.size(); }
};

/// Grains and planes, and whether two of them are near. Throws RunError, naming the grains, when a pair overlaps by
/// more than half of the smaller radius or a grain is behind a plane.
template <int D>
struct PairSight {
  std::span<const Vec<D>> position;
  std::span<const double> radius;
  std::span<const Plane<D>> planes;
  std::span<const int> number;  ///< what messages call the grains; none: their indices

  int name(int grain) const { return number.empty() ? grain : number[grain]; }
  /// Whether the gap of grain i and the image of j at x_j + `lattice` is below `limit`; `shift` = lattice - x_i.
  bool near(int i, int j, const Vec<D>& shift, double limit) const {
    const double touching = radius[i] + radius[j], cutoff = touching + limit;
    const double squared_distance = (position[j] + shift).squaredNorm();
    if (squared_distance >= cutoff * cutoff) return false;
    const double closest = touching - 0.5 * std::min(radius[i], radius[j]);
    if (squared_distance < closest * closest) refuse_overlap(i, j, touching - std::sqrt(squared_distance));
    return true;
  }
  bool near_plane(int i, std::size_t plane, double limit) const {
    const ContactFrame<D> frame = plane_frame<D>(position[i], radius[i], planes[plane]);
    if (frame.distance < 0) refuse_behind(i, plane);
    return frame.gap < limit;
  }

 private:
  [[noreturn]] void refuse_overlap(int i, int j, double overlap) const;
  [[noreturn]] void refuse_behind(int i, std::size_t plane) const;
};

template <int D>
class NeighbourSearch {
 public:
  /// Fills `pairs` with all pairs whose gap is below `limit`. Grains must lie in the cell along periodic directions.
  /// Throws RunError, naming the grains, when a pair overlaps by more than half of the smaller radius or a grain is
  /// behind a plane. Grains of one group (>= 0) are not paired; no groups: all are. `number`: what messages call the
  /// grains; none: their indices.
  void find(std::span<const Vec<D>> position, std::span<const double> radius, const Cell<D>& cell,
            std::span<const Plane<D>> planes, std::span<const int> group, std::span<const int> number, double limit,
            PairColumns<D>& pairs);

  MemoryUse memory() const;

 private:
  struct Neighbour {
    int j;
    Image<D> image;
    bool operator<(const Neighbour& other) const { return j != other.j ? j < other.j : image < other.image; }
  };

  /// Grains of like size in bins, in fractional coordinates of the cell.
  struct SizeClass {
    double largest_radius = 0;
    int count = 0;
    std::array<int, D> bins{}, reach{};  ///< how many along each vector, and how many away a neighbour may be
    std::vector<int> start, grains;      ///< grains of bin b: grains[start[b] .. start[b + 1])
  };
  /// A pair found from its second grain.
  struct Found {
    int i;
    Neighbour neighbour;
  };
  /// What one chunk of grains has found: pairs of its own grains, in their order, and pairs of others.
  struct Findings {
    std::vector<Neighbour> own;
    std::vector<Found> others;
  };
  /// What a search looks at.
  struct Sight : PairSight<D> {
    const Cell<D>& cell;
    std::span<const int> group;
    Mat<D> to_fraction;
    double limit;
  };

  void classify(std::span<const double> radius);
  void measure_extent(const Sight& sight);
  void divide(SizeClass& size, const Sight& sight) const;
  void fill_bins(const Sight& sight);
  std::array<int, D> place_of(const SizeClass& size, const Vec<D>& fraction) const;
  void search(const Sight& sight);
  void search_grain(int i, const Sight& sight, Findings& findings) const;
  void search_class(int i, int size, const Sight& sight, Findings& findings) const;
  template <bool SameClass>
  void search_bin(int i, const SizeClass& size, int bin, const Image<D>& image, const Sight& sight,
                  Findings& findings) const;
  void list_found(int grains, PairColumns<D>& pairs) const;
  void list_from_both_sides(int grains, PairColumns<D>& pairs);

  std::vector<SizeClass> classes_;  ///< from the largest grains to the smallest; none is empty
  std::vector<std::uint8_t> class_of_;
  Vec<D> origin_of_bins_ = Vec<D>::Zero(), extent_of_bins_ = Vec<D>::Ones();
  std::vector<int> bin_of_;  ///< of each grain, in its own class
  std::vector<Findings> chunk_found_;
  std::vector<Neighbour> merged_;
  std::vector<int> found_count_, first_, cursor_;
  std::vector<std::string> failures_;  ///< of the chunks of a search; empty: none
};

extern template struct PairSight<2>;
extern template struct PairSight<3>;
extern template class NeighbourSearch<2>;
extern template class NeighbourSearch<3>;

}  // namespace galet
