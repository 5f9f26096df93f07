// The contact laws applied to W rows: second and third stage of the contact pass (pass.hpp).
#pragma once

#include "md/kernel/geometry.hpp"
#include "md/laws/crossing.hpp"
#include "md/laws/normal.hpp"
#include "md/laws/spring.hpp"

namespace galet::md {

/// Adds W values to eight lanes of a sum.
template <int W>
GALET_INLINE void add_lanes(double* sum, int lane, Lanes<W> value) {
  (Lanes<W>::load(sum + lane) + value).store(sum + lane);
}
template <int W>
GALET_INLINE void add_product(double* sum, int lane, Lanes<W> a, Lanes<W> b) {
  madd(a, b, Lanes<W>::load(sum + lane)).store(sum + lane);
}

/// Four components of W rows, `size` doubles apart.
GALET_INLINE void write_four(double* out, int, Lanes<1> a, Lanes<1> b, Lanes<1> c, Lanes<1> d) {
  a.store(out), b.store(out + 1), c.store(out + 2), d.store(out + 3);
}
/// Two of them.
GALET_INLINE void write_two(double* out, int, Lanes<1> a, Lanes<1> b) { a.store(out), b.store(out + 1); }
#ifdef __AVX2__
GALET_INLINE void write_four(double* out, int size, Lanes<4> a, Lanes<4> b, Lanes<4> c, Lanes<4> d) {
  transpose(a, b, c, d);
  _mm256_storeu_pd(out, a.v), _mm256_storeu_pd(out + size, b.v);
  _mm256_storeu_pd(out + 2 * size, c.v), _mm256_storeu_pd(out + 3 * size, d.v);
}
GALET_INLINE void write_two(double* out, int size, Lanes<4> a, Lanes<4> b) {
  const __m256d even = _mm256_unpacklo_pd(a.v, b.v), odd = _mm256_unpackhi_pd(a.v, b.v);
  _mm_store_pd(out, _mm256_castpd256_pd128(even)), _mm_store_pd(out + size, _mm256_castpd256_pd128(odd));
  _mm_store_pd(out + 2 * size, _mm256_extractf128_pd(even, 1));
  _mm_store_pd(out + 3 * size, _mm256_extractf128_pd(odd, 1));
}
#endif
#ifdef __AVX512F__
GALET_INLINE void write_four(double* out, int size, Lanes<8> a, Lanes<8> b, Lanes<8> c, Lanes<8> d) {
  rows_of_eight(a, b, c, d);
  const Lanes<8> registers[4] = {a, b, c, d};
  for (int k = 0; k < 4; ++k) {
    _mm256_storeu_pd(out + row_in_half(k, 0) * size, _mm512_castpd512_pd256(registers[k].v));
    _mm256_storeu_pd(out + row_in_half(k, 1) * size, _mm512_extractf64x4_pd(registers[k].v, 1));
  }
}
GALET_INLINE void write_two(double* out, int size, Lanes<8> a, Lanes<8> b) {
  const __m512d even = _mm512_unpacklo_pd(a.v, b.v), odd = _mm512_unpackhi_pd(a.v, b.v);
  const auto write = [&](double* to, __m256d first, __m256d last) {
    _mm_store_pd(to, _mm256_castpd256_pd128(first)), _mm_store_pd(to + 2 * size, _mm256_extractf128_pd(first, 1));
    _mm_store_pd(to + 4 * size, _mm256_castpd256_pd128(last)),
        _mm_store_pd(to + 6 * size, _mm256_extractf128_pd(last, 1));
  };
  write(out, _mm512_castpd512_pd256(even), _mm512_extractf64x4_pd(even, 1));
  write(out + size, _mm512_castpd512_pd256(odd), _mm512_extractf64x4_pd(odd, 1));
}
#endif

/// The constants of the pairs of W rows.
template <int W>
GALET_INLINE PairTerms<Lanes<W>> terms_of_rows(const PassView& view, const RowBlock& block, int lane) {
  alignas(64) double gathered[pair_term_count][W];
  for (int k = 0; k < W; ++k) {
    const double* from = reinterpret_cast<const double*>(view.terms + block.law[lane + k]);
    for (int term = 0; term < pair_term_count; ++term) gathered[term][k] = from[term];
  }
  const auto take = [&](int term) { return Lanes<W>::load(gathered[term]); };
  return {take(0), take(1), take(2), take(3), take(4), take(5), take(6), take(7), take(8), take(9)};
}
template <int W>
GALET_INLINE PairTerms<Lanes<W>> same_terms(const PairTerms<double>& terms) {
  using V = Lanes<W>;
  return {V(terms.damping),           V(terms.friction),
          V(terms.tangential_ratio),  V(terms.tangential_viscosity),
          V(terms.cohesion),          V(terms.range),
          V(terms.rolling_friction),  V(terms.pivoting_friction),
          V(terms.rolling_stiffness), V(terms.pivoting_stiffness)};
}

template <Layout Y, Kernel K, int W>
class Rows {
 public:
  using V = Lanes<W>;
  using M = Mask<W>;
  using Vector = typename LaneTypes<Y, V>::Vector;
  using Spin = typename LaneTypes<Y, V>::Spin;
  using C = RowColumns<Y>;
  using Spring = Spin;  // a number in 2D, a vector of the tangent plane in 3D

