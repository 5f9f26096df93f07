// Two groups of four doubles of one grain (fours.hpp), for spheres with friction: of its centre and of its rotation.
// Eight<1> and Eight<4> are two groups, Eight<8> is one register of AVX-512; all give the same bits. Included by
// kernels only (lanes.hpp).
#pragma once

#include "md/kernel/fours.hpp"

namespace galet::md {

/// The lanes of a group where the contact pass has W.
constexpr int lanes_of_four(int width) { return width < 4 ? 1 : 4; }

template <int W>
struct Eight {
  using F = Four<W>;
  F linear, angular;
  GALET_INLINE static Eight of(const F& linear, const F& angular) { return {linear, angular}; }
  GALET_INLINE static Eight all(double a) { return {F::all(a), F::all(a)}; }
  GALET_INLINE static Eight load(const double* from) { return {F::load(from), F::load(from + 4)}; }
  GALET_INLINE void store(double* to) const { linear.store(to), angular.store(to + 4); }
};

template <int W>
GALET_INLINE Eight<W> operator+(const Eight<W>& a, const Eight<W>& b) {
  return {a.linear + b.linear, a.angular + b.angular};
}
template <int W>
GALET_INLINE Eight<W> operator-(const Eight<W>& a, const Eight<W>& b) {
  return {a.linear - b.linear, a.angular - b.angular};
}
template <int W>
GALET_INLINE Eight<W> madd(const Eight<W>& a, const Eight<W>& b, const Eight<W>& c) {
  return {madd(a.linear, b.linear, c.linear), madd(a.angular, b.angular, c.angular)};
}
/// Of each group the first three of `a`, the fourth of `b`.
template <int W>
GALET_INLINE Eight<W> with_fourth(const Eight<W>& a, const Eight<W>& b) {
  return {with_fourth(a.linear, b.linear), with_fourth(a.angular, b.angular)};
}
/// The fourth of each group in all of its places.
template <int W>
GALET_INLINE Eight<W> fourth_everywhere(const Eight<W>& a) {
  return {everywhere<3>(a.linear), everywhere<3>(a.angular)};
}
template <int W>
GALET_INLINE Four<W> linear(const Eight<W>& a) {
  return a.linear;
}
template <int W>
GALET_INLINE Four<W> angular(const Eight<W>& a) {
  return a.angular;
}
template <int W>
GALET_INLINE Eight<W> minus_linear(const Eight<W>& a, const Four<W>& b) {
  return {a.linear - b, a.angular};
}

/// Rows of three and three numbers one behind the other: as they lie there. Two numbers behind a row are read.
template <int W>
struct PackedRow {
  Four<W> first, last;
  GALET_INLINE static PackedRow load_any(const double* from) {
    return {Four<W>::load_any(from), Four<W>::load_any(from + 3)};
  }
};
template <int W>
GALET_INLINE PackedRow<W> operator+(const PackedRow<W>& a, const PackedRow<W>& b) {
  return {a.first + b.first, a.last + b.last};
}
/// Of the first three a - b, of the last three a + b, each in its group.
template <int W>
GALET_INLINE Eight<W> forces_and_twists(const PackedRow<W>& a, const PackedRow<W>& b) {
  return {a.first - b.first, a.last + b.last};
}

#ifdef __AVX512F__

template <>
struct Eight<8> {
  __m512d v;
  GALET_INLINE static Eight of(Four<4> linear, Four<4> angular) {
    return {_mm512_maskz_insertf64x4(0xff, _mm512_castpd256_pd512(linear.v), angular.v, 1)};
  }
  GALET_INLINE static Eight all(double a) { return {_mm512_set1_pd(a)}; }
  GALET_INLINE static Eight load(const double* from) { return {_mm512_loadu_pd(from)}; }
  GALET_INLINE void store(double* to) const { _mm512_storeu_pd(to, v); }
};
GALET_INLINE Eight<8> operator+(Eight<8> a, Eight<8> b) { return {_mm512_add_pd(a.v, b.v)}; }
GALET_INLINE Eight<8> operator-(Eight<8> a, Eight<8> b) { return {_mm512_sub_pd(a.v, b.v)}; }
GALET_INLINE Eight<8> madd(Eight<8> a, Eight<8> b, Eight<8> c) { return {_mm512_fmadd_pd(a.v, b.v, c.v)}; }
GALET_INLINE Eight<8> with_fourth(Eight<8> a, Eight<8> b) { return {_mm512_mask_blend_pd(0x88, a.v, b.v)}; }
GALET_INLINE Eight<8> fourth_everywhere(Eight<8> a) { return {_mm512_permutex_pd(a.v, 0xff)}; }
GALET_INLINE Four<4> linear(Eight<8> a) { return {_mm512_castpd512_pd256(a.v)}; }
GALET_INLINE Four<4> angular(Eight<8> a) { return {_mm512_extractf64x4_pd(a.v, 1)}; }
GALET_INLINE Eight<8> minus_linear(Eight<8> a, Four<4> b) {
  return {_mm512_mask_sub_pd(a.v, 0x0f, a.v, _mm512_castpd256_pd512(b.v))};
}

template <>
struct PackedRow<8> {
  __m512d v;
  GALET_INLINE static PackedRow load_any(const double* from) { return {_mm512_loadu_pd(from)}; }
};
GALET_INLINE PackedRow<8> operator+(PackedRow<8> a, PackedRow<8> b) { return {_mm512_add_pd(a.v, b.v)}; }
GALET_INLINE Eight<8> forces_and_twists(PackedRow<8> a, PackedRow<8> b) {
  const __m512d result = _mm512_mask_sub_pd(_mm512_add_pd(a.v, b.v), 0x07, a.v, b.v);
  return {_mm512_permutexvar_pd(_mm512_setr_epi64(0, 1, 2, 3, 3, 4, 5, 6), result)};
}

#endif

}  // namespace galet::md
