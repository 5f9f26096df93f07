// From the records of two grains to what a law needs of them: first stage of the contact pass.
#pragma once

#include "md/kernel/lanes.hpp"
#include "md/kernel/view.hpp"

namespace galet::md {

template <Layout Y, class V>
struct LaneTypes;
template <Layout Y, class V>
requires(Y.dim == 2) struct LaneTypes<Y, V> {
  using Vector = Plane2<V>;
  using Spin = V;
};
template <Layout Y, class V>
requires(Y.dim == 3) struct LaneTypes<Y, V> {
  using Vector = Space<V>;
  using Spin = Space<V>;
};

/// W contacts. Spins that the layout has no use for are zero.
template <Layout Y, int W>
struct Geometry {
  using V = Lanes<W>;
  typename LaneTypes<Y, V>::Vector normal;   ///< n, from i to j
  typename LaneTypes<Y, V>::Vector centres;  ///< relative velocity of the centres
  V distance;                                ///< |b|
  typename LaneTypes<Y, V>::Spin surface;    ///< R_i w_i + R_j w_j
  typename LaneTypes<Y, V>::Spin together;   ///< w_i + w_j (3D)
  typename LaneTypes<Y, V>::Spin relative;   ///< w_j - w_i (rolling)
};

/// Group `G` (four doubles) of the records of W pairs: component k is j + i, or j - i where bit k of Minus is set.
template <unsigned Minus, int W>
struct Group {
  Lanes<W> component[4];
};

template <unsigned Minus>
GALET_INLINE Group<Minus, 1> combine(const double* records, int size, int group, const int* i, const int* j, Lanes<1>) {
  const double *from_i = records + static_cast<std::size_t>(*i) * size + 4 * group,
               *from_j = records + static_cast<std::size_t>(*j) * size + 4 * group;
  Group<Minus, 1> result;
  for (int k = 0; k < 4; ++k) result.component[k] = (Minus >> k & 1) ? from_j[k] - from_i[k] : from_j[k] + from_i[k];
  return result;
}
template <unsigned Minus>
GALET_INLINE Group<Minus, 1> combine_shifted(const PassView& view, int size, const RowBlock& block, int lane,
                                             Lanes<1> width) {
  Group<Minus, 1> result = combine<Minus>(view.records, size, 0, block.i + lane, block.j + lane, width);
  for (int k = 0; k < 4; ++k)
    result.component[k] = result.component[k] + Lanes<1>(view.shifts[4 * block.shift[lane] + k]);
  return result;
}

#ifdef __AVX2__

template <unsigned Minus>
GALET_INLINE __m256d signed_sum(const double* from_i, const double* from_j) {
  const __m256d flip = _mm256_castsi256_pd(_mm256_set_epi64x((Minus & 8) ? INT64_MIN : 0, (Minus & 4) ? INT64_MIN : 0,
                                                             (Minus & 2) ? INT64_MIN : 0, (Minus & 1) ? INT64_MIN : 0));
  const __m256d i = _mm256_load_pd(from_i), j = _mm256_load_pd(from_j);
  return Minus == 0    ? _mm256_add_pd(j, i)
         : Minus == 15 ? _mm256_sub_pd(j, i)
                       : _mm256_add_pd(j, _mm256_xor_pd(i, flip));
}
template <unsigned Minus>
GALET_INLINE Group<Minus, 4> combine(const double* records, int size, int group, const int* i, const int* j, Lanes<4>) {
  Group<Minus, 4> result;
  for (int k = 0; k < 4; ++k)
    result.component[k].v = signed_sum<Minus>(records + static_cast<std::size_t>(i[k]) * size + 4 * group,
                                              records + static_cast<std::size_t>(j[k]) * size + 4 * group);
  transpose(result.component[0], result.component[1], result.component[2], result.component[3]);
  return result;
}
template <unsigned Minus>
GALET_INLINE Group<Minus, 4> combine_shifted(const PassView& view, int size, const RowBlock& block, int lane,
                                             Lanes<4>) {
  Group<Minus, 4> result;
  for (int k = 0; k < 4; ++k)
    result.component[k].v =
        _mm256_add_pd(signed_sum<Minus>(view.records + static_cast<std::size_t>(block.i[lane + k]) * size,
                                        view.records + static_cast<std::size_t>(block.j[lane + k]) * size),
                      _mm256_load_pd(view.shifts + 4 * block.shift[lane + k]));
  transpose(result.component[0], result.component[1], result.component[2], result.component[3]);
  return result;
}

#endif

template <class V>
GALET_INLINE Plane2<V> affine(const double* gradient, const Plane2<V>& x) {
  return {V(gradient[0]) * x.x + V(gradient[1]) * x.y, V(gradient[2]) * x.x + V(gradient[3]) * x.y};
}
template <class V>
GALET_INLINE Space<V> affine(const double* gradient, const Space<V>& x) {
  return {V(gradient[0]) * x.x + V(gradient[1]) * x.y + V(gradient[2]) * x.z,
          V(gradient[3]) * x.x + V(gradient[4]) * x.y + V(gradient[5]) * x.z,
          V(gradient[6]) * x.x + V(gradient[7]) * x.y + V(gradient[8]) * x.z};
}

/// Pairs of grains, `lane` the first row of the block.
template <Layout Y, int W>
GALET_INLINE Geometry<Y, W> grain_geometry(const PassView& view, const RowBlock& block, int lane) {
  using V = Lanes<W>;
  constexpr int size = record_size(Y);
  const V width{};
  const int *i = block.i + lane, *j = block.j + lane;
  Geometry<Y, W> result{};
  typename LaneTypes<Y, V>::Vector branch;
  if constexpr (Y.dim == 2) {
    const auto motion = combine_shifted<0b1111>(view, size, block, lane, width);
    branch = {motion.component[0], motion.component[1]};
    result.centres = {motion.component[2], motion.component[3]};
    if constexpr (Y.friction) {
      const auto spins = combine<0b0010>(view.records, size, 1, i, j, width);
      result.surface = spins.component[0], result.relative = spins.component[1];
    }
  } else {
    const auto place = combine_shifted<0b0111>(view, size, block, lane, width);
    const auto motion = combine<0b0111>(view.records, size, 1, i, j, width);
    branch = {place.component[0], place.component[1], place.component[2]};
    result.centres = {motion.component[0], motion.component[1], motion.component[2]};
    if constexpr (Y.friction) {
      const auto spins = combine<0>(view.records, size, 2, i, j, width);
      result.surface = {spins.component[0], spins.component[1], spins.component[2]};
      result.together = {place.component[3], motion.component[3], spins.component[3]};
    }
    if constexpr (Y.rolling) {
      const auto spins = combine<0b0111>(view.records, size, 3, i, j, width);
      result.relative = {spins.component[0], spins.component[1], spins.component[2]};
    }
  }
  result.distance = sqrt(squared(branch));
  result.normal = V(1.0) / result.distance * branch;
  if (view.deforming) result.centres = result.centres + affine(view.gradient, branch);
  return result;
}

/// A grain and a plane. The branch ends on the plane; the plane has no lever arm.
template <Layout Y>
GALET_INLINE Geometry<Y, 1> plane_geometry(const PassView& view, const RowBlock& block, int lane) {
  using V = Lanes<1>;
  const double* grain = view.records + static_cast<std::size_t>(block.i[lane]) * record_size(Y);
  const PlaneRecord& plane = view.planes[block.j[lane] - view.first_plane];
  Geometry<Y, 1> result{};
  if constexpr (Y.dim == 2) {
    const Plane2<V> place{grain[0], grain[1]}, point{plane.point[0], plane.point[1]},
        normal{plane.normal[0], plane.normal[1]};
    result.distance = dot(place - point, normal);
    result.normal = V(-1.0) * normal;
    result.centres =
        Plane2<V>{plane.velocity[0] - grain[2], plane.velocity[1] - grain[3]} - affine(view.gradient, place);
    if constexpr (Y.friction) result.surface = grain[4], result.relative = -grain[5];
  } else {
    const Space<V> place{grain[0], grain[1], grain[2]}, point{plane.point[0], plane.point[1], plane.point[2]},
        normal{plane.normal[0], plane.normal[1], plane.normal[2]};
    result.distance = dot(place - point, normal);
    result.normal = V(-1.0) * normal;
    result.centres =
        Space<V>{plane.velocity[0] - grain[4], plane.velocity[1] - grain[5], plane.velocity[2] - grain[6]} -
        affine(view.gradient, place);
    if constexpr (Y.friction) {
      result.surface = {grain[8], grain[9], grain[10]};
      result.together = {grain[3], grain[7], grain[11]};
    }
    if constexpr (Y.rolling) result.relative = {-grain[12], -grain[13], -grain[14]};
  }
  return result;
}

}  // namespace galet::md
