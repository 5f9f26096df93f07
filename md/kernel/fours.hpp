// Four doubles of one grain: x, y, z (in 2D x, y and the rotation) and a fourth that usually is a constant of the
// grain. Four<1> is plain C++, Four<4> a register of AVX2; both give the same bits. Included by kernels only
// (lanes.hpp).
#pragma once

#include "md/kernel/lanes.hpp"
#include "md/kernel/view.hpp"

namespace galet::md {

template <int W>
struct Four;

template <>
struct Four<1> {
  double v[4];
  GALET_INLINE static Four zero() { return {{0, 0, 0, 0}}; }
  GALET_INLINE static Four all(double a) { return {{a, a, a, a}}; }
  GALET_INLINE static Four load(const double* from) { return {{from[0], from[1], from[2], from[3]}}; }
  GALET_INLINE static Four load_any(const double* from) { return load(from); }
  GALET_INLINE static Four load_pair(const double* from) { return {{from[0], from[1], 0, 0}}; }
  GALET_INLINE void store(double* to) const {
    for (int k = 0; k < 4; ++k) to[k] = v[k];
  }
};
#define GALET_FOUR_OPERATION(symbol)                           \
  GALET_INLINE Four<1> operator symbol(Four<1> a, Four<1> b) { \
    Four<1> c;                                                 \
    for (int k = 0; k < 4; ++k) c.v[k] = a.v[k] symbol b.v[k]; \
    return c;                                                  \
  }
GALET_FOUR_OPERATION(+)
GALET_FOUR_OPERATION(-)
GALET_FOUR_OPERATION(*)
#undef GALET_FOUR_OPERATION
/// a b + c, rounded once.
GALET_INLINE Four<1> madd(Four<1> a, Four<1> b, Four<1> c) {
  for (int k = 0; k < 4; ++k) c.v[k] = __builtin_fma(a.v[k], b.v[k], c.v[k]);
  return c;
}
/// The larger ones; b's where a's is not a number.
GALET_INLINE Four<1> larger(Four<1> a, Four<1> b) {
  for (int k = 0; k < 4; ++k) b.v[k] = a.v[k] > b.v[k] ? a.v[k] : b.v[k];
  return b;
}
/// The first three of `a`, the fourth of `b`.
GALET_INLINE Four<1> with_fourth(Four<1> a, Four<1> b) { return {{a.v[0], a.v[1], a.v[2], b.v[3]}}; }
/// -a, but for the third.
GALET_INLINE Four<1> with_third_negative(Four<1> a) { return {{-a.v[0], -a.v[1], a.v[2], -a.v[3]}}; }
/// 0, 0, fourth, 0.
GALET_INLINE Four<1> fourth_in_third(Four<1> a) { return {{0, 0, a.v[3], 0}}; }
/// The first two of each.
GALET_INLINE Four<1> first_pairs(Four<1> a, Four<1> b) { return {{a.v[0], a.v[1], b.v[0], b.v[1]}}; }
/// The third, twice, then anything.
GALET_INLINE Four<1> third_in_first_pair(Four<1> a) { return {{a.v[2], a.v[2], a.v[2], a.v[2]}}; }
/// Component K in all four places.
template <int K>
GALET_INLINE Four<1> everywhere(Four<1> a) {
  return Four<1>::all(a.v[K]);
}

#ifdef __AVX2__
template <>
struct Four<4> {
  __m256d v;
  GALET_INLINE static Four zero() { return {_mm256_setzero_pd()}; }
  GALET_INLINE static Four all(double a) { return {_mm256_set1_pd(a)}; }
  GALET_INLINE static Four load(const double* from) { return {_mm256_load_pd(from)}; }
  /// From anywhere.
  GALET_INLINE static Four load_any(const double* from) { return {_mm256_loadu_pd(from)}; }
  GALET_INLINE static Four load_pair(const double* from) { return {_mm256_zextpd128_pd256(_mm_load_pd(from))}; }
  GALET_INLINE void store(double* to) const { _mm256_store_pd(to, v); }
};
GALET_INLINE Four<4> operator+(Four<4> a, Four<4> b) { return {_mm256_add_pd(a.v, b.v)}; }
GALET_INLINE Four<4> operator-(Four<4> a, Four<4> b) { return {_mm256_sub_pd(a.v, b.v)}; }
GALET_INLINE Four<4> operator*(Four<4> a, Four<4> b) { return {_mm256_mul_pd(a.v, b.v)}; }
GALET_INLINE Four<4> madd(Four<4> a, Four<4> b, Four<4> c) { return {_mm256_fmadd_pd(a.v, b.v, c.v)}; }
GALET_INLINE Four<4> larger(Four<4> a, Four<4> b) { return {_mm256_max_pd(a.v, b.v)}; }
GALET_INLINE Four<4> with_fourth(Four<4> a, Four<4> b) { return {_mm256_blend_pd(a.v, b.v, 8)}; }
GALET_INLINE Four<4> with_third_negative(Four<4> a) {
  return {_mm256_xor_pd(a.v, _mm256_castsi256_pd(_mm256_set_epi64x(INT64_MIN, 0, INT64_MIN, INT64_MIN)))};
}
GALET_INLINE Four<4> fourth_in_third(Four<4> a) {
  return {_mm256_blend_pd(_mm256_setzero_pd(), _mm256_permute_pd(a.v, 0b0110), 0b0100)};
}
GALET_INLINE Four<4> first_pairs(Four<4> a, Four<4> b) { return {_mm256_permute2f128_pd(a.v, b.v, 0x20)}; }
GALET_INLINE Four<4> third_in_first_pair(Four<4> a) { return {_mm256_permute4x64_pd(a.v, 0b10101010)}; }
template <int K>
GALET_INLINE Four<4> everywhere(Four<4> a) {
  return {_mm256_permute4x64_pd(a.v, K * 0x55)};
}
#endif

/// A matrix (columns as groups; bit k of `columns_used`: whether the k-th is not zero) times a vector, and one more
/// added.
template <Layout Y, class F>
GALET_INLINE F apply(const double (&columns)[3][4], unsigned columns_used, F x, F sum) {
  // The same for all grains; in simple shear two of three are zero.
  if (Y.dim == 3 && (columns_used & 4)) sum = madd(F::load(columns[2]), everywhere<2>(x), sum);
  if (columns_used & 2) sum = madd(F::load(columns[1]), everywhere<1>(x), sum);
  if (columns_used & 1) sum = madd(F::load(columns[0]), everywhere<0>(x), sum);
  return sum;
}

/// The velocity in a record.
template <Layout Y, class F>
GALET_INLINE F seen_velocity(const double* record) {
  if constexpr (Y.dim == 3)
    return F::load(record + 4);
  else
    return F::load_pair(record + 2);
}

/// A group that holds all of a motion: what eights.hpp does with two.
template <int W>
GALET_INLINE Four<W> linear(Four<W> a) {
  return a;
}
template <int W>
GALET_INLINE Four<W> minus_linear(Four<W> a, Four<W> b) {
  return a - b;
}

}  // namespace galet::md
