// The cd step as a sequence of stages (Moreau-Jean):
//
//   predict -> neighbours -> frames, attraction, activate -> assemble, colour -> warm start -> solve -> update -> drift
//
//   v_free = v + dt (gravity - L v) + attraction;  hub: rate_free = rate + dt/inertia (sum m v (x) v : G - V load)
//   solve for v+, w+, rates+ and impulses (cd/problem.hpp)
//   x+ = x + dt (v + L x),  box+ = (1 + dt L) box,  v = theta v+ + (1 - theta) v-           (cd/advance.hpp)
//
// theta = 1 by default: positions then move with the velocities that the contact laws were solved for, so that no
// impact penetrates. With theta < 1 one that stops a grain leaves it (1 - theta - theta e) u dt inside the other.
//
// Normals are those of the step's start. A grain that would move by more than a fraction of a diameter in a step would
// meet others at normals that say nothing, so that such a step is taken in equal parts; and since a pair that closes
// within a step is part of its problem (whichever way it started), no grain passes through another.
// First order in dt. No stiffness, no contact time: dt and the solver's tolerance are the only numerical parameters.
#pragma once

#include <string_view>

#include <fmt/format.h>

#include "cd/advance.hpp"
#include "cd/assembly.hpp"
#include "cd/contact_account.hpp"
#include "cd/contact_history.hpp"
#include "cd/discrete/discrete_form.hpp"
#include "cd/elastic_contacts.hpp"
#include "cd/problem.hpp"
#include "cd/solvers/nsgs.hpp"
#include "cd/summary_columns.hpp"
#include "common/core/error.hpp"
#include "common/engine/bodies.hpp"
#include "common/neighbour/verlet_list.hpp"

namespace galet::cd {

template <Layout Y>
class RigidEngine final : public Engine<Y.dim>, public ProblemSource {
 public:
  static constexpr int D = Y.dim;

