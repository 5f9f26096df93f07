// A grid in which grains are looked up while they are being placed: "does a grain here touch one that is already
// there?" in a time that does not grow with the number of grains. Cells of the grid are cut in fractional
// coordinates, so that it fits tilted cells; images are met exactly, also when the cell is one grid cell wide.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "common/geometry/wrap.hpp"

namespace galet {

template <int D>
class PlacementGrid {
 public:
  /// For at most about `expected` grains no larger than `largest_diameter`. Along periodic directions the distance
  /// of the cell's faces must be at least the largest diameter (a grain must not meet itself).
  PlacementGrid(const Cell<D>& cell, double largest_diameter, int expected)
      : cell_(cell), inverse_(cell.box.inverse()) {
    // Not many more grid cells than grains, however dilute.
    const double edge = std::max(largest_diameter, std::pow(cell.volume() / (2.0 * std::max(expected, 1)), 1.0 / D));
    const Vec<D> width = face_distances<D>(cell.box);
    std::size_t cells = 1;
    for (int a = 0; a < D; ++a) {
      size_[a] = std::max(1, static_cast<int>(width[a] / edge));
      cells *= static_cast<std::size_t>(size_[a]);
    }
    first_.assign(cells, -1);
  }

  int count() const { return static_cast<int>(position_.size()); }

  /// Index (in the order of add) of a placed grain j whose centre, or an image of it, is nearer to x than
  /// factor * (radius + R_j); -1 when there is none. Grains with skip(j) don't count.
  template <class Skip>
  int touched(const Vec<D>& x, double radius, double factor, const Skip& skip) const {
    const Vec<D> inside = wrapped_position<D>(cell_, inverse_, x);
    const Image<D> home = grid_cell(inside);
    int combinations = 1;
    for (int a = 0; a < D; ++a) combinations *= 3;
    for (int code = 0; code < combinations; ++code) {
      const auto [index, shift] = neighbour(home, code);
      if (index < 0) continue;
      for (int j = first_[index]; j >= 0; j = next_[j]) {
        const double reach = factor * (radius + radius_[j]);
        if ((position_[j] + shift - inside).squaredNorm() < reach * reach && !skip(j)) return j;
      }
    }
    return -1;
  }
  int touched(const Vec<D>& x, double radius, double factor = 1) const {
    return touched(x, radius, factor, [](int) { return false; });
  }

  void add(const Vec<D>& x, double radius) {
    position_.push_back(wrapped_position<D>(cell_, inverse_, x));
    radius_.push_back(radius);
    const Image<D> home = grid_cell(position_.back());
    int index = 0;
    for (int a = 0; a < D; ++a) index = index * size_[a] + home[a];
    next_.push_back(first_[index]);
    first_[index] = count() - 1;
  }

 private:
  struct Neighbour {
    int index;     ///< grid cell, -1 when the offset leaves a cell that is not periodic
    Vec<D> shift;  ///< from the grains of that grid cell to their images beside the home cell
  };

  /// Grains outside a cell that is not periodic belong to the grid cells at its border.
  Image<D> grid_cell(const Vec<D>& inside) const {
    const Vec<D> s = inverse_ * inside;
    Image<D> k;
    for (int a = 0; a < D; ++a) k[a] = static_cast<int>(std::clamp(std::floor(s[a] * size_[a]), 0.0, size_[a] - 1.0));
    return k;
  }

  /// The grid cell at one of the 3^D offsets from `home`; the base-3 digits of `code` are the offsets + 1.
  Neighbour neighbour(const Image<D>& home, int code) const {
    Neighbour result{0, Vec<D>::Zero()};
    for (int a = 0; a < D; ++a, code /= 3) {
      int k = home[a] + code % 3 - 1;
      if (k < 0 || k >= size_[a]) {
        if (!cell_.periodic[a]) return {-1, result.shift};
        const int turn = k < 0 ? -1 : 1;
        k -= turn * size_[a];
        result.shift += turn * cell_.box.col(a);
      }
      result.index = result.index * size_[a] + k;
    }
    return result;
  }

  Cell<D> cell_;
  Mat<D> inverse_;
  Image<D> size_;
  std::vector<int> first_;  ///< of each grid cell: its newest grain, -1 when empty
  std::vector<int> next_;   ///< of each grain: the next one of its grid cell
  std::vector<Vec<D>> position_;
  std::vector<double> radius_;
};

}  // namespace galet
