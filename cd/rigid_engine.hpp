// The cd step as a sequence of stages (Moreau-Jean, positions advanced with the end velocities):
//
//   predict -> neighbours -> frames, activate -> assemble, colour -> warm start -> solve -> update -> correct drift
//
//   v_free = v + dt (gravity - L v);  hub: rate_free = rate + dt/inertia (sum m v (x) v : G - V load)
//   solve for v+, w+, rates+ and impulses (cd/problem.hpp)
//   x+ = x + dt (v+ + L+ x),  box+ = (1 + dt L+) box
//
// A branch vector moves by exactly dt (v_j+ - v_i+ + L+ b), and the distance of two points is a convex function of it,
// so that a gap ends at or above g + dt u_N+: penetration comes from the solver's tolerance, from restitution of
// separating pairs, and from the start only. Where it passes the scene's tolerance, positions are projected back
// (frictionless, mass-weighted, the stress-driven cell taking part) without touching any velocity: no kinetic energy
// is made. First order in dt. No stiffness, no contact time: dt and the solver's tolerance are the only numerical
// parameters.
#pragma once

#include <string_view>

#include <fmt/format.h>

#include "cd/assembly.hpp"
#include "cd/problem.hpp"
#include "cd/solvers/nsgs.hpp"
#include "common/core/error.hpp"
#include "common/engine/bodies.hpp"
#include "common/neighbour/verlet_list.hpp"

namespace galet::cd {

template <Layout Y>
class RigidEngine final : public Engine<Y.dim> {
 public:
  static constexpr int D = Y.dim;

  RigidEngine(const Scene& scene, const Derived& derived, const Sample<D>& sample)
      : dt_(derived.cd_dt),
        restitution_(derived.laws.at(0, 0).restitution),
        friction_(derived.laws.at(0, 0).friction),
        diameter_(derived.grains.mean_diameter),
        penetration_(scene.cd.penetration * derived.grains.mean_diameter),
        options_{scene.cd.tolerance, scene.cd.max_sweeps} {
    bodies_.start(scene, derived, sample);
    prepare_bodies();
    skin_ = 0.15 * diameter_;
    update_neighbours();
  }

  std::string_view name() const override { return "cd"; }
  Layout layout() const override { return Y; }
  double dt() const override { return dt_; }
  double time() const override { return static_cast<double>(steps_) * dt_; }
  long steps() const override { return steps_; }
  const Profile& profile() const override { return profile_; }
  SolverSummary solver_summary() const override { return summary_; }
  EnergyParts energy() const override { return bodies_.energy(); }

  void advance(long count) override {
    for (long k = 0; k < count; ++k) step();
  }

  Snapshot<D> snapshot() override {
    fill_shown();
    Snapshot<D> shown = bodies_.view();
    shown.engine = name();
    shown.time = time();
    shown.contacts = &shown_;
    return shown;
  }

  void save(Archive& archive) const override {
    bodies_.save(archive);
    list_.save(archive);
    put_column(archive, "contacts.reaction", history_);
    archive.reals["cd.numbers"] = {dt_, skin_, summary_.worst_residual, summary_.residual_sum};
    archive.integers["steps"] = {steps_};
    archive.integers["cd.summary"] = {summary_.steps, summary_.sweeps, summary_.missed, summary_.corrections};
  }

  void restore(const Archive& archive) override {
    bodies_.restore(archive);
    list_.restore(archive, bodies_.grains());
    history_.resize(list_.size());
    take_column(archive, "contacts.reaction", history_);
    std::vector<double> numbers(4);
    take_column(archive, "cd.numbers", numbers);
    dt_ = numbers[0], skin_ = numbers[1], summary_.worst_residual = numbers[2], summary_.residual_sum = numbers[3];
    steps_ = integer_column(archive, "steps").at(0);
    const auto& counts = integer_column(archive, "cd.summary");
    if (counts.size() != 4) throw InputError("column 'cd.summary' of the checkpoint has the wrong length");
    summary_.steps = counts[0], summary_.sweeps = counts[1], summary_.missed = counts[2];
    summary_.corrections = counts[3];
    prepare_bodies();
  }

