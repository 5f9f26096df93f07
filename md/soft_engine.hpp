// The md step as a sequence of stages:
//
//   drift -> neighbours (only if a pair could be missed) -> contacts (contact pass) -> grains (grain pass) -> drives
//
// Contact pass: one row per listed pair. Grain pass: each grain gathers its rows in a fixed order. Drives: the
// stress-driven modes of the cell, with the same time scheme as the grains.
#pragma once

#include <string_view>

#include <fmt/format.h>

#include "common/core/error.hpp"
#include "common/engine/bodies.hpp"
#include "common/neighbour/verlet_list.hpp"
#include "md/body_pass.hpp"
#include "md/contact_pass.hpp"
#include "md/contacts.hpp"
#include "md/energy.hpp"
#include "md/grain_order.hpp"
#include "md/grain_pass.hpp"
#include "md/move_bound.hpp"
#include "md/shown.hpp"
#include "md/skin.hpp"
#include "md/step_guard.hpp"
#include "md/sweep.hpp"

namespace galet::md {

template <Layout Y>
class SoftEngine final : public Engine<Y.dim> {
 public:
  static constexpr int D = Y.dim;
  /// Steps after which the list is tested whatever the bound says: a position that is not finite escapes the bound.
  static constexpr long longest_unchecked = 64;

  SoftEngine(const Scene& scene, const Derived& derived, const Sample<D>& sample)
      : materials_(derived.laws.materials),
        range_(derived.laws.cohesion_range()),
        laws_(derived.laws.pairs),
        relaxers_{scene.md.drag, scene.md.acceleration_damping},
        account_(scene.md.energy_budget),
        kind_(kind_of(derived.laws.pairs[0])),
        skin_(derived.grains.mean_diameter),
        dt_(*derived.md_dt),
        guard_(scene, derived, kind_.hertz),
        pass_(Kernel{scene.md.energy_budget || !plain(derived.laws.pairs), kind_.hertz, scene.md.energy_budget}),
        grain_pass_(pass_.instructions()) {
    for (const PairLaw& law : laws_) terms_.push_back(terms_of<D>(law));
    contacts_.varying_stiffness = carried_.varying_stiffness = kind_.hertz;
    bodies_.start(scene, derived, sample);
    if (relaxers_.on() && !bodies_.rigid.none())
      throw InputError("md.drag and md.acceleration_damping are refused with rigid bodies: they act on grains alone");
    body_pass_.start(bodies_);
    order_.start(bodies_.grains());
    seen_.gradient = bodies_.cell.rate;
    seen_.grains.resize(bodies_.grains());
    for (int i = 0; i < bodies_.grains(); ++i) {
      seen_.grains.put_position(i, bodies_.position[i]);
      seen_.grains.put_velocity(i, bodies_.velocity[i]);
      if constexpr (Y.friction) seen_.grains.put_spin(i, bodies_.spin[i], bodies_.radius[i]);
    }
    states_.take(bodies_);
    equal_pairs_ = pairs_are_equal();
    mode_acceleration_.assign(bodies_.modes.size(), 0.0);
    for (const double skin : {skin_.widest(), skin_.first()}) {
      list_.configure(range_, skin, skin_.widest());
      rebuild_list();
    }
    evaluate(0);
    guard_.neighbours(contacts_, list_, bodies_, order_.number(), time());
    states_.forget_before(bodies_.grains());
    body_pass_.forget_before();
    mode_before_ = mode_acceleration_;
  }

  std::string_view name() const override { return "md"; }
  Layout layout() const override { return Y; }
  double dt() const override { return dt_; }
  double time() const override { return static_cast<double>(steps_) * dt_; }
  long steps() const override { return steps_; }
  const Profile& profile() const override { return profile_; }