  GALET_INLINE Rows(const PassView& view, LaneSums& sums)
      : view_(view),
        sums_(sums),
        half_before_(view.half_before),
        half_after_(view.half_after),
        common_(same_terms<W>(view.terms[0])) {
    overshoot_ = V(view.half_before > 0 ? (view.half_before + view.half_after) / view.half_before : 1.0);
    if constexpr (!K.general && !K.hertz) {
      const V stiffness(view.constants->coefficient[0]);  // the same for all rows
      softness_ = V(1.0) / (common_.tangential_ratio * stiffness);
      rolling_softness_ = V(1.0) / (common_.rolling_stiffness * stiffness);
      pivoting_softness_ = V(1.0) / (common_.pivoting_stiffness * stiffness);
    }
  }

  /// What is known of W pairs before a law is applied.
  struct Pair : Place<Y, W>, Motion<Y, W> {
    using Motion<Y, W>::centres;
    V opening;      ///< opening velocity, n.(v_j - v_i)
    V stretch;      ///< |b| / (R_i + R_j)
    Vector across;  ///< 3D: tangential velocity of the centres
    Spring rate;    ///< slip velocity
    Spring spring;  ///< elongation of the sliding spring, as stored, in the present frame
  };

  /// The W rows from `lane` on of a block: second stage.
  GALET_INLINE Pair meet(const Place<Y, W>& place, std::size_t index, int lane) const {
    Pair at{place, motion_of<Y, W>(view_, view_.blocks[index], lane, place), {}, {}, {}, {}, {}};
    at.opening = dot(at.normal, at.centres);
    if constexpr (Y.friction) {
      at.stretch = at.distance * V::load(view_.constants[index * view_.constants_stride].inverse_reach + lane);
      if constexpr (Y.dim == 2) {
        at.rate = nmadd(at.stretch, at.surface, dot(tangent_of(at.normal), at.centres));
      } else {
        at.across = nmadd(at.opening, at.normal, at.centres);
        at.rate = madd_cross(at.stretch * at.normal, at.surface, at.across);
      }
      at.spring = transported<Spring>(columns_of(index, lane) + C::spring * block_rows, at);
    }
    return at;
  }

