// The usual scheme of soft-sphere codes (LAMMPS's among them), for one collision of two spheres: velocity Verlet,
//   v += dt/2 F/m,  x += dt v,  F(x, v),  v += dt/2 F/m
// with the velocities of the half step in dashpots and springs, springs by Euler's rule (q += u_T dt), projected on the
// tangent plane, and returned radially to Coulomb's limit. Laws, signs and lever arms are md's (common/core/
// conventions.hpp), so that both converge to the same motion. Written independently of the engine.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "common/core/types.hpp"
#include "common/scene/pair_law.hpp"

namespace galet::bench {

/// Two spheres of radius 1/2 and mass 1.
struct TwoSpheres {
  std::array<Vec<3>, 2> position, velocity, spin;
};

class UsualScheme {
 public:
  UsualScheme(const PairLaw& law, const TwoSpheres& start, double dt) : law_(law), state_(start), dt_(dt) {
    evaluate(0);
  }

  void advance(long steps) {
    for (long k = 0; k < steps; ++k) {
      kick();
      for (int a : {0, 1}) state_.position[a] += dt_ * state_.velocity[a];
      evaluate(dt_);
      kick();
    }
  }
  const TwoSpheres& state() const { return state_; }

 private:
  static constexpr double radius = 0.5, inertia = 0.4 * radius * radius, reduced_mass = 0.5;

  void kick() {
    state_.velocity[0] -= dt_ / 2 * force_;
    state_.velocity[1] += dt_ / 2 * force_;
    // The same torque on both: lever arms are equal.
    for (Vec<3>& spin : state_.spin) spin += dt_ / 2 / inertia * torque_;
  }

  /// Forces at the positions and velocities that stand; the spring follows them for `dt`.
  void evaluate(double dt) {
    const Vec<3> branch = state_.position[1] - state_.position[0];
    const double distance = branch.norm(), deflection = 2 * radius - distance;
    if (deflection <= 0) {
      force_.setZero(), torque_.setZero(), spring_.setZero();
      stiffness_ = 0;
      return;
    }
    const Vec<3> n = branch / distance;
    const double lever = distance / 2;
    const Vec<3> u = state_.velocity[1] - state_.velocity[0] - lever * (state_.spin[0] + state_.spin[1]).cross(n);
    const double opening = u.dot(n);
    const bool hertz = law_.normal_law == NormalLaw::hertz;
    const double k = hertz ? 4.0 / 3 * law_.stiffness * std::sqrt(radius / 2) : law_.stiffness;
    const double elastic = hertz ? k * deflection * std::sqrt(deflection) : k * deflection;
    const double stiffness = hertz ? 1.5 * k * std::sqrt(deflection) : k;
    double normal = elastic - law_.damping_ratio * 2 * std::sqrt(reduced_mass * stiffness) * opening;
    double bound = elastic;
    if (law_.convention == DampingConvention::total) bound = normal = std::max(0.0, normal);
    const double tangential = law_.tangential_ratio * stiffness;
    // The force is kept while K_T grows, the elongation while it falls.
    if (stiffness_ > 0 && tangential > stiffness_) spring_ *= stiffness_ / tangential;
    stiffness_ = tangential;
    spring_ += dt * (u - opening * n);
    spring_ -= spring_.dot(n) * n;
    const double limit = law_.friction * bound;
    if (tangential * spring_.norm() > limit) spring_ *= limit / (tangential * spring_.norm());
    force_ = normal * n - tangential * spring_;
    torque_ = -lever * n.cross(force_);
  }

  PairLaw law_;
  TwoSpheres state_;
  double dt_;
  double stiffness_ = 0;  ///< K_T of the last evaluation, 0 without contact
  Vec<3> spring_ = Vec<3>::Zero(), force_ = Vec<3>::Zero(), torque_ = Vec<3>::Zero();
};

}  // namespace galet::bench
