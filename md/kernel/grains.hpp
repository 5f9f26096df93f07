// Per-grain work of the md step: gather of the contact rows with the closing half kick, and drift (md/grain_pass.hpp
// has the scheme). Compiled once per width like the contact pass; a group of four doubles is the unit of both.
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
GALET_FOUR_OPERATION(/)
#undef GALET_FOUR_OPERATION
/// The first three of `a`, the fourth of `b`.
GALET_INLINE Four<1> with_fourth(Four<1> a, Four<1> b) { return {{a.v[0], a.v[1], a.v[2], b.v[3]}}; }
/// Component k in all four places.
template <int K>
GALET_INLINE Four<1> everywhere(Four<1> a) {
  return Four<1>::all(a.v[K]);
}
GALET_INLINE void store_some(Four<1> a, double* to, int count) {
  for (int k = 0; k < count; ++k) to[k] = a.v[k];
}

#ifdef __AVX2__
template <>
struct Four<4> {
  __m256d v;
  GALET_INLINE static Four zero() { return {_mm256_setzero_pd()}; }
  GALET_INLINE static Four all(double a) { return {_mm256_set1_pd(a)}; }
  GALET_INLINE static Four load(const double* from) { return {_mm256_load_pd(from)}; }
  GALET_INLINE void store(double* to) const { _mm256_store_pd(to, v); }
};
GALET_INLINE Four<4> operator+(Four<4> a, Four<4> b) { return {_mm256_add_pd(a.v, b.v)}; }
GALET_INLINE Four<4> operator-(Four<4> a, Four<4> b) { return {_mm256_sub_pd(a.v, b.v)}; }
GALET_INLINE Four<4> operator*(Four<4> a, Four<4> b) { return {_mm256_mul_pd(a.v, b.v)}; }
GALET_INLINE Four<4> operator/(Four<4> a, Four<4> b) { return {_mm256_div_pd(a.v, b.v)}; }
GALET_INLINE Four<4> with_fourth(Four<4> a, Four<4> b) { return {_mm256_blend_pd(a.v, b.v, 8)}; }
template <int K>
GALET_INLINE Four<4> everywhere(Four<4> a) {
  return {_mm256_permute4x64_pd(a.v, K * 0x55)};
}
/// The first one, two or three to memory that need not be aligned.
GALET_INLINE void store_some(Four<4> a, double* to, int count) {
  if (count == 1) return _mm_store_sd(to, _mm256_castpd256_pd128(a.v));
  _mm_storeu_pd(to, _mm256_castpd256_pd128(a.v));
  if (count == 3) _mm_store_sd(to + 2, _mm256_extractf128_pd(a.v, 1));
}
#endif

template <int W>
GALET_INLINE Four<W>& operator+=(Four<W>& a, Four<W> b) {
  return a = a + b;
}

/// matrix (columns as groups) times a vector.
template <Layout Y, int W>
GALET_INLINE Four<W> apply(const double (&columns)[3][4], Four<W> x) {
  using F = Four<W>;
  F sum = F::load(columns[0]) * everywhere<0>(x) + F::load(columns[1]) * everywhere<1>(x);
  if constexpr (Y.dim == 3) sum = sum + F::load(columns[2]) * everywhere<2>(x);
  return sum;
}

/// Sum of one group of the rows of a grain: as second member, and as first.
template <Layout Y, int W>
GALET_INLINE void add_rows(const GrainView& view, int grain, int group, Four<W>& second, Four<W>& first) {
  using F = Four<W>;
  const int* slot = view.slots + 8 * static_cast<std::size_t>(grain);
  const double* out = view.out + 4 * group;
  const auto row = [&](int k) { return F::load(out + static_cast<std::size_t>(k) * out_size(Y)); };
  second = (row(slot[0]) + row(slot[1])) + (row(slot[2]) + row(slot[3]));
  first = (row(slot[4]) + row(slot[5])) + (row(slot[6]) + row(slot[7]));
  for (int k = view.second[grain] + 4; k < view.second[grain + 1]; ++k) second += row(view.rows_of_second[k]);
  for (int k = view.first[grain] + 4; k < view.first[grain + 1]; ++k) first += row(k);
}

/// The same for rows of two doubles (2D frictionless).
template <int W>
GALET_INLINE void add_short_rows(const GrainView& view, int grain, Four<W>& force) {
  alignas(32) double sum[4] = {0, 0, 0, 0};
  for (int k = view.second[grain]; k < view.second[grain + 1]; ++k)
    for (int a = 0; a < 2; ++a) sum[a] += view.out[2 * static_cast<std::size_t>(view.rows_of_second[k]) + a];
  for (int k = view.first[grain]; k < view.first[grain + 1]; ++k)
    for (int a = 0; a < 2; ++a) sum[a] -= view.out[2 * static_cast<std::size_t>(k) + a];
  force = Four<W>::load(sum);
}

/// The velocity in a record.
template <Layout Y, int W>
GALET_INLINE Four<W> seen_velocity(const double* record) {
  if constexpr (Y.dim == 3) return Four<W>::load(record + 4);
  alignas(32) const double pair[4] = {record[2], record[3], 0, 0};
  return Four<W>::load(pair);
}