  MemoryUse memory() const override {
    MemoryUse use = list_.memory();
    use += contacts_.memory();
    use += carried_.memory();
    use.grains += bodies_.bytes() + seen_.grains.bytes() + states_.bytes() + body_pass_.bytes();
    use.grains += order_.bytes() + shown_.bytes() + sweep_.bytes();
    return use;
  }

  void advance(long count) override {
    for (long k = 0; k < count; ++k) {
      if (k == 0 || !joined()) begin_step();
      refresh_neighbours();
      end_step(k + 1 < count && joined());
    }
    fetch_positions();
    states_.give(bodies_);
    bodies_.follow_velocities();
  }

  /// Accelerations belong to the loading: they jump with it. A component that stops being driven in stress, or starts
  /// to be, gives or takes the cell's energy at once: that is work of the drives.
  void change(const Scene& scene, const Derived& derived) override {
    const double energy_before = account_ ? energy().total() : 0;
    const Mat<D> virial = contact_virial() + kinetic_virial(bodies_, states_);
    const double power_before = drive_power(bodies_.modes, virial, bodies_.cell.volume());
    const Mat<D> rate = bodies_.cell.rate;
    const Vec<D> gravity = bodies_.gravity;
    bodies_.change_loading(scene, derived);
    laws_ = derived.laws.pairs;
    terms_.clear();
    for (const PairLaw& law : laws_) terms_.push_back(terms_of<D>(law));
    for (int i = 0; i < bodies_.grains(); ++i)
      states_.shift(i, (rate - bodies_.cell.rate) * states_.velocity(i) + bodies_.gravity - gravity);
    body_pass_.shift(bodies_, Mat<D>(bodies_.cell.rate - rate), Vec<D>(bodies_.gravity - gravity));
    mode_acceleration_.assign(bodies_.modes.size(), 0.0);
    accelerate_modes(virial, 0);
    mode_before_ = mode_acceleration_;
    if (account_)
      energy_account_.change(energy().total() - energy_before,
                             drive_power(bodies_.modes, virial, bodies_.cell.volume()) - power_before);
  }

  Snapshot<D> snapshot() override {
    fill_contacts();
    Snapshot<D> shown = bodies_.view();
    if (!order_.same()) {
      shown_.show_grains(bodies_, order_.number(), shown);
      shown_.number_contacts(order_.number());
    }
    shown.engine = name();
    shown.time = time();
    shown.contacts = &shown_.contacts;
    return shown;
  }

  EnergyParts energy() const override {
    EnergyParts parts = bodies_.energy();
    for (std::size_t row = 0; row < list_.size(); ++row)
      add_contact_energy(contacts_, row, kind_, terms_[contacts_.law(row)], frame_of(row), parts);
    return parts;
  }

  EnergyFlows energy_flows() const override { return energy_account_.flows(); }

  void save(Archive& archive) const override {
    bodies_.save(archive);
    list_.save(archive, order_.number());
    contacts_.save(archive);
    states_.save(archive, bodies_.grains());
    order_.save(archive);
    for (const char* start :
         {"grains.", "md.acceleration.linear", "md.acceleration.angular", "md.acceleration_expected."})
      order_.to_numbers(archive, start);
    body_pass_.save(archive);
    archive.reals["md.acceleration.modes"] = mode_acceleration_;
    archive.reals["md.acceleration_before.modes"] = mode_before_;
    energy_account_.save(archive);
    archive.reals["md.dt"] = {dt_};
    archive.integers["steps"] = {steps_};
    archive.integers["md.list_age"] = {list_age_};
  }

