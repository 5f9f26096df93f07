// Positions at the end of a step, and their correction for drift.
//
//   x += dt (v + L x),  box += dt L box,  planes += dt v            with v = theta v+ + (1 - theta) v-
//   rigid bodies: c += dt (v + L c); the orientation turns by dt w, or freely with J (geometry/rigid_body.hpp), J =
//   theta J+ + (1 - theta) J- where J- and J+ belong to the orientation at the start of the step. Gyroscopic terms are
//   all in that motion: J is kept, and w at the step's end is I^-1 J there.
//
// A branch vector moves by exactly dt (v_j - v_i + L b), and the distance of two points is a convex function of it, so
// that a gap ends at or above g + dt u_N: penetration comes from the solver's tolerance, from restitution of separating
// pairs, from the turning of bodies (a chord in place of an arc: w^2 r dt^2 / 2 in a step), and from the start only.
// Where it passes the scene's tolerance, positions are projected back (frictionless,
// mass-weighted, the stress-driven cell and free planes taking part) without touching any velocity: no kinetic energy
// is made.
#pragma once

#include <algorithm>

#include "cd/assembly.hpp"
#include "cd/problem.hpp"
#include "cd/solvers/nsgs.hpp"
#include "common/engine/bodies.hpp"

namespace galet::cd {

/// `motion`: the velocities with which bodies are moved.
template <Layout Y>
void advance_positions(Bodies<Y>& bodies, const Iterate<Y>& motion, double dt) {
  constexpr int D = Y.dim;
  const Column<Vec<D>>& velocity = motion.velocity;
  const Mat<D>& gradient = motion.gradient;
  const bool still = gradient.isZero(0);
  for (std::size_t b = 0; b < bodies.position.size(); ++b) {
    const Vec<D> affine = still ? Vec<D>(Vec<D>::Zero()) : Vec<D>(gradient * bodies.position[b]);
    bodies.position[b] += dt * (velocity[b] + affine);
  }
  for (std::size_t p = 0; p < bodies.planes.size(); ++p)
    bodies.planes[p].point += dt * velocity[bodies.position.size() + p];
  if (!still) {
    bodies.cell.box += dt * (gradient * bodies.cell.box);
    bodies.cell.strain += dt * gradient;
  }
  const std::size_t before = bodies.position.size() + bodies.planes.size();
  for (std::size_t b = 0; b < bodies.rigid.body.size(); ++b) {
    RigidBody<D>& body = bodies.rigid.body[b];
    Spin<D> spin = zero_spin<D>();
    if constexpr (Y.friction) spin = motion.spin[before + b];
    const Vec<D> affine = still ? Vec<D>(Vec<D>::Zero()) : Vec<D>(gradient * body.centre);
    drift(body, Vec<D>(velocity[before + b] + affine), spin, angular_momentum<D>(body, spin), dt);
  }
  if (!bodies.rigid.none()) bodies.follow();
}

/// What a correction did: the overlap that is left, and whether positions were moved.
struct DriftReport {
  double deepest = 0;
  bool corrected = false;
};

template <Layout Y>
class DriftCorrection {
 public:
  static constexpr int D = Y.dim;

  /// Projects positions so that no contact of the problem overlaps by more than half of `allowed`, when one is beyond
  /// it. The problem's offsets are overwritten.
  DriftReport correct(Bodies<Y>& bodies, const VerletList<D>& list, const std::vector<int>& row_of, double allowed,
                      Nsgs<Y>& solver, Problem<Y>& problem) {
    DriftReport report;
    for (int round = 0;; ++round) {
      report.deepest = 0;
      for (std::size_t k = 0; k < problem.size(); ++k) {
        const double gap = frame_of(bodies, list.pairs(), row_of[k]).gap;
        problem.offset[k] = gap + 0.5 * allowed;  // a displacement, per unit of "time"
        report.deepest = std::max(report.deepest, -gap);
      }
      if (report.deepest <= allowed || round == most_rounds) return report;
      report.corrected = true;
      // Without friction, rolling and lags.
      frictionless_.assign(problem.laws.size(), ContactLaw{});
      problem.laws.swap(frictionless_);
      const bool lagged = problem.lagged;
      problem.lagged = false;
      displace(bodies, solver, problem);
      problem.lagged = lagged;
      problem.laws.swap(frictionless_);
    }
  }

 private:
  static constexpr int most_rounds = 5;

  void displace(Bodies<Y>& bodies, Nsgs<Y>& solver, const Problem<Y>& problem) {
    const std::size_t count = problem.inverse_mass.size();
    displacement_.velocity.assign(count, Vec<D>::Zero());
    if constexpr (Y.friction) displacement_.spin.assign(count, zero_spin<D>());
    displacement_.hub_rate.assign(problem.hub.size(), 0.0);
    displacement_.gradient.setZero();
    refill(displacement_.reaction, problem.size(), Reaction<Y>::Zero());
    solver.solve(problem, {1e-3, 1000}, displacement_);
    advance_positions(bodies, displacement_, 1);
  }

  Iterate<Y> displacement_;
  std::vector<ContactLaw> frictionless_;
};

}  // namespace galet::cd
