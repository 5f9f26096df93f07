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

/// Where the two grains of W contacts are, and what comes in the same group of their records.
template <Layout Y, int W>
struct Place {
  using V = Lanes<W>;
  typename LaneTypes<Y, V>::Vector normal;  ///< n, from i to j
  V distance;                               ///< |b|
  V inverse_distance;
  Plane2<V> centres;  ///< 2D: relative velocity of the centres
  V together_x;       ///< 3D: first component of w_i + w_j
};

/// How W contacts move. Spins that the layout has no use for are zero.
template <Layout Y, int W>
struct Motion {
  using V = Lanes<W>;
  typename LaneTypes<Y, V>::Vector centres;  ///< relative velocity of the centres
  typename LaneTypes<Y, V>::Spin surface;    ///< R_i w_i + R_j w_j
  typename LaneTypes<Y, V>::Spin together;   ///< w_i + w_j (3D)
  typename LaneTypes<Y, V>::Spin relative;   ///< w_j - w_i (rolling)
};

/// Group `G` (four doubles) of the records of W pairs: component k is j + i, or j - i where bit k of Minus is set.
template <unsigned Minus, int W>
struct Group {
  Lanes<W> component[4];
};

GALET_INLINE const double* at_bytes(const double* base, std::uint32_t bytes) {
  return reinterpret_cast<const double*>(reinterpret_cast<const char*>(base) + bytes);
}

