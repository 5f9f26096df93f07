// A rigid body: what moves, turns and is moved when grains are glued together (clumps, rough walls and cylinders).
//
//   M dV/dt = F along its free directions; V given along the others
//   dJ/dt = T with J = I w                      free rotation
//   (e.I e) dw/dt = e.T,  w along e             about a fixed axis e (disks: the only one there is)
//   w given                                     imposed rotation
//
// The orientation q takes vectors of the body's frame to the fixed one; in 3D the body's frame is that of its principal
// axes, so that I is the three moments. A grain of the body is at c + q(offset), moves with V + w x q(offset) and turns
// with w.
//
// Free rotation over a time step without torque, in 3D: J stays, and the energy m.m / (2 I) (m: J in the body's frame)
// is split as m^2 / (2 I_2) + (1/I_1 - 1/I_2) m_1^2 / 2 + (1/I_3 - 1/I_2) m_3^2 / 2, I_2 the middle moment. The first
// part turns the body about J and commutes with the others; each of these turns it about its own axis; they alternate
// symmetrically (1, 3, 1). So J is kept to the last bit; symmetric tops move exactly; other bodies to second order,
// with an error of the energy that does not grow. Source: Dullweber, Leimkuhler and McLachlan 1997, with a split of our
// own. Units: those of the scene. Cost: a few rotations per step and body.
#pragma once

#include <cmath>

#include "common/core/types.hpp"

namespace galet {

/// How the orientation of a body changes. about_axis: 3D only; free is about the only axis in 2D.
enum class Turning { imposed, about_axis, free };

/// An orientation: the angle in 2D, a unit quaternion in 3D.
template <int D>
struct OrientationOf;
template <>
struct OrientationOf<2> {
  using type = double;
  static type none() { return 0; }
};
template <>
struct OrientationOf<3> {
  using type = Eigen::Quaterniond;
  static type none() { return Eigen::Quaterniond::Identity(); }
};

/// An orientation as plain numbers, and back.
inline double numbers_of(double orientation) { return orientation; }
inline Eigen::Vector4d numbers_of(const Eigen::Quaterniond& orientation) { return orientation.coeffs(); }
inline void set_orientation(double numbers, double& orientation) { orientation = numbers; }
inline void set_orientation(const Eigen::Vector4d& numbers, Eigen::Quaterniond& orientation) {
  orientation.coeffs() = numbers;
}

/// A linear map of spins: a number in 2D, a matrix in 3D.
template <int D>
struct SpinMapOf;
template <>
struct SpinMapOf<2> {
  using type = double;
};
template <>
struct SpinMapOf<3> {
  using type = Mat<3>;
};
template <int D>
using SpinMap = typename SpinMapOf<D>::type;

inline bool is_zero(double map) { return map == 0; }
inline bool is_zero(const Mat<3>& map) { return map.isZero(0); }

template <int D>
inline SpinMap<D> zero_map() {
  if constexpr (D == 2)
    return 0.0;
  else
    return Mat<3>::Zero();
}

template <int D>
struct RigidBody {
  Vec<D> centre = Vec<D>::Zero();  ///< c, of mass where the body is free
  Vec<D> velocity = Vec<D>::Zero();
  typename OrientationOf<D>::type orientation = OrientationOf<D>::none();
  Spin<D> spin = zero_spin<D>();      ///< w
  Spin<D> momentum = zero_spin<D>();  ///< J, kept up in free rotation in 3D only; w follows from it there

  // What does not change.
  double mass = 1;
  Spin<D> moments = one_spin();      ///< of inertia about c, principal ones in 3D
  Mat<D> mobility = Mat<D>::Zero();  ///< 1 / mass along the free directions, 0 across them
  Turning turning = Turning::imposed;
  Vec<D> axis = Vec<D>::Unit(D - 1);  ///< about_axis: e
  Vec<D> force = Vec<D>::Zero();      ///< external, along free directions
  Spin<D> torque = zero_spin<D>();    ///< external, likewise
  bool turns = false;                 ///< whether it ever turns (freely, or with an imposed spin)

  /// Whether J and not w is what torques change.
  bool has_momentum() const { return D == 3 && turning == Turning::free; }