  /// The same: third stage.
  GALET_INLINE void evaluate(const Pair& at, std::size_t index, int lane) {
    RowBlock& block = view_.blocks[index];
    const RowConstants& constants = view_.constants[index * view_.constants_stride];
    const PairTerms<V> terms = K.general && view_.laws > 1 ? terms_of_rows<W>(view_, block, lane) : common_;
    const V coefficient = V::load(constants.coefficient + lane), critical = V::load(constants.critical + lane);
    Law law{terms, V::load(constants.reach + lane) - at.distance, {}, {}, {}, {}};
    law.touching = V(0.0) < law.deflection;
    law.depth = max(law.deflection, V(0.0));
    law.normal = normal_force<K>(view_.kind, terms, coefficient, critical, law.depth, at.opening);
    law.along = only(law.touching, law.normal.force);
    const unsigned crossing = note_states(block, lane, law.touching, &RowBlock::touching);
    if constexpr (K.account) {
      // The conservative part is what is left without damping.
      const V conservative = normal_force<K>(view_.kind, terms, coefficient, V(0.0), law.depth, V(0.0)).force;
      add_lanes(sums_.normal_viscous, lane, only(law.touching, (conservative - law.normal.force) * at.opening));
    }
    double* out = view_.out + (index * block_rows + lane) * out_size(Y);
    // Two copies of what follows: few blocks have a crossing, and the others shouldn't carry what it needs.
    if (__builtin_expect(crossing && view_.stepping, 0)) {
      const Crossing cross = cross_over(law, crossing, coefficient, critical, at, out);
      law.along = select(cross.crosses, law.along + cross.normal, law.along);
      if constexpr (K.account) add_lanes(sums_.normal_viscous, lane, cross.viscous);
      apply(at, law, cross, block, index, lane, out);
    } else {
      apply(at, law, NoCrossing{}, block, index, lane, out);
    }
  }

 private:
  GALET_INLINE double* columns_of(std::size_t index, int lane) const {
    return view_.columns + index * view_.column_count * block_rows + lane;
  }

  /// What the laws of W rows have in common.
  struct Law {
    PairTerms<V> terms;
    V deflection;
    M touching;
    V depth;  ///< deflection, not negative
    NormalForce<V> normal;
    V along;  ///< F_N, with what crossings add
  };

  struct NoCrossing {
    static constexpr bool any = false;
  };
  /// Contacts that have begun or ended since the last step (laws/crossing.hpp).
  struct Crossing : Crossings<V> {
    static constexpr bool any = true;
    M crosses, begins, ends;
    Vector sliding;  ///< end: tangential force (with the present normal, so that angular momentum is conserved)
    Spin torque;     ///< end: rolling and pivoting torque
  };

  GALET_INLINE Crossing cross_over(const Law& law, unsigned crossing, V coefficient, V critical, const Pair& at,
                                   const double* out) const {
    Crossing result{};
    result.crosses = mask_of<W>(crossing), result.begins = law.touching & result.crosses;
    const M ends = result.ends = without(result.crosses, law.touching);
    static_cast<Crossings<V>&>(result) =
        crossings<V, M>(view_.kind, law.terms, coefficient, critical, law.deflection, at.opening, law.normal.bound,
                        half_before_ + half_before_, ends);
    result.viscous = only(result.crosses, result.viscous);
    const V share = only(ends, result.last);
    const auto last = [&](int component) {
      alignas(64) double value[W];
      for (int k = 0; k < W; ++k) value[k] = out[k * out_size(Y) + component];
      return share * V::load(value);
    };
    Vector force;
    if constexpr (Y.dim == 2)
      force = {last(0), last(1)};
    else
      force = {last(0), last(1), last(2)};
    const V along = dot(force, at.normal);
    result.normal = result.normal + along;
    if constexpr (Y.friction) {
      // What the turn of the normal has put into the tangential part is no friction: Coulomb's bound takes it out.
      const Vector tangential = force - along * at.normal;
      const V most = law.terms.friction * (along + share * result.unbounded), length = sqrt(squared(tangential));
      result.sliding = min(max(most, -most) / max(length, V(1e-300)), V(1.0)) * tangential;
    }
    if constexpr (Y.rolling && Y.dim == 2) result.torque = last(torque_place(Y));
    if constexpr (Y.rolling && Y.dim == 3) result.torque = {last(6), last(7), last(8)};
    return result;
  }