template <unsigned Minus>
GALET_INLINE Group<Minus, 1> combine(const double* records, int group, const std::uint32_t* i, const std::uint32_t* j,
                                     Lanes<1>) {
  const double *from_i = at_bytes(records, *i) + 4 * group, *from_j = at_bytes(records, *j) + 4 * group;
  Group<Minus, 1> result;
  for (int k = 0; k < 4; ++k) result.component[k] = (Minus >> k & 1) ? from_j[k] - from_i[k] : from_j[k] + from_i[k];
  return result;
}
template <unsigned Minus>
GALET_INLINE Group<Minus, 1> combine_shifted(const PassView& view, const RowBlock& block, int lane, Lanes<1> width) {
  Group<Minus, 1> result = combine<Minus>(view.records, 0, block.i + lane, block.j + lane, width);
  if (block.imaged)
    for (int k = 0; k < 4; ++k)
      result.component[k] = result.component[k] + Lanes<1>(at_bytes(view.shifts, block.shift[lane])[k]);
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
GALET_INLINE Group<Minus, 4> combine(const double* records, int group, const std::uint32_t* i, const std::uint32_t* j,
                                     Lanes<4>) {
  Group<Minus, 4> result;
  for (int k = 0; k < 4; ++k)
    result.component[k].v = signed_sum<Minus>(at_bytes(records, i[k]) + 4 * group, at_bytes(records, j[k]) + 4 * group);
  transpose(result.component[0], result.component[1], result.component[2], result.component[3]);
  return result;
}
template <unsigned Minus>
GALET_INLINE Group<Minus, 4> combine_shifted(const PassView& view, const RowBlock& block, int lane, Lanes<4>) {
  Group<Minus, 4> result;
  for (int k = 0; k < 4; ++k)
    result.component[k].v =
        signed_sum<Minus>(at_bytes(view.records, block.i[lane + k]), at_bytes(view.records, block.j[lane + k]));
  if (block.imaged)
    for (int k = 0; k < 4; ++k)
      result.component[k].v =
          _mm256_add_pd(result.component[k].v, _mm256_load_pd(at_bytes(view.shifts, block.shift[lane + k])));
  transpose(result.component[0], result.component[1], result.component[2], result.component[3]);
  return result;
}

#endif

#ifdef __AVX512F__

/// Which of eight rows lies in the first (0) or second (1) half of register k of four (columns_of_eight): rows 0 and 2,
/// 1 and 3, 4 and 6, 5 and 7. (A function: a table would be an object that other files define too.)
GALET_INLINE int row_in_half(int k, int half) { return 4 * (k / 2) + k % 2 + 2 * half; }

template <unsigned Minus>
GALET_INLINE __m512d signed_sum(__m512d i, __m512d j) {
  const __m512d flip = _mm512_broadcast_f64x4(_mm256_setr_pd((Minus & 1) ? -0.0 : 0.0, (Minus & 2) ? -0.0 : 0.0,
                                                             (Minus & 4) ? -0.0 : 0.0, (Minus & 8) ? -0.0 : 0.0));
  return Minus == 0    ? _mm512_add_pd(j, i)
         : Minus == 15 ? _mm512_sub_pd(j, i)
                       : _mm512_add_pd(j, _mm512_xor_pd(i, flip));
}
GALET_INLINE __m512d two_fours(const double* first, const double* second) {
  return _mm512_insertf64x4(_mm512_castpd256_pd512(_mm256_load_pd(first)), _mm256_load_pd(second), 1);
}
template <unsigned Minus>
GALET_INLINE Group<Minus, 8> combine(const double* records, int group, const std::uint32_t* i, const std::uint32_t* j,
                                     Lanes<8>) {
  Group<Minus, 8> result;
  for (int k = 0; k < 4; ++k) {
    const int a = row_in_half(k, 0), b = row_in_half(k, 1);
    const auto both = [&](const std::uint32_t* of) {
      return two_fours(at_bytes(records, of[a]) + 4 * group, at_bytes(records, of[b]) + 4 * group);
    };
    result.component[k].v = signed_sum<Minus>(both(i), both(j));
  }
  columns_of_eight(result.component[0], result.component[1], result.component[2], result.component[3]);
  return result;
}
template <unsigned Minus>
GALET_INLINE Group<Minus, 8> combine_shifted(const PassView& view, const RowBlock& block, int, Lanes<8>) {
  Group<Minus, 8> result;
  const auto both = [](const double* base, const std::uint32_t* of, int k) {
    return two_fours(at_bytes(base, of[row_in_half(k, 0)]), at_bytes(base, of[row_in_half(k, 1)]));
  };
  for (int k = 0; k < 4; ++k)
    result.component[k].v = signed_sum<Minus>(both(view.records, block.i, k), both(view.records, block.j, k));
  if (block.imaged)
    for (int k = 0; k < 4; ++k)
      result.component[k].v = _mm512_add_pd(result.component[k].v, both(view.shifts, block.shift, k));
  columns_of_eight(result.component[0], result.component[1], result.component[2], result.component[3]);
  return result;
}

#endif

/// L x + y; most flows need one column of L.
template <class V>
GALET_INLINE Plane2<V> affine(const PassView& view, const Plane2<V>& x, Plane2<V> y) {
  const double* gradient = view.gradient;
  if (view.columns_used & 1) y = {madd(V(gradient[0]), x.x, y.x), madd(V(gradient[2]), x.x, y.y)};
  if (view.columns_used & 2) y = {madd(V(gradient[1]), x.y, y.x), madd(V(gradient[3]), x.y, y.y)};
  return y;
}
template <class V>
GALET_INLINE Space<V> affine(const PassView& view, const Space<V>& x, Space<V> y) {
  const double* gradient = view.gradient;
  const auto add_column = [&](int column, V component) __attribute__((always_inline)) {
    y = {madd(V(gradient[column]), component, y.x), madd(V(gradient[3 + column]), component, y.y),
         madd(V(gradient[6 + column]), component, y.z)};
  };
  if (view.columns_used & 1) add_column(0, x.x);
  if (view.columns_used & 2) add_column(1, x.y);
  if (view.columns_used & 4) add_column(2, x.z);
  return y;
}

/// `lane`: the first of the W rows in the block.
template <Layout Y, int W>
GALET_INLINE Place<Y, W> place_of(const PassView& view, const RowBlock& block, int lane) {
  using V = Lanes<W>;
  typename LaneTypes<Y, V>::Vector branch;
  Place<Y, W> result{};
  if constexpr (Y.dim == 2) {
    const auto group = combine_shifted<0b1111>(view, block, lane, V{});
    branch = {group.component[0], group.component[1]};
    result.centres = {group.component[2], group.component[3]};
  } else {
    const auto group = combine_shifted<0b0111>(view, block, lane, V{});
    branch = {group.component[0], group.component[1], group.component[2]};
    result.together_x = group.component[3];
  }
  const V length_squared = squared(branch);
  result.distance = sqrt(length_squared);
  // 1 / r as r / r^2: the division does not wait for the root.
  result.inverse_distance = result.distance * (V(1.0) / length_squared);
  result.normal = result.inverse_distance * branch;
  return result;
}

template <Layout Y, int W>
GALET_INLINE Motion<Y, W> motion_of(const PassView& view, const RowBlock& block, int lane, const Place<Y, W>& place) {
  using V = Lanes<W>;
  const std::uint32_t *i = block.i + lane, *j = block.j + lane;
  Motion<Y, W> result{};
  if constexpr (Y.dim == 2) {
    result.centres = place.centres;
    if constexpr (Y.friction) {
      const auto spins = combine<0b0010>(view.records, 1, i, j, V{});
      result.surface = spins.component[0], result.relative = spins.component[1];
    }
  } else {
    const auto motion = combine<0b0111>(view.records, 1, i, j, V{});
    result.centres = {motion.component[0], motion.component[1], motion.component[2]};
    if constexpr (Y.friction) {
      const auto spins = combine<0>(view.records, 2, i, j, V{});
      result.surface = {spins.component[0], spins.component[1], spins.component[2]};
      result.together = {place.together_x, motion.component[3], spins.component[3]};
    }
    if constexpr (Y.rolling) {
      const auto spins = combine<0b0111>(view.records, 3, i, j, V{});
      result.relative = {spins.component[0], spins.component[1], spins.component[2]};
    }
  }
  if (view.columns_used != 0) result.centres = affine(view, place.distance * place.normal, result.centres);
  return result;
}

}  // namespace galet::md