 private:
  void step() {
    double fastest = predict();
    // The list must still hold at the end of the step, whose velocities are not known yet: twice the free ones are
    // reserved for, and the step is taken again with a wider skin in the rare case that this was too little.
    for (int attempt = 0;; ++attempt) {
      refresh_neighbours(4 * dt_ * fastest);
      solve_contacts();
      const double moved = 2 * dt_ * fastest_velocity();
      // A velocity that is not finite is reported with its grain when velocities are accepted.
      if (!std::isfinite(moved) || !list_.expired(bodies_.position, bodies_.cell, bodies_.planes, moved)) break;
      if (attempt == 4)
        throw RunError(
            fmt::format("at time {:.6g} grains move by {:.3g} in one step and ever faster: cd.dt is too large", time(),
                        0.5 * moved));
      fastest = std::max(fastest, fastest_velocity());
    }
    StageTimer timer(profile_, Stage::grains);
    accept_velocities();
    move(iterate_.velocity, iterate_.gradient, dt_);
    for (Plane<D>& plane : bodies_.planes) plane.point += dt_ * plane.velocity;
    correct_drift();
    if constexpr (Y.friction && D == 3) turn_reactions();
    ++steps_;
  }

  /// Inverse masses, hub and the columns that a step only fills.
  void prepare_bodies() {
    const std::size_t grains = bodies_.position.size(), count = grains + bodies_.planes.size();
    problem_.inverse_mass.assign(count, 0.0);
    problem_.inverse_inertia.assign(count, 0.0);
    for (std::size_t b = 0; b < grains; ++b) {
      problem_.inverse_mass[b] = 1 / bodies_.mass[b];
      if constexpr (Y.friction) problem_.inverse_inertia[b] = 1 / bodies_.inertia[b];
    }
    problem_.hub.clear();
    for (const CellMode<D>& mode : bodies_.modes)
      if (mode.stress_driven) problem_.hub.push_back({mode.direction, 1 / mode.inertia});
    problem_.friction = friction_;
  }

  /// Free velocities; returns the largest among the bodies.
  double predict() {
    StageTimer timer(profile_, Stage::grains);
    const std::size_t grains = bodies_.position.size();
    free_.velocity.resize(grains + bodies_.planes.size());
    for (std::size_t b = 0; b < grains; ++b)
      free_.velocity[b] = bodies_.velocity[b] + dt_ * (bodies_.gravity - bodies_.cell.rate * bodies_.velocity[b]);
    for (std::size_t p = 0; p < bodies_.planes.size(); ++p) free_.velocity[grains + p] = bodies_.planes[p].velocity;
    if constexpr (Y.friction) {
      free_.spin = bodies_.spin;
      free_.spin.resize(free_.velocity.size(), zero_spin<D>());
    }
    predict_hub();
    double fastest = 0;
    for (const Vec<D>& v : free_.velocity) fastest = std::max(fastest, v.squaredNorm());
    return std::sqrt(fastest);
  }

  void predict_hub() {
    free_.hub_rate.clear();
    free_.gradient = bodies_.cell.rate;
    if (!bodies_.stress_driven()) return;
    Mat<D> kinetic = Mat<D>::Zero();
    for (std::size_t b = 0; b < bodies_.position.size(); ++b)
      kinetic += bodies_.mass[b] * bodies_.velocity[b] * bodies_.velocity[b].transpose();
    const double volume = bodies_.cell.volume();
    for (const CellMode<D>& mode : bodies_.modes) {
      if (!mode.stress_driven) continue;
      const double change = dt_ * (kinetic.cwiseProduct(mode.direction).sum() - volume * mode.load) / mode.inertia;
      free_.hub_rate.push_back(mode.rate + change);
      free_.gradient += change * mode.direction;
    }
  }

  void refresh_neighbours(double reserve) {
    StageTimer timer(profile_, Stage::neighbours);
    if (!list_.expired(bodies_.position, bodies_.cell, bodies_.planes, reserve)) return;
    skin_ = std::max({0.15 * diameter_, 2 * reserve});
    update_neighbours();
  }