  /// Forces and torques: writes the rows of `out` and what the springs remember.
  template <class Cross>
  GALET_INLINE void apply(const Pair& at, Law& law, const Cross& cross, RowBlock& block, std::size_t index, int lane,
                          double* out) {
    if (K.general && view_.range > 0) {
      const V gap = V(0.0) - law.deflection;
      const M attracted = without(gap < law.terms.range, law.touching);
      law.along = select(attracted, law.along + distant_force(law.terms, gap), law.along);
      note_states(block, lane, attracted, &RowBlock::attracted);
    }
    Vector force = law.along * at.normal;
    if constexpr (Y.friction) {
      double* columns = columns_of(index, lane);
      const V stiffness_before = varying() ? V::load(columns + C::stiffness * block_rows) : V(0.0);
      Spin torque{};
      if constexpr (Y.rolling) {
        torque = roll(at, law, columns, lane, stiffness_before, cross, block);
        if constexpr (Cross::any) torque = select(cross.ends, cross.torque, torque);
      }
      slide(at, law, columns, lane, stiffness_before, force, torque, cross, block, out);
      if (varying()) only(law.touching, law.normal.stiffness).store(columns + C::stiffness * block_rows);
    } else if constexpr (Y.dim == 2) {
      write_two(out, out_size(Y), force.x, force.y);
    } else {
      write_four(out, out_size(Y), force.x, force.y, force.z, V(0.0));
    }
    if (view_.virial) add_virial(force, at.distance * at.normal, lane);
  }

  GALET_INLINE bool varying() const { return K.general ? view_.kind.hertz : K.hertz; }

  /// Returns the bits that change.
  GALET_INLINE static unsigned note_states(RowBlock& block, int lane, M mask, std::uint8_t RowBlock::*state) {
    const unsigned change = ((block.*state >> lane) ^ bits(mask)) & ((1u << W) - 1);
    block.*state = static_cast<std::uint8_t>(block.*state ^ (change << lane));
    return change;
  }

  /// The limit of a spring of that reach and the softening of the contact half a step ahead, by the present opening
  /// velocity.
  GALET_INLINE SpringAhead<V> look_ahead(const Pair& at, const Law& law, V reach) const {
    const V moved = at.opening * half_after_;
    SpringAhead<V> ahead{reach * max(nmadd(law.normal.stiffness, moved, law.normal.bound), V(0.0)), V(1.0)};
    if (varying())
      ahead.softening = select(V(0.0) < at.opening, sqrt(max(V(1.0) - moved / law.depth, V(0.01))), V(1.0));
    return ahead;
  }

  GALET_INLINE static V load(const double* column, V) { return V::load(column); }
  GALET_INLINE static Space<V> load(const double* column, const Space<V>&) {
    return {V::load(column), V::load(column + block_rows), V::load(column + 2 * block_rows)};
  }
  GALET_INLINE static void store(V value, double* column) { value.store(column); }
  GALET_INLINE static void store(const Space<V>& value, double* column) {
    value.x.store(column), value.y.store(column + block_rows), value.z.store(column + 2 * block_rows);
  }

  GALET_INLINE static Plane2<V> tangent_of(const Plane2<V>& normal) { return {-normal.y, normal.x}; }

  /// A spring of the row's columns, brought from the last step's frame to the present one.
  template <class Value>
  GALET_INLINE Value transported(const double* column, const Pair& at) const {
    const Value spring = load(column, Value{});
    if constexpr (Y.dim == 3 && sizeof(Value) == sizeof(Space<V>))
      return carried(spring, at.normal, at.inverse_distance, at.across, at.together, half_before_);
    else
      return spring;
  }

