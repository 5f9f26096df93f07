// Per-grain work of the md step: gather of the contact rows with the closing half kick, drift, or both in one go
// (md/grain_pass.hpp has the scheme). Compiled once per width like the contact pass; a group of four doubles is the
// unit of all of them.
#pragma once

#include <type_traits>

#include "md/kernel/eights.hpp"
#include "md/kernel/view.hpp"

namespace galet::md {

template <Layout Y, int W>
class Grains {
 public:
  using F = Four<lanes_of_four(W)>;
  using S = StateGroups<Y>;
  /// Motion of a grain: of its centre (in 2D the third component is the rotation's), in 3D with friction also of its
  /// rotation.
  using M = std::conditional_t<S::twice, Eight<W>, F>;

  GALET_INLINE explicit Grains(const GrainView& view)
      : view_(view), half_(M::all(view.half)), whole_(F::all(2 * view.half)), kick_(M::all(view.kick)) {
    if constexpr (S::twice)
      gravity_ = M::of(F::load(view.gravity), F::zero());
    else
      gravity_ = F::load(view.gravity);
  }

  /// Accelerations and velocities at the end of a step.
  struct Motion {
    M acceleration, velocity;
  };

  /// Accelerations from the contact rows, and the second half of the kick.
  GALET_INLINE Motion gather(std::size_t grain) const {
    const double *state = view_.state + grain * S::size, *record = view_.records + grain * record_size(Y);
    const M velocity = M::load(state + S::velocity);
    Motion now{acceleration_of(grain, state, velocity), {}};
    if (view_.columns_used != 0)
      now.acceleration = minus_linear(
          now.acceleration, apply<Y>(view_.gradient, view_.columns_used, seen_velocity<Y, F>(record), F::zero()));
    now.velocity = madd(kick_, now.acceleration, velocity);
    return now;
  }

  /// Keeps what gather has found; what contacts will see of the accelerations is extrapolated from the last ones.
  GALET_INLINE void keep(std::size_t grain, const Motion& now) const {
    double *state = view_.state + grain * S::size, *expected = view_.expected + grain * S::second_size;
    keep_constants(extrapolated(now.acceleration, M::load(state + S::acceleration)), expected);
    keep_constants(now.acceleration, state + S::acceleration);
    keep_constants(now.velocity, state + S::velocity);
  }

  /// First half of the next step, from what keep() has stored.
  GALET_INLINE F drift(std::size_t grain) const {
    const double *state = view_.state + grain * S::size, *expected = view_.expected + grain * S::second_size;
    return move(grain, {M::load(state + S::acceleration), M::load(state + S::velocity)}, M::load(expected));
  }

  /// The same right after gather: accelerations are in registers, and what is expected of them is not stored.
  GALET_INLINE F drift(std::size_t grain, const Motion& now) const {
    double* state = view_.state + grain * S::size;
    const M expected = extrapolated(now.acceleration, M::load(state + S::acceleration));
    keep_constants(now.acceleration, state + S::acceleration);
    return move(grain, now, expected);
  }

  GALET_INLINE double mass(std::size_t grain) const {
    return view_.expected[grain * S::second_size + S::mass - S::size];
  }

 private:
  GALET_INLINE static M extrapolated(M now, M before) { return madd(M::all(extrapolation), now - before, now); }

  /// The fourth place of each group holds a constant of the grain.
  GALET_INLINE static void keep_constants(M value, double* to) { with_fourth(value, M::load(to)).store(to); }

  /// From the contact rows and gravity.
  GALET_INLINE M acceleration_of(std::size_t grain, const double* state, M velocity) const {
    if constexpr (S::twice) {
      PackedRow<W> second, first;
      add_rows(grain, 0, second, first);
      M acceleration = madd(forces_and_twists(second, first), fourth_everywhere(velocity), gravity_);
      if constexpr (Y.rolling) {
        F more, less;
        add_rows(grain, torque_place(Y), more, less);
        acceleration =
            M::of(linear(acceleration), madd(more - less, F::all(state[S::inverse_inertia]), angular(acceleration)));
      }
      return acceleration;
    } else {
      F second, first;
      add_rows(grain, 0, second, first);
      if constexpr (Y.dim == 3) return madd(second - first, F::all(state[S::inverse_mass]), gravity_);
      // Rows: Fx Fy twist torque. The twist acts alike on both grains.
      const F force = Y.friction ? second + with_third_negative(first) : second - first;
      F acceleration = force * F::load(state + S::factors);
      if constexpr (Y.rolling) acceleration = acceleration + fourth_in_third(acceleration);
      return acceleration + gravity_;
    }
  }

