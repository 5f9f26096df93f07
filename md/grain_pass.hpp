// Grain pass of the md step: everything that is done per grain. The loops are kernels (kernel/grains.hpp).
//
// Time scheme (velocity Verlet with predicted velocities, second order for smooth forces). Between steps the state is
// (x, v, a) at one time, a = F/m + gravity - L v. One step:
//   drift   v_half = v + dt/2 a;  x' = F x + dt A v_half;  contacts see v_half + dt/2 (a + (a - a_before)/2)
//           with A = (1 - dt/2 L)^-1 and F = A (1 + dt/2 L): the same map moves grains and box, so that images stay
//           images to rounding
//   gather  a' from the contact rows, in a fixed order (rows as second member less rows as first);
//           v' = v_half + dt/2 a'
// The gather of one step and the drift of the next are one loop where nothing comes between them (a cell driven by
// stress moves with the sum over all grains), right behind the contacts (md/sweep.hpp). Rotations likewise, without the
// cell.
//
// Why the acceleration is extrapolated: springs that never slide integrate the velocities that contacts see. With the
// plain prediction v_half + dt/2 a an undamped spring of frequency w gains amplitude, (w dt)^4 / 8 a step, and nothing
// else damps the spins of stuck grains. With a share c of the extrapolation it gains (1 - 3 c) (w dt)^4 / 8: a loss of
// (w dt)^4 / 16 for c = 1/2, which also halves the error of the velocities that the dashpots see.
#pragma once

#include "common/core/parallel.hpp"
#include "common/engine/bodies.hpp"
#include "common/neighbour/verlet_list.hpp"
#include "md/contacts.hpp"
#include "md/grain_records.hpp"
#include "md/grain_states.hpp"
#include "md/kernel/dispatch.hpp"

namespace galet::md {

/// A and F of a step in which the cell moves with L.
template <int D>
struct CellStep {
  Mat<D> advance, deform;
  CellStep(const Mat<D>& gradient, double dt) {
    const Mat<D> identity = Mat<D>::Identity();
    advance = (identity - 0.5 * dt * gradient).inverse();
    deform = advance * (identity + 0.5 * dt * gradient);
  }
};

/// The acceleration expected for the step to come; keeps the present one as `before`.
inline double expected(double now, double& before) {
  const double change = now - before;
  before = now;
  return now + extrapolation * change;
}

template <Layout Y>
class GrainPass {
 public:
  static constexpr int D = Y.dim;

  explicit GrainPass(Instructions set) : functions_(grain_functions<Y>(set)) {}

  /// First half of the step. On return the states hold v_half, the records new positions and what contacts see. Returns
  /// a bound of the grains' half-step velocity.
  double drift(Bodies<Y>& bodies, GrainStates<Y>& states, Seen<Y>& seen, double dt) {
    GrainView view = view_of(bodies, states, seen);
    const Mat<D> deform = set_drift(view, bodies.cell.rate, dt);
    refill(partial_, chunk_count(view.count), Columns{});
    parallel_chunks(view.count, [&](std::size_t chunk, std::size_t begin, std::size_t end) {
      functions_.drift(view, begin, end, partial_[chunk].column[0]);
    });
    move_boundaries(bodies, deform, dt);
    return fastest();
  }

  /// The end of one step and the first half of the next, for a cell whose rate does not change: `sweep` calls
  /// grains(part, begin, end), part < parts, once for each grain when all of its rows are there. Returns as drift.
  template <class Sweep>
  double step(Bodies<Y>& bodies, GrainStates<Y>& states, Seen<Y>& seen, const VerletList<D>& list,
              const Contacts<Y>& contacts, double dt, std::size_t parts, const Sweep& sweep) {
    GrainView view = view_of(bodies, states, seen);
    set_gather(view, bodies, seen, list, contacts, 0.5 * dt);
    const Mat<D> deform = set_drift(view, bodies.cell.rate, dt);
    refill(partial_, parts, Columns{});
    sweep([&](std::size_t part, std::size_t begin, std::size_t end) {
      functions_.step(view, begin, end, partial_[part].column[0]);
    });
    move_boundaries(bodies, deform, dt);
    return fastest();
  }

  /// Accelerations from the contact rows, and the second half of the kick (`kick` = dt/2; 0 at the very start). Returns
  /// the sum of m v (x) v if it is wanted, by chunks (the same bits for any number of threads).
  Mat<D> gather(Bodies<Y>& bodies, GrainStates<Y>& states, Seen<Y>& seen, const VerletList<D>& list,
                const Contacts<Y>& contacts, double kick, bool kinetic) {
    GrainView view = view_of(bodies, states, seen);
    set_gather(view, bodies, seen, list, contacts, kick);
    view.kinetic = kinetic;
    refill(partial_, chunk_count(bodies.position.size()), Columns{});
    parallel_chunks(bodies.position.size(), [&](std::size_t chunk, std::size_t begin, std::size_t end) {
      functions_.gather(view, begin, end, partial_[chunk].column);
    });
    Mat<D> total = Mat<D>::Zero();
    if (kinetic)
      for (const Columns& part : partial_)
        for (int a = 0; a < D; ++a)
          for (int b = 0; b < D; ++b) total(a, b) += part.column[b][a];
    return total;
  }

