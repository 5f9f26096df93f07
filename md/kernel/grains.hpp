// Per-grain work of the md step: gather of the contact rows with the closing half kick, drift, or both in one go
// (md/grain_pass.hpp has the scheme). Compiled once per width like the contact pass; a group of four doubles is the
// unit of all of them.
#pragma once

#include "md/kernel/fours.hpp"
#include "md/kernel/view.hpp"

namespace galet::md {

template <Layout Y, int W>
class Grains {
 public:
  using F = Four<W>;
  using S = StateGroups<Y>;

  GALET_INLINE explicit Grains(const GrainView& view)
      : view_(view),
        half_(F::all(view.half)),
        whole_(F::all(2 * view.half)),
        kick_(F::all(view.kick)),
        gravity_(F::load(view.gravity)) {}

  /// Accelerations and velocities at the end of a step.
  struct Motion {
    F acceleration, velocity;  // in 2D the third component is the rotation's
    F turning, spin;           // 3D with friction
  };

  /// Accelerations from the contact rows, and the second half of the kick.
  GALET_INLINE Motion gather(std::size_t grain) const {
    const double *state = view_.state + grain * S::size, *record = view_.records + grain * record_size(Y);
    Motion now{};
    const F velocity = F::load(state + S::velocity);
    if constexpr (Y.dim == 2) {
      F second, first;
      add_rows(grain, 0, second, first);
      // Rows: Fx Fy twist torque. The twist acts alike on both grains.
      const F force = Y.friction ? second + with_third_negative(first) : second - first;
      F acceleration = force * F::load(state + S::factors);
      if constexpr (Y.rolling) acceleration = acceleration + fourth_in_third(acceleration);
      now.acceleration = acceleration + gravity_;
    } else {
      F second, first;
      add_rows(grain, 0, second, first);
      now.acceleration = madd(second - first, F::all(state[S::inverse_mass]), gravity_);
    }
    if (view_.columns_used != 0)
      now.acceleration =
          now.acceleration - apply<Y, W>(view_.gradient, view_.columns_used, seen_velocity<Y, W>(record), F::zero());
    now.velocity = madd(kick_, now.acceleration, velocity);
    if constexpr (Y.friction && Y.dim == 3) {
      F second, first;
      add_rows(grain, twist_place(Y), second, first);
      now.turning = (second + first) * F::all(state[S::twist_factor]);
      if constexpr (Y.rolling) {
        add_rows(grain, torque_place(Y), second, first);
        now.turning = madd(second - first, F::all(state[S::inverse_inertia]), now.turning);
      }
      now.spin = madd(kick_, now.turning, F::load(state + S::spin));
    }
    return now;
  }

  /// Keeps what gather has found; what contacts will see of the accelerations is extrapolated from the last ones.
  GALET_INLINE void keep(std::size_t grain, const Motion& now) const {
    double *state = view_.state + grain * S::size, *expected = view_.expected + grain * S::second_size;
    keep_acceleration(expected, state + S::acceleration, now.acceleration);
    keep_constants(now.velocity, state + S::velocity);
    if constexpr (Y.friction && Y.dim == 3) {
      keep_acceleration(expected + (S::expected_turning - S::expected), state + S::turning, now.turning);
      keep_constants(now.spin, state + S::spin);
    }
  }

  /// First half of the next step, from what keep() has stored.
  GALET_INLINE F drift(std::size_t grain) const {
    const double *state = view_.state + grain * S::size, *expected = view_.expected + grain * S::second_size;
    Motion now{};
    now.acceleration = F::load(state + S::acceleration), now.velocity = F::load(state + S::velocity);
    F turning_expected{};
    if constexpr (Y.friction && Y.dim == 3) {
      now.turning = F::load(state + S::turning), now.spin = F::load(state + S::spin);
      turning_expected = F::load(expected + (S::expected_turning - S::expected));
    }
    return move(grain, now, F::load(expected), turning_expected);
  }

  /// The same right after gather: accelerations are in registers, and what is expected of them is not stored.
  GALET_INLINE F drift(std::size_t grain, const Motion& now) const {
    double* state = view_.state + grain * S::size;
    const F expected = extrapolated(now.acceleration, F::load(state + S::acceleration));
    keep_constants(now.acceleration, state + S::acceleration);
    F turning_expected{};
    if constexpr (Y.friction && Y.dim == 3) {
      turning_expected = extrapolated(now.turning, F::load(state + S::turning));
      keep_constants(now.turning, state + S::turning);
    }
    return move(grain, now, expected, turning_expected);
  }

  GALET_INLINE double mass(std::size_t grain) const {
    return view_.expected[grain * S::second_size + S::mass - S::size];
  }

 private:
  GALET_INLINE static F extrapolated(F now, F before) { return madd(F::all(extrapolation), now - before, now); }