  void restore(const Archive& archive) override {
    bodies_.rearrange(order_.back());
    order_.start(bodies_.grains());
    bodies_.restore(archive);
    list_.restore(archive, bodies_.grains());
    carried_.restore(archive, list_, bodies_.grains());
    contacts_.carry(carried_, list_, bodies_.grains());
    states_.restore(archive, bodies_);
    rearrange(order_.restore(archive));
    seen_.grains.make_room(contacts_.record_count(bodies_.grains()));
    equal_pairs_ = pairs_are_equal();
    set_row_constants();
    energy_account_.restore(archive);
    body_pass_.restore(archive);
    for (int i = 0; i < bodies_.grains(); ++i) seen_.grains.put_position(i, bodies_.position[i]);
    list_bound_.forget();
    take_column(archive, "md.acceleration.modes", mode_acceleration_);
    take_column(archive, "md.acceleration_before.modes", mode_before_);
    dt_ = real_column(archive, "md.dt").at(0);
    steps_ = integer_column(archive, "steps").at(0);
    list_age_ = integer_column(archive, "md.list_age").at(0);
  }

 private:
  /// Whether the plain kernels have all the terms that the laws need.
  static bool plain(const std::vector<PairLaw>& laws) {
    return laws.size() == 1 && laws[0].cohesion == 0 && laws[0].tangential_damping_ratio == 0;
  }

  /// Whether the end of a step and the beginning of the next are one loop over the grains.
  bool joined() const { return !bodies_.stress_driven() && !account_ && !relaxers_.on(); }

  void begin_step() {
    StageTimer timer(profile_, Stage::grains);
    kick_modes();
    const double fastest = grain_pass_.drift(bodies_, states_, seen_, dt_);
    predict_modes();
    list_bound_.moved(std::max(fastest, drift_rigid()), bodies_.cell.rate, dt_);
  }

  void refresh_neighbours() {
    StageTimer timer(profile_, Stage::neighbours);
    ++list_age_;
    bool expired = skin_.too_wide(list_.skin(), list_age_);
    if (!expired && (list_bound_.exceeds(list_.allowance(bodies_.cell)) || !bodies_.planes.empty() ||
                     list_age_ % longest_unchecked == 0)) {
      fetch_positions();
      expired = list_.expired(bodies_.position, bodies_.cell, bodies_.planes);
      list_bound_.set(list_.largest_move());
    }
    if (expired) update_neighbours();
  }

  /// The contact pass and the end of the step; with `go_on` the beginning of the next one too.
  void end_step(bool go_on) {
    if (!go_on) {
      evaluate(dt_);
    } else {
      const double fastest = sweep();
      StageTimer timer(profile_, Stage::grains);
      gather_rigid(0.5 * dt_);
      list_bound_.moved(std::max(fastest, drift_rigid()), bodies_.cell.rate, dt_);
    }
    ++steps_;
  }

  /// Contacts, the end of the step and the beginning of the next one, but for rigid bodies. Returns as the drift does.
  double sweep() {
    const PassView rows = pass_.begin(bodies_, seen_, pass_law(dt_, false), contacts_);
    const std::size_t parts = sweep_.plan(list_, contacts_.block_count());
    const double fastest =
        grain_pass_.step(bodies_, states_, seen_, list_, contacts_, dt_, parts, [&](const auto& grains) {
          const auto evaluate = [&](std::size_t begin, std::size_t end) { pass_.evaluate(rows, begin, end); };
          sweep_.run(list_.first(), evaluate, grains, profile_);
        });
    watch_stiffness();
    return fastest;
  }

  double drift_rigid() { return bodies_.rigid.none() ? 0 : body_pass_.drift(bodies_, states_, seen_, dt_); }
  void gather_rigid(double kick) {
    if (!bodies_.rigid.none()) body_pass_.gather(bodies_, states_, seen_, list_, contacts_, kick);
  }

  PassLaw pass_law(double dt, bool virial_wanted) const {
    return {terms_, kind_, range_, 0.5 * dt, 0.5 * dt_, virial_wanted};
  }

  PassSums<D> evaluate_contacts(double dt, bool virial_wanted) {
    StageTimer timer(profile_, Stage::contacts);
    const PassSums<D> sums = pass_.run(bodies_, seen_, pass_law(dt, virial_wanted), contacts_);
    watch_stiffness();
    return sums;
  }