 private:
  static Spin<D> one_spin() {
    if constexpr (D == 2)
      return 1.0;
    else
      return Vec<3>::Ones();
  }
};

/// The matrix that takes vectors of the body's frame to the fixed one.
template <int D>
inline Mat<D> rotation_of(const RigidBody<D>& body) {
  if constexpr (D == 2) {
    const double cosine = std::cos(body.orientation), sine = std::sin(body.orientation);
    return (Mat<2>() << cosine, -sine, sine, cosine).finished();
  } else {
    return body.orientation.toRotationMatrix();
  }
}

/// I w in the fixed frame.
template <int D>
inline Spin<D> angular_momentum(const RigidBody<D>& body, const Spin<D>& spin) {
  if constexpr (D == 2) {
    return body.moments * spin;
  } else {
    const Mat<3> rotation = rotation_of(body);
    return rotation * body.moments.cwiseProduct(rotation.transpose() * spin);
  }
}
template <int D>
inline Spin<D> angular_momentum(const RigidBody<D>& body) {
  return angular_momentum<D>(body, body.spin);
}

/// Sets w from J where J is what is kept.
template <int D>
inline void update_spin(RigidBody<D>& body) {
  if constexpr (D == 3) {
    if (!body.has_momentum()) return;
    const Mat<3> rotation = rotation_of(body);
    body.spin = rotation * (rotation.transpose() * body.momentum).cwiseQuotient(body.moments);
  }
}

/// A of dw = A times the impulse of a torque; zero where rotation is imposed.
template <int D>
inline SpinMap<D> turning_mobility(const RigidBody<D>& body) {
  if (body.turning == Turning::imposed) return zero_map<D>();
  if constexpr (D == 2) {
    return 1 / body.moments;
  } else {
    const Mat<3> rotation = rotation_of(body);
    if (body.turning == Turning::about_axis) {
      const Vec<3> axis = rotation.transpose() * body.axis;
      return body.axis * body.axis.transpose() / axis.dot(body.moments.cwiseProduct(axis));
    }
    return rotation * body.moments.cwiseInverse().asDiagonal() * rotation.transpose();
  }
}

/// Rate of change under a torque of what is kept: J in free rotation in 3D, else w.
template <int D>
inline Spin<D> turning_rate(const RigidBody<D>& body, const Spin<D>& torque) {
  if (body.has_momentum()) return torque;
  return turning_mobility(body) * torque;
}

/// Adds `change` to what is kept: the time integral of turning_rate.
template <int D>
inline void change_turning(RigidBody<D>& body, const Spin<D>& change) {
  if (body.has_momentum()) {
    body.momentum += change;
    update_spin(body);
  } else {
    body.spin += change;
  }
}

/// The orientation after a rotation by the vector `angle` of the fixed frame.
inline double turned(double orientation, double angle) { return orientation + angle; }
inline Eigen::Quaterniond turned(const Eigen::Quaterniond& orientation, const Vec<3>& angle) {
  const double norm = angle.norm();
  if (norm == 0) return orientation;
  return (Eigen::Quaterniond(Eigen::AngleAxisd(norm, angle / norm)) * orientation).normalized();
}

/// The orientation after a time dt without torque, for the momentum J.
inline Eigen::Quaterniond freely_turned(const Eigen::Quaterniond& orientation, const Vec<3>& moments,
                                        const Vec<3>& momentum, double dt) {
  int middle = 0;
  for (const int k : {1, 2}) {
    const int a = (k + 1) % 3, b = (k + 2) % 3;
    if ((moments[k] - moments[a]) * (moments[k] - moments[b]) <= 0) middle = k;
  }
  const double reference = 1 / moments[middle];
  Eigen::Quaterniond result = turned(orientation, Vec<3>(dt * reference * momentum));
  const auto about = [&](int k, double time) {
    const double own = (result.conjugate() * momentum)[k];
    const double angle = time * (1 / moments[k] - reference) * own;
    result = result * Eigen::Quaterniond(Eigen::AngleAxisd(angle, Vec<3>::Unit(k)));
  };
  const int first = (middle + 1) % 3, other = (middle + 2) % 3;
  about(first, 0.5 * dt), about(other, dt), about(first, 0.5 * dt);
  return result.normalized();
}

/// Moves and turns a body for a time dt without forces: with the velocity V, and the spin w or the momentum J.
template <int D>
inline void drift(RigidBody<D>& body, const Vec<D>& velocity, const Spin<D>& spin, const Spin<D>& momentum, double dt) {
  body.centre += dt * velocity;
  if (!body.turns) return;
  if constexpr (D == 3) {
    if (body.has_momentum()) {
      body.orientation = freely_turned(body.orientation, body.moments, momentum, dt);
      return update_spin(body);
    }
  }
  body.orientation = turned(body.orientation, Spin<D>(dt * spin));
}

}  // namespace galet