 private:
  struct alignas(32) Columns {
    double column[3][4] = {};
  };

  static void fill(GrainView& view, double (&columns)[3][4], const Mat<D>& matrix) {
    for (int b = 0; b < D; ++b) {
      for (int a = 0; a < D; ++a) columns[b][a] = matrix(a, b);
      if (!matrix.col(b).isZero(0)) view.columns_used |= 1u << b;
    }
  }

  GrainView view_of(Bodies<Y>& bodies, GrainStates<Y>& states, Seen<Y>& seen) const {
    GrainView view{};
    view.records = seen.grains.data();
    view.state = states.data();
    view.expected = states.expected();
    view.count = bodies.position.size();
    return view;
  }

  static void set_gather(GrainView& view, const Bodies<Y>& bodies, const Seen<Y>& seen, const VerletList<D>& list,
                         const Contacts<Y>& contacts, double kick) {
    fill(view, view.gradient, seen.gradient);
    for (int a = 0; a < D; ++a) view.gravity[a] = bodies.gravity[a];
    view.out = contacts.out();
    view.slots = contacts.slots();
    view.first = list.first().data(), view.second = list.second().data();
    view.rows_of_second = list.rows_of_second().data();
    view.kick = kick;
  }

  /// Returns the map that moves the box.
  static Mat<D> set_drift(GrainView& view, const Mat<D>& gradient, double dt) {
    const CellStep<D> step(gradient, dt);
    fill(view, view.deform, step.deform - Mat<D>::Identity());
    fill(view, view.step, dt * (step.advance - Mat<D>::Identity()));
    view.half = 0.5 * dt;
    return step.deform;
  }

  static void move_boundaries(Bodies<Y>& bodies, const Mat<D>& deform, double dt) {
    if (!bodies.cell.rate.isZero(0)) {
      bodies.cell.box = deform * bodies.cell.box;
      bodies.cell.strain += dt * bodies.cell.rate;
    }
    for (Plane<D>& plane : bodies.planes) plane.point += dt * plane.velocity;
  }

  /// Norm of the largest half-step velocities of any part, component by component.
  double fastest() const {
    double largest[D] = {}, sum = 0;
    for (const Columns& part : partial_)
      for (int a = 0; a < D; ++a) largest[a] = std::max(largest[a], part.column[0][a]);
    for (const double square : largest) sum += square;
    return std::sqrt(sum);
  }

  GrainFunctions functions_;
  std::vector<Columns> partial_;
};

/// Ways to an equilibrium that break the balance of momentum.
struct Relaxers {
  double drag = 0;  ///< force -drag m v on each grain, torque -drag I w
  double acceleration_damping =
      0;  ///< c: forces count 1 - c times where they speed a grain up, 1 + c where they slow it
  bool on() const { return drag > 0 || acceleration_damping > 0; }
};

/// What the relaxers change of an acceleration.
template <class Vector>
Vector relaxation(const Relaxers& relaxers, const Vector& acceleration, const Vector& velocity, double speeding_up) {
  const double share = relaxers.acceleration_damping * (speeding_up > 0 ? 1 : speeding_up < 0 ? -1 : 0);
  return -share * acceleration - relaxers.drag * velocity;
}

/// Applies them after the gather; returns the power that they take, by chunks in a fixed order.
template <Layout Y>
double relax(const Bodies<Y>& bodies, GrainStates<Y>& states, const Seen<Y>& seen, const Relaxers& relaxers,
             double kick, std::vector<double>& partial) {
  refill(partial, chunk_count(bodies.position.size()), 0.0);
  parallel_chunks(bodies.position.size(), [&](std::size_t chunk, std::size_t begin, std::size_t end) {
    double power = 0;
    for (int i = static_cast<int>(begin); i < static_cast<int>(end); ++i) {
      const Vec<Y.dim> acceleration = states.acceleration(i), velocity = seen.grains.velocity(i);
      const Vec<Y.dim> change = relaxation(relaxers, acceleration, velocity, acceleration.dot(velocity));
      states.change(i, change, kick);
      power -= bodies.mass[i] * change.dot(velocity);
      if constexpr (Y.friction) {
        const Spin<Y.dim> turning = states.turning(i), spin = seen.grains.spin(i);
        const Spin<Y.dim> turn = relaxation(relaxers, turning, spin, dot(turning, spin));
        states.change_turning(i, turn, kick);
        power -= bodies.inertia[i] * dot(turn, spin);
      }
    }
    partial[chunk] = power;
  });
  double total = 0;
  for (const double part : partial) total += part;
  return total;
}

/// Sum over the grains, and the rigid bodies, of m v (x) v.
template <Layout Y>
Mat<Y.dim> kinetic_virial(const Bodies<Y>& bodies, const GrainStates<Y>& states) {
  Mat<Y.dim> sum = bodies.rigid_kinetic_virial();
  for (int i = 0; i < bodies.grains(); ++i) {
    if (!bodies.rigid.free(i)) continue;
    const Vec<Y.dim> velocity = states.velocity(i);
    sum += bodies.mass[i] * velocity * velocity.transpose();
  }
  return sum;
}

}  // namespace galet::md