  GALET_INLINE void note_losses(M touching, const Losses<V>& losses, double (*sums)[block_rows], int lane) const {
    add_lanes(sums[0], lane, only(touching, losses.viscous));
    add_lanes(sums[1], lane, losses.plastic);
    add_lanes(sums[2], lane, only(touching, losses.unloading));
  }

  /// What a spring makes of the normal force: its stiffness is ratio K_N, its limit reach times the bound.
  struct Resistance {
    V ratio, softness, reach, viscosity;
    bool total;
  };

  /// One spring of the rows in `touching`, `elongation` in the present frame, until it is stored; returns its force.
  template <class Value, class Cross>
  GALET_INLINE Value spring(const Pair& at, const Law& law, double* column, Value elongation, M touching,
                            V stiffness_before, const Resistance& by, const Value& rate, const Cross& cross,
                            double (*sums)[block_rows], int lane, std::uint8_t& slid) {
    const V stiffness = by.ratio * law.normal.stiffness;
    Losses<V> losses;
    const Value before = load(column, Value{});
    if (varying())
      adapt_spring<K>(by.ratio * stiffness_before, stiffness, half_before_ + half_after_, elongation, losses);
    if constexpr (Cross::any) elongation = select(cross.begins, elongation + cross.head * rate, elongation);
    const SpringTerms<V> terms{
        stiffness, by.reach * law.normal.bound, by.viscosity, by.total, half_before_, half_after_, by.softness,
        overshoot_};
    const auto ahead = [&]() __attribute__((always_inline)) { return look_ahead(at, law, by.reach); };
    Losses<V> sliding;
    M slides;
    const unsigned guess = slid >> lane & ((1u << W) - 1);
    Value force = spring_force<K>(touching, terms, ahead, rate, elongation, guess, slides, sliding);
    if (const unsigned now = bits(slides); __builtin_expect(now != guess, 0))
      slid = static_cast<std::uint8_t>(slid ^ ((guess ^ now) << lane));
    if constexpr (Cross::any) {
      force = begun(cross, slides, force, by.viscosity, rate, sliding);
      elongation = select(without(cross.begins, slides), elongation + cross.ahead * rate, elongation);
    }
    if constexpr (K.account) {
      // The springs of rows that part are given up.
      const V last = varying() ? by.ratio * stiffness_before : stiffness;
      const V given_up = V(0.5) * last * squared(before) / (half_before_ + half_after_);
      losses.viscous = sliding.viscous, losses.plastic = select(touching, sliding.plastic, given_up);
      note_losses(touching, losses, sums, lane);
    }
    store(elongation, column);
    return force;
  }

  /// The force of springs that have begun to act within the step.
  template <class Value>
  GALET_INLINE static Value begun(const Crossing& cross, M slides, const Value& force, V viscosity, const Value& rate,
                                  Losses<V>& losses) {
    const V factor = select(slides, cross.sliders, cross.springs);
    Value corrected = factor * force;
    if constexpr (K.general) {
      // A dashpot beside a spring that sticks: its force jumps.
      const V jump = select(slides, V(0.0), viscosity);
      corrected = corrected + (cross.jump - factor + V(1.0)) * jump * rate;
      losses.viscous =
          select(cross.begins, select(slides, factor, V(1.0) + cross.jump) * losses.viscous, losses.viscous);
      losses.plastic = select(cross.begins, factor * losses.plastic, losses.plastic);
    }
    return select(cross.begins, corrected, force);
  }

