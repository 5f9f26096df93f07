// W pairs of bodies, loaded from their records: relative velocities, and the answer to impulses.
#pragma once

#include "cd/kernel/view.hpp"
#include "common/core/lanes.hpp"

namespace galet::cd {

using namespace lanes;

template <Layout Y, int W>
struct PairTypes {
  using V = Lanes<W>;
};
template <int D, class V>
struct VectorOf;
template <class V>
struct VectorOf<2, V> {
  using type = Plane2<V>;
};
template <class V>
struct VectorOf<3, V> {
  using type = Space<V>;
};

GALET_INLINE void load_records(const double* base, const std::uint32_t* at, Lanes<1> (&out)[4]) {
  for (int k = 0; k < 4; ++k) out[k] = base[at[0] + k];
}
GALET_INLINE void store_records(double* base, const std::uint32_t* at, std::uint32_t movable, const Lanes<1> (&in)[4],
                                std::uint32_t shift) {
  if (at[0] < movable)
    for (int k = 0; k < 4; ++k) base[at[0] + shift + k] = in[k].v;
}
#ifdef __AVX2__
GALET_INLINE void load_records(const double* base, const std::uint32_t* at, Lanes<4> (&out)[4]) {
  for (int k = 0; k < 4; ++k) out[k] = Lanes<4>::load(base + at[k]);
  transpose(out[0], out[1], out[2], out[3]);
}
GALET_INLINE void store_records(double* base, const std::uint32_t* at, std::uint32_t movable, const Lanes<4> (&in)[4],
                                std::uint32_t shift) {
  Lanes<4> a = in[0], b = in[1], c = in[2], d = in[3];
  transpose(a, b, c, d);
  if (at[0] < movable) a.store(base + at[0] + shift);
  if (at[1] < movable) b.store(base + at[1] + shift);
  if (at[2] < movable) c.store(base + at[2] + shift);
  if (at[3] < movable) d.store(base + at[3] + shift);
}
#endif

/// One body of each pair.
template <Layout Y, int W>
struct BodyLanes {
  using V = Lanes<W>;
  static constexpr bool turns_in_space = Y.friction && Y.dim == 3;
  V record[4];                       ///< v and 1/m; 2D with friction: vx vy w 1/m
  V second[turns_in_space ? 4 : 1];  ///< 3D: w and 1/I

  GALET_INLINE void load(const double* bodies, const std::uint32_t* at) {
    load_records(bodies, at, record);
    if constexpr (turns_in_space) load_records(bodies + 4, at, second);
  }
  GALET_INLINE void store(double* bodies, const std::uint32_t* at, std::uint32_t movable) const {
    store_records(bodies, at, movable, record, 0);
    if constexpr (turns_in_space) store_records(bodies, at, movable, second, 4);
  }
  GALET_INLINE auto velocity() const {
    if constexpr (Y.dim == 2)
      return Plane2<V>{record[0], record[1]};
    else
      return Space<V>{record[0], record[1], record[2]};
  }
  GALET_INLINE Space<V> spin() const { return {second[0], second[1], second[2]}; }
  GALET_INLINE V inverse_mass() const { return record[3]; }
};

}  // namespace galet::cd
