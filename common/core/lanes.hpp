// W doubles that are worked on at once. All widths give the same bits: every operation is the IEEE one, lane by lane
// (no approximate reciprocals), and products are fused with sums only where the source says so (`madd` and its kin),
// never by the compiler.
//
// Only files that are compiled for one instruction set include this header (core/instructions.hpp): it holds inline
// code that other processors may not have. For the same reason it includes nothing that emits functions of its own.
#pragma once

#include "common/core/inline.hpp"

#ifdef __AVX2__
#include <immintrin.h>
#endif

namespace galet::lanes {

template <int W>
struct Lanes;
template <int W>
struct Mask;

// One lane: plain C++, the oracle of the others and the fallback where there is no vector unit we know.

template <>
struct Mask<1> {
  bool on;
};
GALET_INLINE Mask<1> operator&(Mask<1> a, Mask<1> b) { return {a.on && b.on}; }
GALET_INLINE Mask<1> operator|(Mask<1> a, Mask<1> b) { return {a.on || b.on}; }
GALET_INLINE Mask<1> without(Mask<1> a, Mask<1> b) { return {a.on && !b.on}; }
GALET_INLINE unsigned bits(Mask<1> a) { return a.on ? 1 : 0; }
template <int W>
GALET_INLINE Mask<W> mask_of(unsigned bits);
template <>
GALET_INLINE Mask<1> mask_of<1>(unsigned bits) {
  return {(bits & 1) != 0};
}

template <>
struct Lanes<1> {
  double v;
  GALET_INLINE Lanes() = default;
  GALET_INLINE Lanes(double value) : v(value) {}
  GALET_INLINE static Lanes load(const double* from) { return *from; }
  GALET_INLINE void store(double* to) const { *to = v; }
};
GALET_INLINE Lanes<1> operator+(Lanes<1> a, Lanes<1> b) { return a.v + b.v; }
GALET_INLINE Lanes<1> operator-(Lanes<1> a, Lanes<1> b) { return a.v - b.v; }
GALET_INLINE Lanes<1> operator*(Lanes<1> a, Lanes<1> b) { return a.v * b.v; }
GALET_INLINE Lanes<1> operator/(Lanes<1> a, Lanes<1> b) { return a.v / b.v; }
GALET_INLINE Lanes<1> operator-(Lanes<1> a) { return -a.v; }
/// a b + c, rounded once; likewise c - a b and a b - c.
GALET_INLINE Lanes<1> madd(Lanes<1> a, Lanes<1> b, Lanes<1> c) { return __builtin_fma(a.v, b.v, c.v); }
GALET_INLINE Lanes<1> nmadd(Lanes<1> a, Lanes<1> b, Lanes<1> c) { return __builtin_fma(-a.v, b.v, c.v); }
GALET_INLINE Lanes<1> msub(Lanes<1> a, Lanes<1> b, Lanes<1> c) { return __builtin_fma(a.v, b.v, -c.v); }
GALET_INLINE Mask<1> operator<(Lanes<1> a, Lanes<1> b) { return {a.v < b.v}; }
GALET_INLINE Lanes<1> sqrt(Lanes<1> a) { return __builtin_sqrt(a.v); }
/// The larger one; b where a is not a number.
GALET_INLINE Lanes<1> max(Lanes<1> a, Lanes<1> b) { return a.v > b.v ? a.v : b.v; }
GALET_INLINE Lanes<1> min(Lanes<1> a, Lanes<1> b) { return a.v < b.v ? a.v : b.v; }
GALET_INLINE Lanes<1> select(Mask<1> mask, Lanes<1> yes, Lanes<1> no) { return mask.on ? yes : no; }
/// The value where the mask is on, else zero (whatever the value is).
GALET_INLINE Lanes<1> only(Mask<1> mask, Lanes<1> value) { return mask.on ? value.v : 0.0; }

#ifdef __AVX2__

template <>
struct Mask<4> {
  __m256d on;
};
GALET_INLINE Mask<4> operator&(Mask<4> a, Mask<4> b) { return {_mm256_and_pd(a.on, b.on)}; }
GALET_INLINE Mask<4> operator|(Mask<4> a, Mask<4> b) { return {_mm256_or_pd(a.on, b.on)}; }
GALET_INLINE Mask<4> without(Mask<4> a, Mask<4> b) { return {_mm256_andnot_pd(b.on, a.on)}; }
GALET_INLINE unsigned bits(Mask<4> a) { return static_cast<unsigned>(_mm256_movemask_pd(a.on)); }

template <>
GALET_INLINE Mask<4> mask_of<4>(unsigned bits) {
  const __m256i lanes = _mm256_set_epi64x(8, 4, 2, 1);
  return {_mm256_castsi256_pd(_mm256_cmpeq_epi64(_mm256_and_si256(_mm256_set1_epi64x(bits), lanes), lanes))};
}

template <>
struct Lanes<4> {
  __m256d v;
  GALET_INLINE Lanes() = default;
  GALET_INLINE Lanes(__m256d value) : v(value) {}
  GALET_INLINE Lanes(double value) : v(_mm256_set1_pd(value)) {}
  GALET_INLINE static Lanes load(const double* from) { return _mm256_load_pd(from); }
  GALET_INLINE void store(double* to) const { _mm256_store_pd(to, v); }
};
GALET_INLINE Lanes<4> operator+(Lanes<4> a, Lanes<4> b) { return _mm256_add_pd(a.v, b.v); }
GALET_INLINE Lanes<4> operator-(Lanes<4> a, Lanes<4> b) { return _mm256_sub_pd(a.v, b.v); }
GALET_INLINE Lanes<4> operator*(Lanes<4> a, Lanes<4> b) { return _mm256_mul_pd(a.v, b.v); }
GALET_INLINE Lanes<4> operator/(Lanes<4> a, Lanes<4> b) { return _mm256_div_pd(a.v, b.v); }
GALET_INLINE Lanes<4> operator-(Lanes<4> a) { return _mm256_xor_pd(a.v, _mm256_set1_pd(-0.0)); }
GALET_INLINE Lanes<4> madd(Lanes<4> a, Lanes<4> b, Lanes<4> c) { return _mm256_fmadd_pd(a.v, b.v, c.v); }
GALET_INLINE Lanes<4> nmadd(Lanes<4> a, Lanes<4> b, Lanes<4> c) { return _mm256_fnmadd_pd(a.v, b.v, c.v); }
GALET_INLINE Lanes<4> msub(Lanes<4> a, Lanes<4> b, Lanes<4> c) { return _mm256_fmsub_pd(a.v, b.v, c.v); }
GALET_INLINE Mask<4> operator<(Lanes<4> a, Lanes<4> b) { return {_mm256_cmp_pd(a.v, b.v, _CMP_LT_OQ)}; }
GALET_INLINE Lanes<4> sqrt(Lanes<4> a) { return _mm256_sqrt_pd(a.v); }
GALET_INLINE Lanes<4> max(Lanes<4> a, Lanes<4> b) { return _mm256_max_pd(a.v, b.v); }
GALET_INLINE Lanes<4> min(Lanes<4> a, Lanes<4> b) { return _mm256_min_pd(a.v, b.v); }
GALET_INLINE Lanes<4> select(Mask<4> mask, Lanes<4> yes, Lanes<4> no) { return _mm256_blendv_pd(no.v, yes.v, mask.on); }
GALET_INLINE Lanes<4> only(Mask<4> mask, Lanes<4> value) { return _mm256_and_pd(mask.on, value.v); }

/// Four rows of four to four columns.
GALET_INLINE void transpose(Lanes<4>& a, Lanes<4>& b, Lanes<4>& c, Lanes<4>& d) {
  const __m256d low_ab = _mm256_unpacklo_pd(a.v, b.v), high_ab = _mm256_unpackhi_pd(a.v, b.v);
  const __m256d low_cd = _mm256_unpacklo_pd(c.v, d.v), high_cd = _mm256_unpackhi_pd(c.v, d.v);
  a = _mm256_permute2f128_pd(low_ab, low_cd, 0x20), c = _mm256_permute2f128_pd(low_ab, low_cd, 0x31);
  b = _mm256_permute2f128_pd(high_ab, high_cd, 0x20), d = _mm256_permute2f128_pd(high_ab, high_cd, 0x31);
}
#endif

#ifdef __AVX512F__

template <>
struct Mask<8> {
  __mmask8 on;
};
GALET_INLINE Mask<8> operator&(Mask<8> a, Mask<8> b) { return {static_cast<__mmask8>(a.on & b.on)}; }
GALET_INLINE Mask<8> operator|(Mask<8> a, Mask<8> b) { return {static_cast<__mmask8>(a.on | b.on)}; }
GALET_INLINE Mask<8> without(Mask<8> a, Mask<8> b) { return {static_cast<__mmask8>(a.on & ~b.on)}; }
GALET_INLINE unsigned bits(Mask<8> a) { return a.on; }

template <>
GALET_INLINE Mask<8> mask_of<8>(unsigned bits) {
  return {static_cast<__mmask8>(bits)};
}

template <>
struct Lanes<8> {
  __m512d v;
  GALET_INLINE Lanes() = default;
  GALET_INLINE Lanes(__m512d value) : v(value) {}
  GALET_INLINE Lanes(double value) : v(_mm512_set1_pd(value)) {}
  GALET_INLINE static Lanes load(const double* from) { return _mm512_load_pd(from); }
  GALET_INLINE void store(double* to) const { _mm512_store_pd(to, v); }
};
GALET_INLINE Lanes<8> operator+(Lanes<8> a, Lanes<8> b) { return _mm512_add_pd(a.v, b.v); }
GALET_INLINE Lanes<8> operator-(Lanes<8> a, Lanes<8> b) { return _mm512_sub_pd(a.v, b.v); }
GALET_INLINE Lanes<8> operator*(Lanes<8> a, Lanes<8> b) { return _mm512_mul_pd(a.v, b.v); }
GALET_INLINE Lanes<8> operator/(Lanes<8> a, Lanes<8> b) { return _mm512_div_pd(a.v, b.v); }
GALET_INLINE Lanes<8> operator-(Lanes<8> a) { return _mm512_xor_pd(a.v, _mm512_set1_pd(-0.0)); }
GALET_INLINE Lanes<8> madd(Lanes<8> a, Lanes<8> b, Lanes<8> c) { return _mm512_fmadd_pd(a.v, b.v, c.v); }
GALET_INLINE Lanes<8> nmadd(Lanes<8> a, Lanes<8> b, Lanes<8> c) { return _mm512_fnmadd_pd(a.v, b.v, c.v); }
GALET_INLINE Lanes<8> msub(Lanes<8> a, Lanes<8> b, Lanes<8> c) { return _mm512_fmsub_pd(a.v, b.v, c.v); }
GALET_INLINE Mask<8> operator<(Lanes<8> a, Lanes<8> b) { return {_mm512_cmp_pd_mask(a.v, b.v, _CMP_LT_OQ)}; }
GALET_INLINE Lanes<8> sqrt(Lanes<8> a) { return _mm512_sqrt_pd(a.v); }
GALET_INLINE Lanes<8> max(Lanes<8> a, Lanes<8> b) { return _mm512_max_pd(a.v, b.v); }
GALET_INLINE Lanes<8> min(Lanes<8> a, Lanes<8> b) { return _mm512_min_pd(a.v, b.v); }
GALET_INLINE Lanes<8> select(Mask<8> mask, Lanes<8> yes, Lanes<8> no) {
  return _mm512_mask_mov_pd(no.v, mask.on, yes.v);
}
GALET_INLINE Lanes<8> only(Mask<8> mask, Lanes<8> value) { return _mm512_maskz_mov_pd(mask.on, value.v); }

/// Eight rows of four to four columns; on entry rows 0 and 2, 1 and 3, 4 and 6, 5 and 7 share a register.
GALET_INLINE void columns_of_eight(Lanes<8>& a, Lanes<8>& b, Lanes<8>& c, Lanes<8>& d) {
  const __m512d low_ab = _mm512_unpacklo_pd(a.v, b.v), high_ab = _mm512_unpackhi_pd(a.v, b.v);
  const __m512d low_cd = _mm512_unpacklo_pd(c.v, d.v), high_cd = _mm512_unpackhi_pd(c.v, d.v);
  a = _mm512_shuffle_f64x2(low_ab, low_cd, 0x88), c = _mm512_shuffle_f64x2(low_ab, low_cd, 0xdd);
  b = _mm512_shuffle_f64x2(high_ab, high_cd, 0x88), d = _mm512_shuffle_f64x2(high_ab, high_cd, 0xdd);
}
/// Four columns to eight rows of four; on return rows share registers as on entry of columns_of_eight.
GALET_INLINE void rows_of_eight(Lanes<8>& a, Lanes<8>& b, Lanes<8>& c, Lanes<8>& d) {
  const __m512i first = _mm512_setr_epi64(0, 1, 8, 9, 2, 3, 10, 11),
                last = _mm512_setr_epi64(4, 5, 12, 13, 6, 7, 14, 15);
  const __m512d low_ab = _mm512_unpacklo_pd(a.v, b.v), high_ab = _mm512_unpackhi_pd(a.v, b.v);
  const __m512d low_cd = _mm512_unpacklo_pd(c.v, d.v), high_cd = _mm512_unpackhi_pd(c.v, d.v);
  a = _mm512_permutex2var_pd(low_ab, first, low_cd), c = _mm512_permutex2var_pd(low_ab, last, low_cd);
  b = _mm512_permutex2var_pd(high_ab, first, high_cd), d = _mm512_permutex2var_pd(high_ab, last, high_cd);
}
#endif

template <int W>
GALET_INLINE Lanes<W>& operator+=(Lanes<W>& a, Lanes<W> b) {
  return a = a + b;
}
template <int W>
GALET_INLINE Mask<W> operator>(Lanes<W> a, Lanes<W> b) {
  return b < a;
}
template <int W>
GALET_INLINE bool any(Mask<W> mask) {
  return bits(mask) != 0;
}

// Vectors of the plane and of space, W of them at once. A spin is V in 2D and Space<V> in 3D.

template <class V>
struct Plane2 {
  V x, y;
};
template <class V>
struct Space {
  V x, y, z;
};

template <class V>
GALET_INLINE Plane2<V> operator+(const Plane2<V>& a, const Plane2<V>& b) {
  return {a.x + b.x, a.y + b.y};
}
template <class V>
GALET_INLINE Plane2<V> operator-(const Plane2<V>& a, const Plane2<V>& b) {
  return {a.x - b.x, a.y - b.y};
}
template <class V>
GALET_INLINE Plane2<V> operator*(V s, const Plane2<V>& a) {
  return {s * a.x, s * a.y};
}
template <class V>
GALET_INLINE V dot(const Plane2<V>& a, const Plane2<V>& b) {
  return madd(a.x, b.x, a.y * b.y);
}
/// s a + b; likewise b - s a.
template <class V>
GALET_INLINE Plane2<V> madd(V s, const Plane2<V>& a, const Plane2<V>& b) {
  return {madd(s, a.x, b.x), madd(s, a.y, b.y)};
}
template <class V>
GALET_INLINE Space<V> operator+(const Space<V>& a, const Space<V>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class V>
GALET_INLINE Space<V> operator-(const Space<V>& a, const Space<V>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class V>
GALET_INLINE Space<V> operator*(V s, const Space<V>& a) {
  return {s * a.x, s * a.y, s * a.z};
}
template <class V>
GALET_INLINE V dot(const Space<V>& a, const Space<V>& b) {
  return madd(a.x, b.x, madd(a.y, b.y, a.z * b.z));
}
template <class V>
GALET_INLINE Space<V> madd(V s, const Space<V>& a, const Space<V>& b) {
  return {madd(s, a.x, b.x), madd(s, a.y, b.y), madd(s, a.z, b.z)};
}
template <class V>
GALET_INLINE Space<V> nmadd(V s, const Space<V>& a, const Space<V>& b) {
  return {nmadd(s, a.x, b.x), nmadd(s, a.y, b.y), nmadd(s, a.z, b.z)};
}
template <class V>
GALET_INLINE Space<V> cross(const Space<V>& a, const Space<V>& b) {
  return {msub(a.y, b.z, a.z * b.y), msub(a.z, b.x, a.x * b.z), msub(a.x, b.y, a.y * b.x)};
}
/// c + a x b.
template <class V>
GALET_INLINE Space<V> madd_cross(const Space<V>& a, const Space<V>& b, const Space<V>& c) {
  return {madd(a.y, b.z, nmadd(a.z, b.y, c.x)), madd(a.z, b.x, nmadd(a.x, b.z, c.y)),
          madd(a.x, b.y, nmadd(a.y, b.x, c.z))};
}
template <int W>
GALET_INLINE Lanes<W> dot(Lanes<W> a, Lanes<W> b) {
  return a * b;
}
template <class Value>
GALET_INLINE auto squared(const Value& a) {
  return dot(a, a);
}
template <int W>
GALET_INLINE Space<Lanes<W>> select(Mask<W> mask, const Space<Lanes<W>>& yes, const Space<Lanes<W>>& no) {
  return {select(mask, yes.x, no.x), select(mask, yes.y, no.y), select(mask, yes.z, no.z)};
}
template <int W>
GALET_INLINE Space<Lanes<W>> only(Mask<W> mask, const Space<Lanes<W>>& value) {
  return {only(mask, value.x), only(mask, value.y), only(mask, value.z)};
}
template <int W>
GALET_INLINE Plane2<Lanes<W>> only(Mask<W> mask, const Plane2<Lanes<W>>& value) {
  return {only(mask, value.x), only(mask, value.y)};
}

}  // namespace galet::lanes