  template <class Cross>
  GALET_INLINE void slide(const Pair& at, const Law& law, double* columns, int lane, V stiffness_before, Vector& force,
                          const Spin& torque, const Cross& cross, RowBlock& block, double* out) {
    double* column = columns + C::spring * block_rows;
    const Resistance by{law.terms.tangential_ratio, softness_, law.terms.friction,
                        law.terms.tangential_viscosity * law.normal.critical, view_.kind.total};
    Spin resisting = spring(at, law, column, at.spring, law.touching, stiffness_before, by, at.rate, cross,
                            sums_.sliding, lane, block.sliding[0]);
    if constexpr (Y.dim == 2) {
      const Plane2<V> tangent = tangent_of(at.normal);
      V tangential = -resisting;
      if constexpr (Cross::any) tangential = select(cross.ends, dot(cross.sliding, tangent), tangential);
      force = madd(tangential, tangent, force);
      write_four(out, out_size(Y), force.x, force.y, at.stretch * tangential, torque);
    } else {
      if constexpr (Cross::any) resisting = select(cross.ends, V(-1.0) * cross.sliding, resisting);
      force = force - resisting;
      const Space<V> twist = galet::md::cross(resisting, at.stretch * at.normal);
      write_four(out, out_size(Y), force.x, force.y, force.z, twist.x);
      if constexpr (Y.rolling) {
        write_four(out + 4, out_size(Y), twist.y, twist.z, torque.x, torque.y);
        write_two(out + 8, out_size(Y), torque.z, V(0.0));
      } else {
        write_two(out + 4, out_size(Y), twist.y, twist.z);
      }
    }
  }

  /// Rolling and pivoting torque on j, from the relative rotation w_j - w_i.
  template <class Cross>
  GALET_INLINE Spin roll(const Pair& at, const Law& law, double* columns, int lane, V stiffness_before,
                         const Cross& cross, RowBlock& block) {
    double* column = columns + C::rolling * block_rows;
    const M rolls = law.touching & (V(0.0) < law.terms.rolling_friction);
    const Resistance by{law.terms.rolling_stiffness, rolling_softness_, law.terms.rolling_friction, V(0.0), false};
    const Spin elongation = transported<Spin>(column, at);
    if constexpr (Y.dim == 2) {
      return -spring(at, law, column, elongation, rolls, stiffness_before, by, at.relative, cross, sums_.rolling, lane,
                     block.sliding[1]);
    } else {
      const V about = dot(at.relative, at.normal);
      const Space<V> rate = nmadd(about, at.normal, at.relative);
      const Space<V> rolling = spring(at, law, column, elongation, rolls, stiffness_before, by, rate, cross,
                                      sums_.rolling, lane, block.sliding[1]);
      double* turns = columns + C::pivoting * block_rows;
      const M pivots = law.touching & (V(0.0) < law.terms.pivoting_friction);
      const Resistance pivot{law.terms.pivoting_stiffness, pivoting_softness_, law.terms.pivoting_friction, V(0.0),
                             false};
      const V pivoting = spring(at, law, turns, load(turns, V{}), pivots, stiffness_before, pivot, about, cross,
                                sums_.pivoting, lane, block.sliding[2]);
      return V(-1.0) * madd(pivoting, at.normal, rolling);
    }
  }

  GALET_INLINE void add_virial(const Plane2<V>& force, const Plane2<V>& branch, int lane) {
    const V f[2] = {force.x, force.y}, b[2] = {branch.x, branch.y};
    for (int a = 0; a < 2; ++a)
      for (int c = 0; c < 2; ++c) add_product(sums_.virial[2 * a + c], lane, f[a], b[c]);
  }
  GALET_INLINE void add_virial(const Space<V>& force, const Space<V>& branch, int lane) {
    const V f[3] = {force.x, force.y, force.z}, b[3] = {branch.x, branch.y, branch.z};
    for (int a = 0; a < 3; ++a)
      for (int c = 0; c < 3; ++c) add_product(sums_.virial[3 * a + c], lane, f[a], b[c]);
  }

  const PassView& view_;
  LaneSums& sums_;
  V half_before_, half_after_;
  PairTerms<V> common_;
  V overshoot_{}, softness_{}, rolling_softness_{}, pivoting_softness_{};  ///< SpringTerms
};

}  // namespace galet::md