  void update_neighbours() {
    list_.configure(0, skin_);
    list_.build(bodies_.position, bodies_.radius, bodies_.cell, bodies_.planes);
    std::swap(history_, carried_);
    refill(history_, list_.size(), Reaction<Y>::Zero());
    for (std::size_t row = 0; row < list_.size(); ++row) {
      const int from = list_.origin()[row];
      if (from < 0) continue;
      // Impulses kept as vectors change sign with the order of the pair; normal and 2D components do not.
      const bool sign_changes = Y.friction && D == 3 && list_.flipped(row);
      history_[row] = sign_changes ? Reaction<Y>(-carried_[from]) : carried_[from];
    }
  }

  /// Assembles and solves the step's problem, again if a pair outside it would have closed.
  void solve_contacts() {
    {
      StageTimer timer(profile_, Stage::contacts);
      assembly_.measure(bodies_, list_);
      assembly_.activate(list_, free_.velocity, dt_, 2 * penetration_);
    }
    for (bool complete = false; !complete;) {
      assemble();
      StageTimer timer(profile_, Stage::solve);
      const SolveReport report = solver_.solve(problem_, options_, iterate_);
      note(report);
      store_reactions();
      complete = assembly_.activate_missed(bodies_, list_, iterate_, dt_) == 0;
    }
  }

  void assemble() {
    StageTimer timer(profile_, Stage::contacts);
    assembly_.fill(bodies_, list_, restitution_, dt_, problem_);
    iterate_.velocity = free_.velocity;
    iterate_.spin = free_.spin;
    iterate_.hub_rate = free_.hub_rate;
    iterate_.gradient = free_.gradient;
    iterate_.reaction.reserve(problem_.i.capacity());
    iterate_.reaction.resize(problem_.size());
    Mat<D> virial = Mat<D>::Zero();
    for (std::size_t k = 0; k < problem_.size(); ++k) {
      iterate_.reaction[k] = warm_start(problem_.normal[k], history_[assembly_.row_of()[k]]);
      const Vec<D> p = impulse_vector<Y>(problem_.normal[k], iterate_.reaction[k]);
      add_impulse(problem_, iterate_, k, p);
      virial += p * (problem_.distance[k] * problem_.normal[k]).transpose();
    }
    add_to_hub(problem_, iterate_, virial);
  }

  /// The last step's impulse, put back into Coulomb's cone of the present normal.
  Reaction<Y> warm_start(const Vec<D>& normal, const Reaction<Y>& before) const {
    if constexpr (Y.friction && D == 3) {
      const double r_n = normal.dot(before);
      if (r_n <= 0) return Reaction<Y>::Zero();
      Vec<3> tangential = before - r_n * normal;
      const double norm = tangential.norm(), limit = friction_ * r_n;
      if (norm > limit) tangential *= limit / norm;
      return r_n * normal + tangential;
    } else {
      return before;
    }
  }

  void note(const SolveReport& report) {
    ++summary_.steps;
    summary_.sweeps += report.sweeps;
    summary_.residual_sum += report.residual;
    summary_.worst_residual = std::max(summary_.worst_residual, report.residual);
    if (report.stop != StopReason::converged) ++summary_.missed;
  }

  void store_reactions() {
    refill(history_, list_.size(), Reaction<Y>::Zero());
    for (std::size_t k = 0; k < problem_.size(); ++k) {
      history_[assembly_.row_of()[k]] = iterate_.reaction[k];
      GALET_ENSURE(!(problem_.normal[k].dot(impulse_vector<Y>(problem_.normal[k], iterate_.reaction[k])) <
                     -1e-12 * iterate_.reaction[k].norm()),
                   "rigid grains do not pull on each other");
    }
  }

  /// Impulses kept as vectors turn with their contacts to the positions at the end of the step; normal and tangential
  /// components need no turning.
  void turn_reactions() {
    for (std::size_t k = 0; k < problem_.size(); ++k) {
      Vec<3>& reaction = history_[assembly_.row_of()[k]];
      if (reaction.isZero(0)) continue;
      const Vec<3>& before = problem_.normal[k];
      const Vec<3> after = frame_of(bodies_, list_.pairs(), assembly_.row_of()[k]).normal;
      const double normal = before.dot(reaction);
      reaction = normal * after + carried(reaction - normal * before, before, after);
    }
  }

