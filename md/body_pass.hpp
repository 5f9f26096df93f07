// Rigid bodies in the md step, with the scheme of the grains (md/grain_pass.hpp): kick, drift, kick.
//
//   drift   V_half = V + dt/2 a,  c' = c + dt V_half;  J_half = J + dt/2 T, then a free rotation for dt with J_half
//           (geometry/rigid_body.hpp; a body with one axis: w_half = w + dt/2 dw/dt in place of J);
//           contacts see the grains at c' + arm, with V and w predicted as for grains
//   gather  F = sum of the contact forces on the body's grains, T = sum of arm x F - R twist + torque; kick
//
// F and T are summed over the grains in ascending order and over each grain's rows in the order of the list. Kicks
// change momentum and angular momentum by what the contacts give, and drifts change neither: both are conserved to
// rounding, as for grains. Second order in dt. A body's grains take no part in the grains' own motion: the kernels
// find them without mobility, and what they leave there is put back to rest.
// Cost: one visit of each grain of a body and its rows.
#pragma once

#include <string>
#include <vector>

#include "common/core/archive_columns.hpp"
#include "common/core/parallel.hpp"
#include "common/engine/bodies.hpp"
#include "common/neighbour/verlet_list.hpp"
#include "md/contacts.hpp"
#include "md/grain_pass.hpp"
#include "md/grain_records.hpp"
#include "md/grain_states.hpp"

namespace galet::md {

template <Layout Y>
class BodyPass {
 public:
  static constexpr int D = Y.dim;

  void start(const Bodies<Y>& bodies) { motion_.assign(bodies.rigid.body.size(), {}); }
  std::size_t bytes() const { return bytes_of(motion_); }

  /// First half of the step. Returns the largest distance that a grain of a body has moved, over dt.
  double drift(Bodies<Y>& bodies, GrainStates<Y>& states, Seen<Y>& seen, double dt) {
    const std::size_t count = bodies.rigid.body.size();
    const Mat<D> inverse = bodies.cell.box.inverse();
    refill(partial_, chunk_count(count), 0.0);
    parallel_chunks(count, [&](std::size_t chunk, std::size_t begin, std::size_t end) {
      for (std::size_t b = begin; b < end; ++b)
        partial_[chunk] = std::max(partial_[chunk], drift_body(bodies, states, seen, inverse, b, dt));
    });
    double farthest = 0;
    for (const double part : partial_) farthest = std::max(farthest, part);
    return farthest / dt;
  }

  /// Accelerations from the contact rows, and the second half of the kick (`kick` = dt/2; 0 at the very start).
  void gather(Bodies<Y>& bodies, GrainStates<Y>& states, const VerletList<D>& list, const Contacts<Y>& contacts,
              double kick) {
    parallel_ranges(
        bodies.rigid.body.size(),
        [&](std::size_t begin, std::size_t end) {
          for (std::size_t b = begin; b < end; ++b) gather_body(bodies, states, list, contacts, b, kick);
        },
        64);
  }

  /// At the very start there is no step before: accelerations are expected to stay.
  void forget_before() {
    for (Motion& motion : motion_) motion.expected = motion.acceleration, motion.turning_expected = motion.turning;
  }

  /// Sum of the contact forces on all bodies.
  Vec<D> contact_force() const {
    Vec<D> sum = Vec<D>::Zero();
    for (const Motion& motion : motion_) sum += motion.force;
    return sum;
  }

  /// Power of what drives the bodies: external forces and torques, and what holds imposed motions.
  double drive_power(const Bodies<Y>& bodies) const {
    double power = 0;
    for (std::size_t b = 0; b < motion_.size(); ++b) {
      const RigidBody<D>& body = bodies.rigid.body[b];
      const Motion& motion = motion_[b];
      // What acts besides contacts and gravity is M a - F - M g and dJ/dt - T.
      power += (body.mass * (motion.acceleration - bodies.gravity) - motion.force).dot(body.velocity);
      power += dot(body.spin, body.turning == Turning::imposed ? Spin<D>(-motion.torque) : body.torque);
    }
    return power;
  }

  void save(Archive& archive) const {
    std::vector<double>& column = archive.reals["md.bodies"];
    column.clear();
    for (const Motion& motion : motion_) {
      append(column, motion.acceleration), append(column, motion.expected);
      append(column, motion.turning), append(column, motion.turning_expected);
      append(column, motion.force), append(column, motion.torque);
    }
  }
  void restore(const Archive& archive) {
    std::vector<double> column((3 * components<Vec<D>> + 3 * components<Spin<D>>)*motion_.size());
    take_column(archive, "md.bodies", column);
    const double* from = column.data();
    for (Motion& motion : motion_) {
      from = extract(from, motion.acceleration), from = extract(from, motion.expected);
      from = extract(from, motion.turning), from = extract(from, motion.turning_expected);
      from = extract(from, motion.force), from = extract(from, motion.torque);
    }
  }

