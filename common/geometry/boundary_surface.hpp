// The part of a boundary that a picture or a file for another program can show: planes are endless.
//
//   plane      its part inside the box `shown`: a stretch (2D), a polygon (3D). A plane that misses the box is cut to
//              the shadow that the box throws on it.
//   cylinder   whole about its axis: a circle (2D), a tube as long as the box is along the axis (3D), of 96 sides whose
//              corners lie on it (the sides lie 1 - cos(pi / 96) = 0.05 % of R_c inside).
#pragma once

#include <span>
#include <vector>

#include "common/geometry/cell.hpp"
#include "common/geometry/plane.hpp"

namespace galet {

/// A box along the axes.
template <int D>
struct Extent {
  Vec<D> low = Vec<D>::Zero(), high = Vec<D>::Zero();

  void include(const Vec<D>& x, double margin = 0) {
    low = low.cwiseMin(x - Vec<D>::Constant(margin));
    high = high.cwiseMax(x + Vec<D>::Constant(margin));
  }
  bool contains(const Vec<D>& x, double slack = 0) const {
    return ((x - low).array() >= -slack).all() && ((high - x).array() >= -slack).all();
  }
  /// All 2^D of them.
  std::vector<Vec<D>> corners() const;
};

/// The box around the cell and the grains that stick out of it, where it is not periodic.
template <int D>
Extent<D> sample_extent(const Cell<D>& cell, std::span<const Vec<D>> position, std::span<const double> radius);

/// The faces of the shown part, each the list of its corners: polygons in 3D, in 2D one line through its points (the
/// last of a circle is the first again). Empty when there is nothing to show.
template <int D>
std::vector<std::vector<Vec<D>>> boundary_faces(const Plane<D>& boundary, const Extent<D>& shown);

}  // namespace galet