  /// Forces, accelerations and the closing half kick. `dt`: time since the last evaluation, 0 at the start.
  void evaluate(double dt) {
    const bool virial_wanted = bodies_.stress_driven() || account_;
    const PassSums<D> sums = evaluate_contacts(dt, virial_wanted);
    double relaxed = 0;
    Mat<D> kinetic;
    {
      StageTimer timer(profile_, Stage::grains);
      kinetic = grain_pass_.gather(bodies_, states_, seen_, list_, contacts_, 0.5 * dt, virial_wanted);
      gather_rigid(0.5 * dt);
      kinetic += bodies_.rigid_kinetic_virial();
      GALET_ENSURE(forces_balance(), "contact forces add up to zero over the grains and planes");
      if (relaxers_.on()) {
        relaxed = relax(bodies_, states_, seen_, relaxers_, 0.5 * dt, partial_power_);
        kinetic = kinetic_virial(bodies_, states_);
      }
    }
    StageTimer timer(profile_, Stage::drives);
    Mat<D> virial = sums.virial + kinetic;
    if (!bodies_.rigid.none()) virial -= body_pass_.arm_virial();
    bodies_.advance_loads(dt);
    if (bodies_.stress_driven()) accelerate_modes(virial, 0.5 * dt);
    if (!account_) return;
    const double work = endless_fall() + sums.plane_power + drive_power(bodies_.modes, virial, bodies_.cell.volume()) +
                        body_pass_.drive_power(bodies_);
    energy_account_.add({work, sums.normal, sums.sliding, sums.rolling, sums.pivoting, relaxed}, dt);
  }

  /// Power of gravity along periodic directions.
  double endless_fall() const {
    const Vec<D> gravity = bodies_.endless_gravity();
    if (gravity.isZero(0)) return 0;
    double power = 0;
    for (int i = 0; i < bodies_.grains(); ++i)
      if (bodies_.rigid.free(i)) power += bodies_.mass[i] * gravity.dot(states_.velocity(i));
    for (const RigidBody<D>& body : bodies_.rigid.body) power += body.mass * gravity.dot(body.velocity);
    return power;
  }

  /// Positions live in the records while steps are taken.
  void fetch_positions() {
    for (int i = 0; i < bodies_.grains(); ++i) bodies_.position[i] = seen_.grains.position(i);
  }

  /// Now and then: what is coordinated better than dt was chosen for.
  void watch_stiffness() {
    if (steps_ % 128 != 0 || !guard_.watches_stiffness()) return;
    fetch_positions();
    guard_.stiffness(contacts_, list_, order_.number(), time(), [this](std::size_t row) { return frame_of(row); });
  }

  /// Whether the sum of m (a + L v - gravity) and the forces on rigid bodies is that of the forces from planes (action
  /// and reaction).
  bool forces_balance() const {
    Vec<D> sum = Vec<D>::Zero(), from_planes = Vec<D>::Zero();
    double scale = 1e-300;
    for (int i = 0; i < bodies_.grains(); ++i)
      if (bodies_.rigid.free(i))
        sum +=
            bodies_.mass[i] * (states_.acceleration(i) + seen_.gradient * seen_.grains.velocity(i) - bodies_.gravity);
    sum += body_pass_.contact_force();
    for (std::size_t row = 0; row < list_.size(); ++row) {
      scale += contacts_.force(row).norm();
      if (list_.pairs().j[row] >= bodies_.grains()) from_planes -= contacts_.force(row);
    }
    for (int i = 0; i < bodies_.grains(); ++i)
      scale += bodies_.mass[i] * ((seen_.gradient * seen_.grains.velocity(i)).norm() + bodies_.gravity.norm());
    // Rounding of sums of this many terms; anything systematic is far above.
    return !((sum - from_planes).norm() > 1e-10 * scale);
  }