 private:
  /// `turning`: rate of J in free rotation in 3D, else of w. `expected`: for the next step.
  struct Motion {
    Vec<D> acceleration = Vec<D>::Zero(), expected = Vec<D>::Zero();
    Spin<D> turning = zero_spin<D>(), turning_expected = zero_spin<D>();
    Vec<D> force = Vec<D>::Zero();  ///< of the contacts
    Spin<D> torque = zero_spin<D>();
  };

  double drift_body(Bodies<Y>& bodies, GrainStates<Y>& states, Seen<Y>& seen, const Mat<D>& inverse, std::size_t b,
                    double dt) {
    RigidBody<D>& body = bodies.rigid.body[b];
    const Motion& motion = motion_[b];
    const Vec<D> before = body.centre;
    body.velocity += 0.5 * dt * motion.acceleration;
    change_turning(body, Spin<D>(0.5 * dt * motion.turning));
    galet::drift(body, body.velocity, body.spin, body.momentum, dt);
    const Vec<D> moved = body.centre - before;
    if (bodies.cell.any_periodic()) body.centre = wrapped_position<D>(bodies.cell, inverse, body.centre);
    RigidBody<D> expected = body;
    expected.velocity += 0.5 * dt * motion.expected;
    change_turning(expected, Spin<D>(0.5 * dt * motion.turning_expected));
    const Mat<D> rotation = rotation_of(body);
    double farthest = 0;
    for (int k = bodies.rigid.first[b]; k < bodies.rigid.first[b + 1]; ++k) {
      const int i = bodies.rigid.member[k];
      const Vec<D> arm = rotation * bodies.rigid.offset[i];
      farthest = std::max(farthest, (moved + arm - bodies.arm[i]).squaredNorm());
      bodies.arm[i] = arm;
      seen.grains.put_position(i,
                               image_near<D>(bodies.cell, inverse, Vec<D>(body.centre + arm), seen.grains.position(i)));
      seen.grains.put_velocity(i, expected.velocity + cross(expected.spin, arm));
      if constexpr (Y.friction) seen.grains.put_spin(i, expected.spin, bodies.radius[i]);
      states.hold(i);
    }
    return std::sqrt(farthest);
  }

  void gather_body(Bodies<Y>& bodies, GrainStates<Y>& states, const VerletList<D>& list, const Contacts<Y>& contacts,
                   std::size_t b, double kick) {
    RigidBody<D>& body = bodies.rigid.body[b];
    Motion& motion = motion_[b];
    motion.force.setZero(), motion.torque = zero_spin<D>();
    for (int k = bodies.rigid.first[b]; k < bodies.rigid.first[b + 1]; ++k) {
      const int i = bodies.rigid.member[k];
      add_rows(bodies, list, contacts, i, motion);
      states.hold(i);
    }
    const Vec<D> force = motion.force + body.force + body.mass * bodies.gravity;
    const Vec<D> acceleration = body.mobility * force;
    const Spin<D> turning = turning_rate(body, Spin<D>(motion.torque + body.torque));
    motion.expected = acceleration + extrapolation * (acceleration - motion.acceleration);
    motion.turning_expected = turning + extrapolation * (turning - motion.turning);
    motion.acceleration = acceleration, motion.turning = turning;
    body.velocity += kick * acceleration;
    change_turning(body, Spin<D>(kick * turning));
  }

  /// Force and torque of a grain's contacts on its body.
  void add_rows(const Bodies<Y>& bodies, const VerletList<D>& list, const Contacts<Y>& contacts, int i,
                Motion& motion) const {
    Vec<D> force = Vec<D>::Zero();
    Spin<D> twist = zero_spin<D>(), torque = zero_spin<D>();
    const auto add = [&](std::size_t row, double sign) {
      force += sign * contacts.force(row);
      if constexpr (Y.friction) twist += contacts.twist(row);
      if constexpr (Y.rolling) torque += sign * contacts.torque(row);
    };
    for (int k = list.second()[i]; k < list.second()[i + 1]; ++k) add(list.rows_of_second()[k], 1);
    for (int row = list.first()[i]; row < list.first()[i + 1]; ++row) add(row, -1);
    motion.force += force;
    motion.torque += cross(bodies.arm[i], force) - bodies.radius[i] * twist + torque;
  }

  std::vector<Motion> motion_;
  std::vector<double> partial_;
};

}  // namespace galet::md