  /// Stores half-step velocities, new positions and what contacts see; returns the squares of the half-step velocity.
  GALET_INLINE F move(std::size_t grain, const Motion& now, M expected) const {
    double *state = view_.state + grain * S::size, *record = view_.records + grain * record_size(Y);
    const M halfway = madd(half_, now.acceleration, now.velocity), seen = madd(half_, expected, halfway);
    keep_constants(halfway, state + S::velocity);
    const F mid = linear(halfway), place = F::load(record);
    F moved = madd(whole_, mid, place);
    if (view_.columns_used != 0) {
      moved = apply<Y>(view_.step, view_.columns_used, mid, moved);
      moved = apply<Y>(view_.deform, view_.columns_used, place, moved);
    }
    if constexpr (Y.dim == 2) {
      first_pairs(moved, seen).store(record);
      // R w, w
      if constexpr (Y.friction) (third_in_first_pair(seen) * F::load(state + S::record_factors)).store(record + 4);
    } else if constexpr (!Y.friction) {
      with_fourth(moved, F::zero()).store(record), with_fourth(seen, F::zero()).store(record + 4);
    } else {
      const F spin = angular(seen);
      with_fourth(moved, everywhere<0>(spin)).store(record);
      with_fourth(linear(seen), everywhere<1>(spin)).store(record + 4);
      with_fourth(F::all(state[S::radius]) * spin, everywhere<2>(spin)).store(record + 8);
      if constexpr (Y.rolling) with_fourth(spin, F::zero()).store(record + 12);
    }
    return mid * mid;
  }

  /// Sum of the rows of a grain, from the component `component` on: as second member, and as first. Four of each come
  /// in fixed slots. (In 3D the fourth belongs to something else: of no use.)
  template <class Row>
  GALET_INLINE void add_rows(std::size_t grain, int component, Row& second, Row& first) const {
    const std::uint32_t* slot = view_.slots + slots_per_grain * grain;
    const double* out = view_.out + component;
    const auto load = [](const double* from) {
      if constexpr (out_size(Y) == 2)
        return F::load_pair(from);
      else
        return Row::load_any(from);
    };
    const auto at = [&](std::uint32_t bytes) {
      return load(reinterpret_cast<const double*>(reinterpret_cast<const char*>(out) + bytes));
    };
    const auto row = [&](int k) { return load(out + static_cast<std::ptrdiff_t>(k) * out_size(Y)); };
    second = (at(slot[0]) + at(slot[1])) + (at(slot[2]) + at(slot[3]));
    first = (at(slot[4]) + at(slot[5])) + (at(slot[6]) + at(slot[7]));
    if (__builtin_expect(slot[8] != 0, 0)) {
      for (int k = view_.second[grain] + 4; k < view_.second[grain + 1]; ++k)
        second = second + row(view_.rows_of_second[k]);
      for (int k = view_.first[grain] + 4; k < view_.first[grain + 1]; ++k) first = first + row(k);
    }
  }

  const GrainView& view_;
  M half_;
  F whole_;
  M kick_, gravity_;
};

/// End of a step. Adds to the columns of the sum of m v (x) v, if it is wanted.
template <Layout Y, int W>
void gather_grains(const GrainView& given, std::size_t begin, std::size_t end, double (&kinetic)[3][4]) {
  using F = Four<lanes_of_four(W)>;
  const GrainView view = given;
  const Grains<Y, W> grains(view);
  F square[3] = {F::load(kinetic[0]), F::load(kinetic[1]), F::load(kinetic[2])};
  for (std::size_t grain = begin; grain < end; ++grain) {
    const auto now = grains.gather(grain);
    grains.keep(grain, now);
    if (!view.kinetic) continue;
    const F velocity = linear(now.velocity), momentum = F::all(grains.mass(grain)) * velocity;
    square[0] = madd(momentum, everywhere<0>(velocity), square[0]);
    square[1] = madd(momentum, everywhere<1>(velocity), square[1]);
    if (Y.dim == 3) square[2] = madd(momentum, everywhere<2>(velocity), square[2]);
  }
  for (int a = 0; a < 3; ++a) square[a].store(kinetic[a]);
}

/// Beginning of a step. `fastest`: largest squares of the half-step velocities, component by component.
template <Layout Y, int W>
void drift_grains(const GrainView& given, std::size_t begin, std::size_t end, double (&fastest)[4]) {
  const GrainView view = given;
  const Grains<Y, W> grains(view);
  auto largest = Four<lanes_of_four(W)>::load(fastest);
  for (std::size_t grain = begin; grain < end; ++grain) largest = larger(largest, grains.drift(grain));
  largest.store(fastest);
}

/// End of one step and beginning of the next.
template <Layout Y, int W>
void step_grains(const GrainView& given, std::size_t begin, std::size_t end, double (&fastest)[4]) {
  const GrainView view = given;
  const Grains<Y, W> grains(view);
  auto largest = Four<lanes_of_four(W)>::load(fastest);
  for (std::size_t grain = begin; grain < end; ++grain)
    largest = larger(largest, grains.drift(grain, grains.gather(grain)));
  largest.store(fastest);
}

template <Layout Y, int W>
GrainFunctions grain_functions_of_width() {
  return {gather_grains<Y, W>, drift_grains<Y, W>, step_grains<Y, W>};
}

}  // namespace galet::md