  void kick_modes() {
    if (bodies_.modes.empty()) return;
    for (std::size_t k = 0; k < bodies_.modes.size(); ++k) bodies_.modes[k].rate += 0.5 * dt_ * mode_acceleration_[k];
    bodies_.cell.rate = velocity_gradient(bodies_.modes);
  }

  void predict_modes() {
    seen_.gradient = bodies_.cell.rate;
    for (std::size_t k = 0; k < bodies_.modes.size(); ++k)
      seen_.gradient += 0.5 * dt_ * expected(mode_acceleration_[k], mode_before_[k]) * bodies_.modes[k].direction;
  }

  void accelerate_modes(const Mat<D>& virial, double kick_dt) {
    const double volume = bodies_.cell.volume();
    for (std::size_t k = 0; k < bodies_.modes.size(); ++k) {
      CellMode<D>& mode = bodies_.modes[k];
      if (!mode.stress_driven) continue;
      mode_acceleration_[k] = (virial.cwiseProduct(mode.direction).sum() - volume * mode.load) / mode.inertia;
      mode.rate += kick_dt * mode_acceleration_[k];
    }
    bodies_.cell.rate = velocity_gradient(bodies_.modes);
  }

  /// Sum over the contacts of F (x) b, between centres of bodies, by the forces of the last evaluation.
  Mat<D> contact_virial() const {
    Mat<D> sum = Mat<D>::Zero();
    for (std::size_t row = 0; row < list_.size(); ++row)
      if (contacts_.acts(row) && list_.pairs().j[row] < bodies_.grains())
        sum += contacts_.force(row) * frame_of(row).branch.transpose();
    return sum - body_pass_.arm_virial();
  }

  void update_neighbours() {
    const double idle = static_cast<double>(list_.size() - contacts_.touching()) / bodies_.grains();
    const double skin = skin_.next(list_.skin(), list_age_, idle);
    list_.configure(range_, skin, skin_.outer(skin, idle / list_.skin()));
    rebuild_list();
  }

  void rebuild_list() {
    list_age_ = 0;
    list_bound_.set(0);
    fetch_positions();
    const std::span<const int> group = bodies_.rigid.group;
    const bool narrowed =
        list_.narrow(bodies_.position, bodies_.radius, bodies_.cell, bodies_.planes, group, order_.number());
    if (!narrowed && order_.decayed()) rearrange(order_.sorted(bodies_.cell, bodies_.position));
    if (!narrowed) guard_.neighbours(contacts_, list_, bodies_, order_.number(), time());
    std::swap(contacts_, carried_);
    if (!narrowed) {
      list_.build(bodies_.position, bodies_.radius, bodies_.cell, bodies_.planes, group, order_.number());
      order_.look_at(list_.pairs());
      // Building wraps the grains into the cell.
      for (int i = 0; i < bodies_.grains(); ++i) seen_.grains.put_position(i, bodies_.position[i]);
    }
    contacts_.carry(carried_, list_, bodies_.grains());
    seen_.grains.make_room(contacts_.record_count(bodies_.grains()));
    set_row_constants();
  }

  /// Another order of the grains in memory; contacts keep what they remember.
  void rearrange(const Permutation& step) {
    if (step.identity()) return;
    bodies_.rearrange(step);
    states_.rearrange(step);
    seen_.grains.rearrange(step);
    list_.renumber(step);
    std::swap(contacts_, carried_);
    contacts_.carry(carried_, list_, bodies_.grains());
    order_.moved(step);
  }

