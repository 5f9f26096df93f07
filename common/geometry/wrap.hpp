// Fractional coordinates, and the return of a position into the periodic cell.
#pragma once

#include <cmath>

#include "common/geometry/cell.hpp"

namespace galet {

/// s with x = box s; in periodic directions brought into [0, 1). `inverse` is the inverse of the cell's box.
template <int D>
Vec<D> wrapped_fraction(const Cell<D>& cell, const Mat<D>& inverse, const Vec<D>& x) {
  Vec<D> s = inverse * x;
  for (int a = 0; a < D; ++a) {
    if (!cell.periodic[a]) continue;
    s[a] -= std::floor(s[a]);
    if (s[a] >= 1) s[a] = 0;  // -1e-20 - floor(-1e-20) rounds to 1
  }
  return s;
}

/// The image of x inside the cell, by whole cell vectors: a position that is inside keeps its bits.
template <int D>
Vec<D> wrapped_position(const Cell<D>& cell, const Mat<D>& inverse, const Vec<D>& x) {
  const Vec<D> s = inverse * x;
  Vec<D> inside = x;
  for (int a = 0; a < D; ++a)
    if (cell.periodic[a] && std::floor(s[a]) != 0) inside -= std::floor(s[a]) * cell.box.col(a);
  return inside;
}

/// The image of x that is nearest to `place`; x itself where nothing is periodic.
template <int D>
Vec<D> image_near(const Cell<D>& cell, const Mat<D>& inverse, const Vec<D>& x, const Vec<D>& place) {
  if (!cell.any_periodic()) return x;
  const Vec<D> away = inverse * (place - x);
  Vec<D> image = x;
  for (int a = 0; a < D; ++a)
    if (cell.periodic[a]) image += std::round(away[a]) * cell.box.col(a);
  return image;
}

}  // namespace galet