  /// The fourth place of these groups holds constants of the grain.
  GALET_INLINE static void keep_constants(F value, double* to) { with_fourth(value, F::load(to)).store(to); }
  GALET_INLINE static void keep_acceleration(double* expected, double* acceleration, F now) {
    keep_constants(extrapolated(now, F::load(acceleration)), expected);
    keep_constants(now, acceleration);
  }

  /// Stores half-step velocities, new positions and what contacts see; returns the squares of the half-step velocity.
  GALET_INLINE F move(std::size_t grain, const Motion& now, F expected, F turning_expected) const {
    double *state = view_.state + grain * S::size, *record = view_.records + grain * record_size(Y);
    const F mid = madd(half_, now.acceleration, now.velocity), seen = madd(half_, expected, mid);
    keep_constants(mid, state + S::velocity);
    const F place = F::load(record);
    F moved = madd(whole_, mid, place);
    if (view_.columns_used != 0) {
      moved = apply<Y, W>(view_.step, view_.columns_used, mid, moved);
      moved = apply<Y, W>(view_.deform, view_.columns_used, place, moved);
    }
    if constexpr (Y.dim == 2) {
      first_pairs(moved, seen).store(record);
      // R w, w
      if constexpr (Y.friction) (third_in_first_pair(seen) * F::load(state + S::record_factors)).store(record + 4);
    } else if constexpr (!Y.friction) {
      with_fourth(moved, F::zero()).store(record), with_fourth(seen, F::zero()).store(record + 4);
    } else {
      const F turned = madd(half_, now.turning, now.spin), spinning = madd(half_, turning_expected, turned);
      keep_constants(turned, state + S::spin);
      with_fourth(moved, everywhere<0>(spinning)).store(record);
      with_fourth(seen, everywhere<1>(spinning)).store(record + 4);
      with_fourth(F::all(state[S::radius]) * spinning, everywhere<2>(spinning)).store(record + 8);
      if constexpr (Y.rolling) with_fourth(spinning, F::zero()).store(record + 12);
    }
    return mid * mid;
  }

  /// Sum of four components of the rows of a grain: as second member, and as first. Four of each come in fixed slots.
  /// (In 3D the fourth belongs to something else: of no use.)
  GALET_INLINE void add_rows(std::size_t grain, int component, F& second, F& first) const {
    const std::uint32_t* slot = view_.slots + slots_per_grain * grain;
    const double* out = view_.out + component;
    const auto load = [](const double* from) { return out_size(Y) == 2 ? F::load_pair(from) : F::load_any(from); };
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
  F half_, whole_, kick_, gravity_;
};

/// End of a step. Adds to the columns of the sum of m v (x) v, if it is wanted.
template <Layout Y, int W>
void gather_grains(const GrainView& given, std::size_t begin, std::size_t end, double (&kinetic)[3][4]) {
  using F = Four<W>;
  const GrainView view = given;
  const Grains<Y, W> grains(view);
  F square[3] = {F::load(kinetic[0]), F::load(kinetic[1]), F::load(kinetic[2])};
  for (std::size_t grain = begin; grain < end; ++grain) {
    const auto now = grains.gather(grain);
    grains.keep(grain, now);
    if (!view.kinetic) continue;
    const F momentum = F::all(grains.mass(grain)) * now.velocity;
    square[0] = madd(momentum, everywhere<0>(now.velocity), square[0]);
    square[1] = madd(momentum, everywhere<1>(now.velocity), square[1]);
    if (Y.dim == 3) square[2] = madd(momentum, everywhere<2>(now.velocity), square[2]);
  }
  for (int a = 0; a < 3; ++a) square[a].store(kinetic[a]);
}

/// Beginning of a step. `fastest`: largest squares of the half-step velocities, component by component.
template <Layout Y, int W>
void drift_grains(const GrainView& given, std::size_t begin, std::size_t end, double (&fastest)[4]) {
  const GrainView view = given;
  const Grains<Y, W> grains(view);
  Four<W> largest = Four<W>::load(fastest);
  for (std::size_t grain = begin; grain < end; ++grain) largest = larger(largest, grains.drift(grain));
  largest.store(fastest);
}

/// End of one step and beginning of the next.
template <Layout Y, int W>
void step_grains(const GrainView& given, std::size_t begin, std::size_t end, double (&fastest)[4]) {
  const GrainView view = given;
  const Grains<Y, W> grains(view);
  Four<W> largest = Four<W>::load(fastest);
  for (std::size_t grain = begin; grain < end; ++grain)
    largest = larger(largest, grains.drift(grain, grains.gather(grain)));
  largest.store(fastest);
}

template <Layout Y, int W>
GrainFunctions grain_functions_of_width() {
  return {gather_grains<Y, W>, drift_grains<Y, W>, step_grains<Y, W>};
}

}  // namespace galet::md