  /// What the laws need of each row's two grains; the rows have changed.
  void set_row_constants() {
    sweep_.forget();
    const PairColumns<D>& pairs = list_.pairs();
    const int grains = bodies_.grains();
    for (std::size_t row = 0; row < list_.size(); ++row) {
      const int i = pairs.i[row], j = pairs.j[row];
      const int other = j >= grains ? bodies_.plane_material[j - grains] : bodies_.material[j];
      contacts_.block_of(row).law[row % block_rows] =
          static_cast<std::uint8_t>(bodies_.material[i] * materials_ + other);
    }
    contacts_.set_constants(equal_pairs_, [&](std::size_t row) -> std::array<double, 3> {
      const int i = pairs.i[row], j = pairs.j[row];
      const bool plane = j >= grains;
      const double radius = bodies_.radius[i];
      const double curvature =
          plane ? reduced_radius_at(bodies_.planes[j - grains], radius) : reduced_radius(radius, bodies_.radius[j]);
      const double coefficient = normal_coefficient(laws_[contacts_.law(row)], curvature);
      return {plane ? radius : radius + bodies_.radius[j], coefficient,
              critical_damping(kind_, coefficient, bodies_.reduced_mass(i, j))};
    });
  }

  /// Whether all pairs have the same constants: one kind of grains, no planes, no rigid bodies.
  bool pairs_are_equal() const {
    if (!bodies_.planes.empty() || !bodies_.rigid.none() || laws_.size() > 1) return false;
    for (int i = 1; i < bodies_.grains(); ++i)
      if (bodies_.radius[i] != bodies_.radius[0] || bodies_.mass[i] != bodies_.mass[0]) return false;
    return true;
  }

  ContactFrame<D> frame_of(std::size_t row) const {
    const PairColumns<D>& pairs = list_.pairs();
    const int i = pairs.i[row], j = pairs.j[row];
    if (j >= bodies_.grains())
      return plane_frame<D>(bodies_.position[i], bodies_.radius[i], bodies_.planes[j - bodies_.grains()]);
    const Vec<D> branch = bodies_.position[j] - bodies_.position[i] + lattice<D>(bodies_.cell.box, pairs.image[row]);
    return grain_frame<D>(branch, branch.squaredNorm(), bodies_.radius[i], bodies_.radius[j]);
  }

  void fill_contacts() {
    ContactColumns<D>& shown = shown_.contacts;
    shown.clear();
    for (std::size_t row = 0; row < list_.size(); ++row) {
      if (!contacts_.acts(row)) continue;
      const ContactFrame<D> frame = frame_of(row);
      shown.i.push_back(list_.pairs().i[row]);
      shown.j.push_back(list_.pairs().j[row]);
      shown.image.push_back(list_.pairs().image[row]);
      shown.normal.push_back(frame.normal);
      shown.branch.push_back(frame.branch);
      shown.gap.push_back(frame.gap);
      shown.force.push_back(contacts_.force(row));
      if constexpr (Y.rolling) shown.torque.push_back(contacts_.torque(row));
      if constexpr (Y.friction)
        shown.mobilised.push_back(mobilised_friction(kind_, terms_[contacts_.law(row)], contacts_.coefficient(row),
                                                     frame, contacts_.force(row)));
      if (range_ > 0) shown.touching.push_back(contacts_.touches(row));
    }
  }

  int materials_;
  double range_;               ///< largest D0
  std::vector<PairLaw> laws_;  ///< by pair of materials
  std::vector<PairTerms<double>> terms_;
  Relaxers relaxers_;
  bool account_;
  bool equal_pairs_ = false;
  LawKind kind_;
  Skin skin_;
  double dt_;
  StepGuard<Y> guard_;
  long steps_ = 0;
  long list_age_ = 0;  ///< steps since the neighbour list was built
  MoveBound list_bound_;

  Bodies<Y> bodies_;
  Seen<Y> seen_;
  GrainStates<Y> states_;
  std::vector<double> mode_acceleration_, mode_before_;  ///< of the cell's rates, now and a step ago
  VerletList<D> list_;
  Contacts<Y> contacts_, carried_;
  ContactPass<Y> pass_;
  GrainPass<Y> grain_pass_;
  Sweep sweep_;
  BodyPass<Y> body_pass_;
  GrainOrder<D> order_;
  Shown<Y> shown_;
  std::vector<double> partial_power_;
  EnergyAccount energy_account_;
  Profile profile_;
};

}  // namespace galet::md