  double fastest_velocity() const {
    double fastest = 0;
    for (const Vec<D>& v : iterate_.velocity) {
      if (v != v) return v.norm();
      fastest = std::max(fastest, v.squaredNorm());
    }
    return std::sqrt(fastest);
  }

  void accept_velocities() {
    const std::size_t grains = bodies_.position.size();
    for (std::size_t b = 0; b < grains; ++b) {
      if (!iterate_.velocity[b].allFinite())
        throw RunError(fmt::format("the velocity of grain {} is not finite at time {:.6g}", b, time()));
      bodies_.velocity[b] = iterate_.velocity[b];
      if constexpr (Y.friction) bodies_.spin[b] = iterate_.spin[b];
    }
    std::size_t m = 0;
    for (CellMode<D>& mode : bodies_.modes)
      if (mode.stress_driven) mode.rate = iterate_.hub_rate[m++];
    if (!bodies_.modes.empty()) bodies_.cell.rate = velocity_gradient(bodies_.modes);
  }

  /// x += scale (velocity + gradient x), and the box with it.
  void move(const Column<Vec<D>>& velocity, const Mat<D>& gradient, double scale) {
    const bool still = gradient.isZero(0);
    for (std::size_t b = 0; b < bodies_.position.size(); ++b) {
      const Vec<D> affine = still ? Vec<D>(Vec<D>::Zero()) : Vec<D>(gradient * bodies_.position[b]);
      bodies_.position[b] += scale * (velocity[b] + affine);
    }
    if (!still) bodies_.cell.box += scale * (gradient * bodies_.cell.box);
  }

  /// Gap of contact k of the problem at the present positions.
  double gap_of(std::size_t k) const { return frame_of(bodies_, list_.pairs(), assembly_.row_of()[k]).gap; }

  /// Projects positions so that no contact overlaps by more than half of the tolerance, when one is beyond it.
  void correct_drift() {
    for (int round = 0; round < 3; ++round) {
      double deepest = 0;
      for (std::size_t k = 0; k < problem_.size(); ++k) {
        const double gap = gap_of(k);
        problem_.offset[k] = gap + 0.5 * penetration_;  // a displacement, per unit of "time"
        deepest = std::min(deepest, gap);
      }
      if (-deepest <= penetration_) return;
      if (round == 0) ++summary_.corrections;
      problem_.friction = 0;
      correction_.velocity.assign(iterate_.velocity.size(), Vec<D>::Zero());
      if constexpr (Y.friction) correction_.spin.assign(iterate_.spin.size(), zero_spin<D>());
      correction_.hub_rate.assign(problem_.hub.size(), 0.0);
      correction_.gradient.setZero();
      refill(correction_.reaction, problem_.size(), Reaction<Y>::Zero());
      solver_.solve(problem_, {1e-3, 200}, correction_);
      problem_.friction = friction_;
      move(correction_.velocity, correction_.gradient, 1);
    }
  }

  void fill_shown() {
    shown_.clear();
    for (std::size_t row = 0; row < list_.size(); ++row) {
      if (history_[row].isZero(0)) continue;
      const ContactFrame<D> frame = frame_of(bodies_, list_.pairs(), row);
      shown_.i.push_back(list_.pairs().i[row]);
      shown_.j.push_back(list_.pairs().j[row]);
      shown_.image.push_back(list_.pairs().image[row]);
      shown_.normal.push_back(frame.normal);
      shown_.branch.push_back(frame.branch);
      shown_.gap.push_back(frame.gap);
      shown_.force.push_back(impulse_vector<Y>(frame.normal, history_[row]) / dt_);
    }
  }

  double dt_, restitution_, friction_, diameter_, penetration_;
  SolverOptions options_;
  double skin_ = 0;
  long steps_ = 0;

  Bodies<Y> bodies_;
  VerletList<D> list_;
  Column<Reaction<Y>> history_, carried_;  ///< impulses of the last step, by row of the list
  Assembly<Y> assembly_;
  Problem<Y> problem_;
  Iterate<Y> free_, iterate_, correction_;
  Nsgs<Y> solver_;
  ContactColumns<D> shown_;
  SolverSummary summary_;
  Profile profile_;
};

}  // namespace galet::cd
