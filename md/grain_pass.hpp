// Grain pass and drift of the md step: everything that is done per grain.
//
// Time scheme (velocity Verlet with predicted velocities, second order for smooth forces). Between steps the state is
// (x, v, a) at one time, a = F/m + gravity - L v. One step:
//   drift   v_half = v + dt/2 a;  x' = F x + dt A v_half;  contacts see v_half + dt/2 (a + (a - a_before)/2)
//           with A = (1 - dt/2 L)^-1 and F = A (1 + dt/2 L): the same map moves grains and box, so that images stay
//           images to rounding
//   gather  a' from the contact rows, in a fixed order (rows as second member, then as first); v' = v_half + dt/2 a'
// Rotations likewise, without the cell.
//
// Why the acceleration is extrapolated: springs that never slide integrate the velocities that contacts see. With the
// plain prediction v_half + dt/2 a an undamped spring of frequency w gains amplitude, (w dt)^4 / 8 a step, and nothing
// else damps the spins of stuck grains. With a share c of the extrapolation it gains (1 - 3 c) (w dt)^4 / 8: a loss of
// (w dt)^4 / 16 for c = 1/2, which also halves the error of the velocities that the dashpots see.
#pragma once

#include "common/core/parallel.hpp"
#include "common/engine/bodies.hpp"
#include "common/neighbour/verlet_list.hpp"
#include "md/contact_pass.hpp"
#include "md/contacts.hpp"

namespace galet::md {

/// Accelerations at the time of the state: the part of the state that the bodies do not hold.
template <Layout Y>
struct Accelerations {
  Column<Vec<Y.dim>> linear;
  Column<Spin<Y.dim>, Y.friction> angular;
  std::vector<double> modes;  ///< of the cell's rates; zero for rate-driven modes

  void save(Archive& archive, const std::string& name) const {
    put_column(archive, name + ".linear", linear);
    if constexpr (Y.friction) put_column(archive, name + ".angular", angular);
    archive.reals[name + ".modes"] = modes;
  }
  void restore(const Archive& archive, const std::string& name) {
    take_column(archive, name + ".linear", linear);
    if constexpr (Y.friction) take_column(archive, name + ".angular", angular);
    take_column(archive, name + ".modes", modes);
  }
};

/// Share c of the last change of acceleration that velocities seen by contacts are extrapolated with.
constexpr double kExtrapolation = 0.5;

/// The acceleration expected for the step to come; keeps the present one as `before`.
template <class Value>
Value expected(const Value& now, Value& before) {
  const Value change = now - before;
  before = now;
  return now + kExtrapolation * change;
}

/// First half of the step. On return the bodies hold v_half and the new positions, `seen` the predicted velocities, and
/// `before` the present accelerations.
template <Layout Y>
void drift(Bodies<Y>& bodies, const Accelerations<Y>& acceleration, Accelerations<Y>& before, Seen<Y>& seen,
           double dt) {
  constexpr int D = Y.dim;
  const Mat<D> identity = Mat<D>::Identity();
  const Mat<D> gradient = bodies.cell.rate;  // L at the half step
  const Mat<D> advance = (identity - 0.5 * dt * gradient).inverse();
  const Mat<D> deform = advance * (identity + 0.5 * dt * gradient);
  const Mat<D> step = dt * advance;
  const bool still = gradient.isZero(0);
  parallel_ranges(bodies.position.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Vec<D> half = bodies.velocity[i] + 0.5 * dt * acceleration.linear[i];
      if (still)
        bodies.position[i] += dt * half;
      else
        bodies.position[i] = deform * bodies.position[i] + step * half;
      bodies.velocity[i] = half;
      const int grain = static_cast<int>(i);
      seen.grains.put_position(grain, bodies.position[i]);
      seen.grains.put_velocity(grain, half + 0.5 * dt * expected(acceleration.linear[i], before.linear[i]));
      if constexpr (Y.friction) {
        bodies.spin[i] += 0.5 * dt * acceleration.angular[i];
        const Spin<D> spin = bodies.spin[i] + 0.5 * dt * expected(acceleration.angular[i], before.angular[i]);
        seen.grains.put_spin(grain, spin, bodies.radius[i]);
      }
    }
  });
  if (!still) bodies.cell.box = deform * bodies.cell.box;
  for (Plane<D>& plane : bodies.planes) plane.point += dt * plane.velocity;
}

