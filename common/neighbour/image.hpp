// Arithmetic of lattice coordinates, and which one of a pair of opposite images stands for both.
#pragma once

#include "common/core/types.hpp"

namespace galet {

/// In sizes of the cell: images are counted in int.
inline constexpr double farthest_image = 1e9;

template <int D>
Image<D> add(const Image<D>& a, const Image<D>& b) {
  Image<D> sum;
  for (int k = 0; k < D; ++k) sum[k] = a[k] + b[k];
  return sum;
}

template <int D>
Image<D> negative(const Image<D>& a) {
  Image<D> opposite;
  for (int k = 0; k < D; ++k) opposite[k] = -a[k];
  return opposite;
}

template <int D>
bool first_nonzero_positive(const Image<D>& image) {
  for (int k = 0; k < D; ++k)
    if (image[k] != 0) return image[k] > 0;
  return false;
}

}  // namespace galet