  RigidEngine(const Scene& scene, const Derived& derived, const Sample<D>& sample)
      : dt_(derived.cd_dt),
        last_dt_(derived.cd_dt),
        theta_(scene.cd.theta),
        laws_(derived.laws),
        cohesive_(derived.laws.any_cohesion()),
        compliant_(scene.cd.compliance),
        diameter_(derived.grains.mean_diameter),
        least_diameter_(derived.grains.least_diameter),
        penetration_(scene.cd.penetration * derived.grains.mean_diameter),
        options_{scene.cd.tolerance, scene.cd.max_sweeps} {
    if (compliant_ && !laws_.stiff)
      throw InputError("cd.compliance needs a stiffness: give material.stiffness_level or material.normal_stiffness");
    bodies_.start(scene, derived, sample);
    prepare_problem();
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

  EnergyParts energy() const override {
    EnergyParts parts = bodies_.energy();
    if (compliant_) ElasticContacts<Y>::add_energy(bodies_, laws_, list_.pairs(), history_.before, last_dt_, parts);
    if (cohesive_)
      for (std::size_t row = 0; row < list_.size(); ++row)
        parts.cohesive +=
            attraction_energy(law_of(row), frame_of(bodies_, list_.pairs(), row).gap, !history_.before[row].isZero(0));
    return parts;
  }

  void advance(long count) override {
    for (long k = 0; k < count; ++k) step();
  }

  void change(const Scene& scene, const Derived& derived) override {
    bodies_.change_loading(scene, derived);
    laws_ = derived.laws;
    prepare_problem();
  }

  StepProblem step_with_problem(ProblemForm form) override {
    StepProblem problem{form};
    capture_ = &problem;
    try {
      step();
    } catch (...) {
      capture_ = nullptr;  // the problem ends with this call
      throw;
    }
    capture_ = nullptr;
    problem.gap_time = theta_ * last_dt_;
    return problem;
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
    history_.save(archive);
    archive.reals["cd.numbers"] = {dt_, last_dt_, skin_};
    archive.integers["steps"] = {steps_};
    save_summary(archive, summary_);
  }

  void restore(const Archive& archive) override {
    bodies_.restore(archive);
    list_.restore(archive, bodies_.grains());
    history_.restore(archive, list_.size());
    std::vector<double> numbers(3);
    take_column(archive, "cd.numbers", numbers);
    dt_ = numbers[0], last_dt_ = numbers[1], skin_ = numbers[2];
    steps_ = integer_column(archive, "steps").at(0);
    restore_summary(archive, summary_);
    prepare_problem();
  }

 private:
  void step() {
    bodies_.advance_loads(dt_);
    predict(dt_);
    // The largest distance that two bodies may cover towards each other in one go.
    const double most = 0.5 * least_diameter_;
    const double parts = std::ceil(2 * dt_ * spread_ / most);
    if (parts > 1000)
      throw RunError(fmt::format("at time {:.6g} grains move by {:.3g} diameters in one step: cd.dt is too large",
                                 time(), dt_ * spread_ / diameter_));
    if (parts > 1) ++summary_.divided;
    const double dt = parts > 1 ? dt_ / parts : dt_;
    for (int part = 0; part < parts || part == 0; ++part) {
      if (parts > 1) predict(dt);
      take(dt);
    }
    ++steps_;
  }

  /// One step of length dt from the predicted velocities.
  void take(double dt) {
    history_.rescale(dt / last_dt_);
    last_dt_ = dt;
    // The list must still hold at the end of the step, whose velocities are not known yet: twice the free ones are
    // reserved for, and the step is taken again with a wider skin in the rare case that this was too little.
    double fastest = fastest_of(free_.velocity);
    for (int attempt = 0;; ++attempt) {
      refresh_neighbours(4 * dt * fastest);
      solve_contacts({dt, theta_});
      const double moved = 2 * dt * fastest_of(iterate_.velocity);
      // A velocity that is not finite is reported with its grain when velocities are accepted.
      if (!std::isfinite(moved) || !list_.expired(bodies_.position, bodies_.cell, bodies_.planes, moved)) break;
      if (attempt == 4)
        throw RunError(
            fmt::format("at time {:.6g} grains move by {:.3g} in one step and ever faster: cd.dt is too large", time(),
                        0.5 * moved));
      fastest = std::max(fastest, fastest_of(iterate_.velocity));
    }
    if (capture_ != nullptr) *capture_ = present_problem(capture_->form);
    StageTimer timer(profile_, Stage::grains);
    if (!compliant_) account();
    accept_velocities();
    move(dt);
    if (!compliant_) correct_drift();
    history_.accept(bodies_, list_, problem_, assembly_.row_of(), dt);
  }

  /// Inverse masses, hub, laws and the columns that a step only fills.
  void prepare_problem() {
    const std::size_t grains = bodies_.position.size();
    const std::size_t count = grains + bodies_.planes.size() + bodies_.rigid.body.size();
    problem_.grains = bodies_.grains();
    problem_.inverse_mass.assign(count, 0.0);
    problem_.inverse_inertia.assign(count, 0.0);
    for (std::size_t b = 0; b < grains; ++b) {
      problem_.inverse_mass[b] = 1 / bodies_.mass[b];
      if constexpr (Y.friction) problem_.inverse_inertia[b] = 1 / bodies_.inertia[b];
    }
    problem_.hub.clear();
    for (const CellMode<D>& mode : bodies_.modes)
      if (mode.stress_driven) problem_.hub.push_back({mode.direction, 1 / mode.inertia});
    problem_.mobility.clear();
    problem_.turning.clear();
    bool some = false;
    for (const Plane<D>& plane : bodies_.planes)
      problem_.mobility.push_back(plane.inverse_mass * plane.normal * plane.normal.transpose());
    for (const RigidBody<D>& body : bodies_.rigid.body) problem_.mobility.push_back(body.mobility);
    for (const Mat<D>& mobility : problem_.mobility) some = some || !mobility.isZero(0);
    if (!some) problem_.mobility.clear();
    if (bodies_.rigid.any_turning)
      problem_.turning.assign(bodies_.planes.size() + bodies_.rigid.body.size(), zero_map<D>());
    problem_.laws.clear();
    for (const PairLaw& law : laws_.pairs)
      problem_.laws.push_back({law.friction, law.rolling_friction, law.pivoting_friction});
    problem_.compliant = compliant_;
    problem_.lagged = Y.friction && (compliant_ || laws_.any_tangential_restitution());
  }

  /// Velocities at the start of the step and free velocities at its end, and how much faster than the mean a body is.
  void predict(double dt) {
    StageTimer timer(profile_, Stage::grains);
    const std::size_t grains = bodies_.position.size(), planes = bodies_.planes.size();
    const std::size_t count = grains + planes + bodies_.rigid.body.size();
    start_.velocity.resize(count), free_.velocity.resize(count);
    Vec<D> mean = Vec<D>::Zero();
    for (std::size_t b = 0; b < grains; ++b) {
      const Vec<D>& v = start_.velocity[b] = bodies_.velocity[b];
      free_.velocity[b] = v + dt * (bodies_.gravity - bodies_.cell.rate * v);
      mean += free_.velocity[b] / static_cast<double>(grains);
    }
    for (std::size_t p = 0; p < planes; ++p) {
      const Plane<D>& plane = bodies_.planes[p];
      start_.velocity[grains + p] = plane.velocity;
      free_.velocity[grains + p] = plane.velocity + dt * plane.force * plane.inverse_mass * plane.normal;
    }
    if constexpr (Y.friction) {
      start_.spin = bodies_.spin;
      start_.spin.resize(count, zero_spin<D>());
      for (std::size_t p = 0; p < planes; ++p) start_.spin[grains + p] = bodies_.planes[p].spin;
      free_.spin = start_.spin;
    }
    predict_rigid(dt);
    start_.gradient = bodies_.cell.rate;
    predict_hub(dt);
    show_members(free_);
    double spread = 0;
    for (const Vec<D>& v : free_.velocity) spread = std::max(spread, (v - mean).squaredNorm());
    spread_ = std::sqrt(spread);
  }

  /// Rigid bodies, and their grains. A torque changes J at the orientation of the start.
  void predict_rigid(double dt) {
    const std::size_t before = bodies_.position.size() + bodies_.planes.size();
    for (std::size_t b = 0; b < bodies_.rigid.body.size(); ++b) {
      const RigidBody<D>& body = bodies_.rigid.body[b];
      start_.velocity[before + b] = body.velocity;
      free_.velocity[before + b] = body.velocity + dt * (body.mobility * (body.force + body.mass * bodies_.gravity) -
                                                         bodies_.cell.rate * body.velocity);
      if constexpr (Y.friction) {
        const SpinMap<D> mobility = turning_mobility(body);
        if (bodies_.rigid.any_turning) problem_.turning[before + b - bodies_.position.size()] = mobility;
        start_.spin[before + b] = body.spin;
        free_.spin[before + b] = body.spin + dt * (mobility * body.torque);
      }
    }
  }

  /// Velocities of the grains of rigid bodies, which no contact refers to.
  void show_members(Iterate<Y>& iterate) const {
    for (const int i : bodies_.rigid.member) iterate.velocity[i] = velocity_of(bodies_, iterate, i);
  }

  void predict_hub(double dt) {
    free_.hub_rate.clear();
    free_.gradient = bodies_.cell.rate;
    if (!bodies_.stress_driven()) return;
    Mat<D> kinetic = Mat<D>::Zero();
    for (int b = 0; b < bodies_.grains(); ++b)
      if (bodies_.rigid.free(b)) kinetic += bodies_.mass[b] * bodies_.velocity[b] * bodies_.velocity[b].transpose();
    kinetic += bodies_.rigid_kinetic_virial();
    const double volume = bodies_.cell.volume();
    for (const CellMode<D>& mode : bodies_.modes) {
      if (!mode.stress_driven) continue;
      const double change = dt * (kinetic.cwiseProduct(mode.direction).sum() - volume * mode.load) / mode.inertia;
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
    list_.configure(laws_.cohesion_range(), skin_);
    list_.build(bodies_.position, bodies_.radius, bodies_.cell, bodies_.planes, bodies_.rigid.group);
    history_.carry(list_);
  }

  const PairLaw& law_of(std::size_t row) const {
    return laws_.pairs[law_index(bodies_, list_.pairs(), row, laws_.materials)];
  }

  /// Assembles and solves the step's problem, again if a pair outside it would have closed or if a Hertz contact was
  /// linearised too far from where it ended.
  void solve_contacts(const StepRule& rule) {
    {
      StageTimer timer(profile_, Stage::contacts);
      assembly_.measure(bodies_, list_);
      if (cohesive_) history_.attract(bodies_, list_, laws_, assembly_, rule.dt);
      if (compliant_) elastic_.start(assembly_, list_.size(), 1e-7 * diameter_);
      assembly_.activate(list_, free_.velocity, rule.dt, 2 * penetration_);
      copy_with_room(history_.before, history_.present);
    }
    for (bool complete = false; !complete;) {
      assemble(rule);
      StageTimer timer(profile_, Stage::solve);
      note(solver_.solve(problem_, options_, iterate_));
      show_members(iterate_);
      history_.store(assembly_.row_of(), iterate_);
      complete = assembly_.activate_missed(bodies_, list_, iterate_, rule) == 0;
      if (compliant_ &&
          !elastic_.agrees(bodies_, laws_, list_.pairs(), assembly_, problem_, iterate_, rule.dt, options_.tolerance))
        complete = false;
    }
  }

  void assemble(const StepRule& rule) {
    StageTimer timer(profile_, Stage::contacts);
    assembly_.fill(bodies_, list_, laws_, rule, start_, problem_);
    if (compliant_) elastic_.apply(bodies_, laws_, list_.pairs(), assembly_, history_.before, rule.dt, problem_);
    iterate_.velocity = free_.velocity;
    iterate_.spin = free_.spin;
    iterate_.hub_rate = free_.hub_rate;
    iterate_.gradient = free_.gradient;
    iterate_.reaction.reserve(problem_.i.capacity());
    iterate_.reaction.resize(problem_.size());
    Mat<D> virial = Mat<D>::Zero();
    if (cohesive_) attract(iterate_, virial);
    for (std::size_t k = 0; k < problem_.size(); ++k) {
      iterate_.reaction[k] = history_.warm_start(problem_, k, history_.present[assembly_.row_of()[k]]);
      add_reaction(problem_, iterate_, k, iterate_.reaction[k], virial);
    }
    add_to_hub(problem_, iterate_, virial);
  }

  /// Gives the attraction of all pairs to their bodies.
  void attract(Iterate<Y>& iterate, Mat<D>& virial) const {
    for (std::size_t row = 0; row < list_.size(); ++row) {
      const double impulse = history_.attracted[row];
      if (impulse == 0) continue;
      const int i = list_.pairs().i[row], j = list_.pairs().j[row];
      const ContactFrame<D>& frame = assembly_.frame(row);
      const Vec<D> p = -impulse * frame.normal;
      attract(iterate, i, Vec<D>(-p));
      attract(iterate, j, p);
      Vec<D> branch = frame.branch;
      if (!bodies_.rigid.none()) {
        branch += bodies_.arm[i];
        if (j < bodies_.grains()) branch -= bodies_.arm[j];
      }
      virial += p * branch.transpose();
    }
  }

  /// Gives the impulse p through the centre of a member to its body.
  void attract(Iterate<Y>& iterate, int member, const Vec<D>& p) const {
    const bool glued = body_of(bodies_, member) != member;
    push_at(problem_, iterate, body_of(bodies_, member), glued ? bodies_.arm[member] : Vec<D>(Vec<D>::Zero()), p);
  }

  /// The problem that was just solved.
  StepProblem present_problem(ProblemForm form) const {
    Iterate<Y> free = free_;
    Mat<D> virial = Mat<D>::Zero();
    if (cohesive_) attract(free, virial);
    add_to_hub(problem_, free, virial);
    return DiscreteForm<Y>::of(problem_, free, iterate_.reaction, form);
  }

  void note(const SolveReport& report) {
    ++summary_.steps;
    summary_.sweeps += report.sweeps;
    summary_.residual_sum += report.residual;
    summary_.worst_residual = std::max(summary_.worst_residual, report.residual);
    if (report.stop != StopReason::converged) ++summary_.missed;
  }

  void account() {
    const double energy = dissipated_energy(problem_, start_, iterate_, partial_);
    (energy >= 0 ? summary_.dissipated : summary_.gained) += std::abs(energy);
  }

  static double fastest_of(const Column<Vec<D>>& velocity) {
    double fastest = 0;
    for (const Vec<D>& v : velocity) {
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
    for (std::size_t p = 0; p < bodies_.planes.size(); ++p)
      if (bodies_.planes[p].inverse_mass > 0) bodies_.planes[p].velocity = iterate_.velocity[grains + p];
    std::size_t m = 0;
    for (CellMode<D>& mode : bodies_.modes)
      if (mode.stress_driven) mode.rate = iterate_.hub_rate[m++];
    if (!bodies_.modes.empty()) bodies_.cell.rate = velocity_gradient(bodies_.modes);
    accept_rigid();
  }

  void accept_rigid() {
    const std::size_t before = bodies_.position.size() + bodies_.planes.size();
    for (std::size_t b = 0; b < bodies_.rigid.body.size(); ++b) {
      RigidBody<D>& body = bodies_.rigid.body[b];
      if (!iterate_.velocity[before + b].allFinite())
        throw RunError(fmt::format("the velocity of body {} is not finite at time {:.6g}", b, time()));
      body.velocity = iterate_.velocity[before + b];
      if constexpr (Y.friction) {
        // As a change, so that what nothing turns keeps J to the last bit.
        const Spin<D>& spin = iterate_.spin[before + b];
        if (body.has_momentum()) body.momentum += angular_momentum<D>(body, Spin<D>(spin - body.spin));
        body.spin = spin;
      }
    }
    bodies_.follow_velocities();
  }

  void move(double dt) {
    if (theta_ == 1) return advance_positions(bodies_, iterate_, dt);
    for (std::size_t b = 0; b < start_.velocity.size(); ++b) {
      start_.velocity[b] = theta_ * iterate_.velocity[b] + (1 - theta_) * start_.velocity[b];
      if constexpr (Y.friction) start_.spin[b] = theta_ * iterate_.spin[b] + (1 - theta_) * start_.spin[b];
    }
    start_.gradient = theta_ * iterate_.gradient + (1 - theta_) * start_.gradient;
    advance_positions(bodies_, start_, dt);
  }

  void correct_drift() {
    const DriftReport report = drift_.correct(bodies_, list_, assembly_.row_of(), penetration_, solver_, problem_);
    if (report.corrected) ++summary_.corrections;
    summary_.penetration = std::max(summary_.penetration, report.deepest / diameter_);
  }

  void fill_shown() {
    shown_.clear();
    for (std::size_t row = 0; row < list_.size(); ++row) {
      const Reaction<Y>& reaction = history_.before[row];
      const double attracted = cohesive_ && !history_.attracted.empty() ? history_.attracted[row] : 0;
      const bool pressed = !reaction.isZero(0);
      if (!pressed && attracted == 0) continue;
      const ContactFrame<D> frame = frame_of(bodies_, list_.pairs(), row);
      shown_.i.push_back(list_.pairs().i[row]);
      shown_.j.push_back(list_.pairs().j[row]);
      shown_.image.push_back(list_.pairs().image[row]);
      shown_.normal.push_back(frame.normal);
      shown_.branch.push_back(frame.branch);
      shown_.gap.push_back(frame.gap);
      shown_.force.push_back((impulse_vector<Y>(frame.normal, reaction) - attracted * frame.normal) / last_dt_);
      if constexpr (Y.rolling) shown_.torque.push_back(torque_impulse<Y>(reaction) / last_dt_);
      if constexpr (Y.friction) {
        const double friction = laws_.pairs[law_index(bodies_, list_.pairs(), row, laws_.materials)].friction;
        shown_.mobilised.push_back(mobilised_friction<Y>(frame.normal, reaction, friction));
      }
      if (cohesive_) shown_.touching.push_back(pressed || frame.gap <= 0);
    }
  }

  double dt_;
  double last_dt_;  ///< of the last step or part of a step, to which the impulses belong
  double theta_;
  LawTable laws_;
  bool cohesive_, compliant_;
  double diameter_, least_diameter_, penetration_;
  SolverOptions options_;
  double skin_ = 0, spread_ = 0;
  long steps_ = 0;

  Bodies<Y> bodies_;
  VerletList<D> list_;
  ContactHistory<Y> history_;
  Assembly<Y> assembly_;
  ElasticContacts<Y> elastic_;
  Problem<Y> problem_;
  Iterate<Y> start_, free_, iterate_;
  Nsgs<Y> solver_;
  DriftCorrection<Y> drift_;
  ContactColumns<D> shown_;
  SolverSummary summary_;
  StepProblem* capture_ = nullptr;  ///< where this step's problem is wanted, if it is
  Profile profile_;
  std::vector<double> partial_;
};

}  // namespace galet::cd