/// Accelerations from the contact rows, and the second half of the kick.
template <Layout Y, int W>
void gather_grains(const GrainView& view, std::size_t begin, std::size_t end, double (&kinetic)[3][4]) {
  using F = Four<W>;
  using S = StateGroups<Y>;
  const F kick = F::all(view.kick), gravity = F::load(view.gravity);
  F square[3] = {F::load(kinetic[0]), F::load(kinetic[1]), F::load(kinetic[2])};
  for (std::size_t i = begin; i < end; ++i) {
    const int grain = static_cast<int>(i);
    double* state = view.state + i * S::size;
    const double* record = view.records + i * record_size(Y);
    F second, first, force;
    if constexpr (out_size(Y) == 2) {
      add_short_rows<W>(view, grain, force);
    } else {
      add_rows<Y, W>(view, grain, 0, second, first);
      force = second - first;
    }
    const double mass = state[S::velocity + 3];
    F acceleration = force / F::all(mass) + gravity;
    if (view.deforming) acceleration = acceleration - apply<Y, W>(view.gradient, seen_velocity<Y, W>(record));
    if constexpr (Y.friction && Y.dim == 2) {
      // Rows: Fx Fy twist torque; groups of the state: x, y and the rotation.
      alignas(32) double turning[4], rolling[4], linear[4];
      (second + first).store(turning), (second - first).store(rolling), acceleration.store(linear);
      const double radius = state[S::radius], inertia = state[S::inertia];
      linear[2] = -radius / inertia * turning[2];
      if constexpr (Y.rolling) linear[2] += rolling[3] / inertia;
      acceleration = F::load(linear);
    }
    const F old = F::load(state + S::acceleration), velocity = F::load(state + S::velocity);
    // The fourth of these groups holds constants of the grain.
    with_fourth(acceleration, old).store(state + S::acceleration);
    const F kicked = with_fourth(velocity + kick * acceleration, velocity);
    kicked.store(state + S::velocity);
    if (view.kinetic)
      for (int a = 0; a < Y.dim; ++a) square[a] += F::all(mass) * kicked * F::all(state[S::velocity + a]);
    if constexpr (Y.friction && Y.dim == 3) {
      add_rows<Y, W>(view, grain, 1, second, first);
      const double radius = state[S::radius], inertia = state[S::inertia];
      F turn = F::all(-radius / inertia) * (second + first);
      if constexpr (Y.rolling) {
        add_rows<Y, W>(view, grain, 2, second, first);
        turn = turn + (second - first) / F::all(inertia);
      }
      const F spin = F::load(state + S::spin), old_turn = F::load(state + S::turning);
      with_fourth(turn, old_turn).store(state + S::turning);
      with_fourth(spin + kick * turn, spin).store(state + S::spin);
    }
  }
  for (int a = 0; a < 3; ++a) square[a].store(kinetic[a]);
}

/// The acceleration expected for the step to come; keeps the present one as the one before.
template <int W>
GALET_INLINE Four<W> expected(Four<W> now, double* before) {
  const Four<W> last = Four<W>::load(before);
  with_fourth(now, last).store(before);
  return now + Four<W>::all(extrapolation) * (now - last);
}

/// First half of the step. On return the states hold half-step velocities, the records new positions and predicted
/// velocities.
template <Layout Y, int W>
void drift_grains(const GrainView& view, std::size_t begin, std::size_t end) {
  using F = Four<W>;
  using S = StateGroups<Y>;
  const F half = F::all(view.half), whole = F::all(2 * view.half);
  for (std::size_t i = begin; i < end; ++i) {
    double* state = view.state + i * S::size;
    double* record = view.records + i * record_size(Y);
    const F acceleration = F::load(state + S::acceleration), velocity = F::load(state + S::velocity);
    const F mid = with_fourth(velocity + half * acceleration, velocity);
    mid.store(state + S::velocity);
    const F seen = mid + half * expected<W>(acceleration, state + S::before);
    const F place = F::load(record);
    const F moved =
        view.deforming ? apply<Y, W>(view.deform, place) + apply<Y, W>(view.step, mid) : place + whole * mid;
    store_some(moved, view.position + i * Y.dim, Y.dim);
    if constexpr (Y.dim == 2) {
      store_some(moved, record, 2), store_some(seen, record + 2, 2);
      if constexpr (Y.friction) {
        const F spin = everywhere<2>(seen);
        store_some(spin, record + 5, 1), store_some(F::all(state[S::radius]) * spin, record + 4, 1);
      }
    } else if constexpr (!Y.friction) {
      with_fourth(moved, F::zero()).store(record), with_fourth(seen, F::zero()).store(record + 4);
    } else {
      const F turning = F::load(state + S::turning), spin = F::load(state + S::spin);
      const F turned = with_fourth(spin + half * turning, spin);
      turned.store(state + S::spin);
      const F spinning = turned + half * expected<W>(turning, state + S::turning_before);
      with_fourth(moved, everywhere<0>(spinning)).store(record);
      with_fourth(seen, everywhere<1>(spinning)).store(record + 4);
      with_fourth(F::all(state[S::radius]) * spinning, everywhere<2>(spinning)).store(record + 8);
      if constexpr (Y.rolling) with_fourth(spinning, F::zero()).store(record + 12);
    }
  }
}

template <Layout Y, int W>
GrainFunctions grain_functions_of_width() {
  return {gather_grains<Y, W>, drift_grains<Y, W>};
}

}  // namespace galet::md