/// Accelerations from the contact rows, and the second half of the kick (`kick_dt` = dt/2; 0 at the very start).
template <Layout Y>
void gather(Bodies<Y>& bodies, const Seen<Y>& seen, const VerletList<Y.dim>& list, const Contacts<Y>& contacts,
            Accelerations<Y>& acceleration, double kick_dt) {
  constexpr int D = Y.dim;
  const auto first = list.first(), second = list.second(), rows_of_second = list.rows_of_second();
  parallel_ranges(bodies.position.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      Vec<D> force = Vec<D>::Zero();
      Spin<D> twist = zero_spin<D>(), torque = zero_spin<D>();
      for (int k = second[i]; k < second[i + 1]; ++k) {
        force += contacts.force(rows_of_second[k]);
        if constexpr (Y.friction) twist += contacts.twist(rows_of_second[k]);
        if constexpr (Y.rolling) torque += contacts.torque(rows_of_second[k]);
      }
      for (int row = first[i]; row < first[i + 1]; ++row) {
        force -= contacts.force(row);
        if constexpr (Y.friction) twist += contacts.twist(row);
        if constexpr (Y.rolling) torque -= contacts.torque(row);
      }
      acceleration.linear[i] =
          force / bodies.mass[i] + bodies.gravity - seen.gradient * seen.grains.velocity(static_cast<int>(i));
      bodies.velocity[i] += kick_dt * acceleration.linear[i];
      if constexpr (Y.friction) {
        acceleration.angular[i] = -bodies.radius[i] / bodies.inertia[i] * twist;
        if constexpr (Y.rolling) acceleration.angular[i] += torque / bodies.inertia[i];
        bodies.spin[i] += kick_dt * acceleration.angular[i];
      }
    }
  });
}

/// Ways to an equilibrium that break the balance of momentum.
struct Relaxers {
  double drag = 0;  ///< force -drag m v on each grain, torque -drag I w
  double acceleration_damping =
      0;  ///< c: forces count 1 - c times where they speed a grain up, 1 + c where they slow it
  bool on() const { return drag > 0 || acceleration_damping > 0; }
};

/// What the relaxers make of an acceleration.
template <class Vector>
Vector relaxed(const Relaxers& relaxers, const Vector& acceleration, const Vector& velocity, double speeding_up) {
  const double weight = 1 - relaxers.acceleration_damping * (speeding_up > 0 ? 1 : speeding_up < 0 ? -1 : 0);
  return weight * acceleration - relaxers.drag * velocity;
}

/// Applies them after `gather`; returns the power that they take, by chunks in a fixed order.
template <Layout Y>
double relax(Bodies<Y>& bodies, const Seen<Y>& seen, const Relaxers& relaxers, Accelerations<Y>& acceleration,
             double kick_dt, std::vector<double>& partial) {
  partial.assign(chunk_count(bodies.position.size()), 0.0);
  parallel_chunks(bodies.position.size(), [&](std::size_t chunk, std::size_t begin, std::size_t end) {
    double power = 0;
    for (std::size_t i = begin; i < end; ++i) {
      const Vec<Y.dim> before = acceleration.linear[i], velocity = seen.grains.velocity(static_cast<int>(i));
      acceleration.linear[i] = relaxed(relaxers, before, velocity, before.dot(velocity));
      const Vec<Y.dim> change = acceleration.linear[i] - before;
      bodies.velocity[i] += kick_dt * change;
      power -= bodies.mass[i] * change.dot(velocity);
      if constexpr (Y.friction) {
        const Spin<Y.dim> turn = acceleration.angular[i], spin = seen.grains.spin(static_cast<int>(i));
        acceleration.angular[i] = relaxed(relaxers, turn, spin, dot(turn, spin));
        const Spin<Y.dim> turn_change = acceleration.angular[i] - turn;
        bodies.spin[i] += kick_dt * turn_change;
        power -= bodies.inertia[i] * dot(turn_change, spin);
      }
    }
    partial[chunk] = power;
  });
  double total = 0;
  for (const double part : partial) total += part;
  return total;
}

/// Sum over the grains of m v (x) v, by chunks (the same bits for any number of threads).
template <Layout Y>
Mat<Y.dim> kinetic_virial(const Bodies<Y>& bodies, std::vector<Mat<Y.dim>>& partial) {
  constexpr int D = Y.dim;
  partial.assign(chunk_count(bodies.position.size()), Mat<D>::Zero());
  parallel_chunks(bodies.position.size(), [&](std::size_t chunk, std::size_t begin, std::size_t end) {
    Mat<D> sum = Mat<D>::Zero();
    for (std::size_t i = begin; i < end; ++i)
      sum += bodies.mass[i] * bodies.velocity[i] * bodies.velocity[i].transpose();
    partial[chunk] = sum;
  });
  Mat<D> total = Mat<D>::Zero();
  for (const Mat<D>& part : partial) total += part;
  return total;
}

}  // namespace galet::md
