// The state of the grains between steps, in the order in which the kernels work on it (kernel/view.hpp): velocities,
// accelerations now and as expected for the next step, and constants of each grain. Positions are in the records.
#pragma once

#include <utility>
#include <vector>

#include "common/core/memory_use.hpp"
#include "common/core/permutation.hpp"
#include "common/engine/bodies.hpp"
#include "md/contacts.hpp"
#include "md/kernel/view.hpp"

namespace galet::md {

template <Layout Y>
class GrainStates {
 public:
  static constexpr int D = Y.dim;
  using S = StateGroups<Y>;

  std::size_t bytes() const { return bytes_of(lines_, expected_); }
  double* expected() { return doubles(expected_); }
  double* data() { return doubles(lines_); }

  /// Velocities and constants of the bodies; accelerations are kept.
  void take(const Bodies<Y>& bodies) {
    lines_.resize((bodies.position.size() * S::size + 7) / 8);
    expected_.resize((bodies.position.size() * S::second_size + 7) / 8);
    for (int i = 0; i < bodies.grains(); ++i) {
      set(i, S::velocity, bodies.velocity[i]);
      if constexpr (Y.friction) set_spin(i, S::velocity, S::spin, bodies.spin[i]);
      set_constants(i, bodies);
    }
    for (const int i : bodies.rigid.member) hold(i);
  }

  /// Another order of the grains.
  void rearrange(const Permutation& step) {
    step.apply(data(), S::size);
    step.apply(expected(), S::second_size);
  }

  /// Writes the velocities back.
  void give(Bodies<Y>& bodies) const {
    for (int i = 0; i < bodies.grains(); ++i) {
      bodies.velocity[i] = velocity(i);
      if constexpr (Y.friction) bodies.spin[i] = spin(i);
    }
  }

  Vec<D> velocity(int i) const { return get(i, S::velocity); }
  Vec<D> acceleration(int i) const { return get(i, S::acceleration); }
  Spin<D> spin(int i) const requires(Y.friction) { return get_spin(i, S::velocity, S::spin); }
  Spin<D> turning(int i) const requires(Y.friction) { return get_spin(i, S::acceleration, S::turning); }

  /// Changes an acceleration after the closing kick of dt/2, and the velocity with it.
  void change(int i, const Vec<D>& change, double kick) {
    set(i, S::acceleration, acceleration(i) + change);
    set(i, S::expected, get(i, S::expected) + (1 + extrapolation) * change);
    set(i, S::velocity, velocity(i) + kick * change);
  }
  void change_turning(int i, const Spin<D>& change, double kick) requires(Y.friction) {
    set_spin(i, S::acceleration, S::turning, turning(i) + change);
    set_spin(i, S::expected, S::expected_turning,
             get_spin(i, S::expected, S::expected_turning) + (1 + extrapolation) * change);
    set_spin(i, S::velocity, S::spin, spin(i) + kick * change);
  }

  /// A grain of a rigid body: without mobility, and at rest, so that what the kernels make of it stays small.
  void hold(int i) {
    for (const int group : {S::velocity, S::acceleration, S::expected}) {
      set(i, group, Vec<D>::Zero());
      if constexpr (D == 2) at(i, group)[2] = 0;
    }
    if constexpr (Y.friction && D == 3)
      for (const int group : {S::spin, S::turning, S::expected_turning}) set(i, group, Vec<D>::Zero());
  }

  /// An acceleration that jumps, between steps: it is expected to stay.
  void shift(int i, const Vec<D>& jump) {
    set(i, S::acceleration, acceleration(i) + jump);
    set(i, S::expected, get(i, S::expected) + jump);
  }

  /// At the very start there is no step before: accelerations are expected to stay.
  void forget_before(int grains) {
    for (int i = 0; i < grains; ++i) {
      set(i, S::expected, acceleration(i));
      if constexpr (Y.friction) set_spin(i, S::expected, S::expected_turning, turning(i));
    }
  }

  void save(Archive& archive, int grains) const {
    put(archive, "md.acceleration", grains, S::acceleration, S::turning);
    put(archive, "md.acceleration_expected", grains, S::expected, S::expected_turning);
  }
  void restore(const Archive& archive, const Bodies<Y>& bodies) {
    take(bodies);
    get_back(archive, "md.acceleration", bodies.grains(), S::acceleration, S::turning);
    get_back(archive, "md.acceleration_expected", bodies.grains(), S::expected, S::expected_turning);
  }

 private:
  double* at(int i, int place) { return const_cast<double*>(std::as_const(*this).at(i, place)); }
  const double* at(int i, int place) const {
    const auto grain = static_cast<std::size_t>(i);
    if (place < S::size) return doubles(lines_) + grain * S::size + place;
    return doubles(expected_) + grain * S::second_size + (place - S::size);
  }
  void set_constants(int i, const Bodies<Y>& bodies) {
    double* state = at(i, 0);
    const bool free = bodies.rigid.free(i);
    // Only the sum of m v (x) v reads the mass.
    state[S::inverse_mass] = free ? 1 / bodies.mass[i] : 0, *at(i, S::mass) = free ? bodies.mass[i] : 0;
    if constexpr (D == 2) state[S::factors] = state[S::factors + 1] = state[S::inverse_mass];
    if constexpr (Y.friction) {
      const double radius = bodies.radius[i], inverse = free ? 1 / bodies.inertia[i] : 0;
      const double twist = free ? -radius / bodies.inertia[i] : 0;
      if constexpr (D == 2) {
        state[S::factors + 2] = twist, state[S::factors + 3] = inverse;
        state[S::record_factors] = radius, state[S::record_factors + 1] = 1;
      } else {
        state[S::twist_factor] = twist, state[S::inverse_inertia] = inverse, state[S::radius] = radius;
      }
    }
  }

  Vec<D> get(int i, int group) const { return Eigen::Map<const Vec<D>>(at(i, group)); }
  void set(int i, int group, const Vec<D>& value) { Eigen::Map<Vec<D>>(at(i, group)) = value; }
  /// In 2D the rotation is the third of the group of x and y, in 3D a group of its own.
  Spin<D> get_spin(int i, int linear, int angular) const {
    if constexpr (D == 2)
      return at(i, linear)[2];
    else
      return get(i, angular);
  }
  void set_spin(int i, int linear, int angular, const Spin<D>& value) {
    if constexpr (D == 2)
      at(i, linear)[2] = value;
    else
      set(i, angular, value);
  }
  void put(Archive& archive, const std::string& name, int grains, int linear, int angular) const {
    std::vector<double>&to = archive.reals[name + ".linear"], &turn = archive.reals[name + ".angular"];
    to.clear(), turn.clear();
    for (int i = 0; i < grains; ++i) {
      append(to, get(i, linear));
      if constexpr (Y.friction) append(turn, get_spin(i, linear, angular));
    }
    if (!Y.friction) archive.reals.erase(name + ".angular");
  }
  void get_back(const Archive& archive, const std::string& name, int grains, int linear, int angular) {
    std::vector<Vec<D>> from(grains);
    take_column(archive, name + ".linear", from);
    for (int i = 0; i < grains; ++i) set(i, linear, from[i]);
    if constexpr (Y.friction) {
      std::vector<Spin<D>> turn(grains, zero_spin<D>());
      take_column(archive, name + ".angular", turn);
      for (int i = 0; i < grains; ++i) set_spin(i, linear, angular, turn[i]);
    }
  }

  StepArray<Line> lines_, expected_;
};

}  // namespace galet::md
