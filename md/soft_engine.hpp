// The md step as a sequence of stages:
//
//   drift -> neighbours (only if a pair could be missed) -> contacts (contact pass) -> grains (grain pass) -> drives
//
// Contact pass: one row per listed pair. Grain pass: each grain gathers its rows in a fixed order. Drives: the
// stress-driven modes of the cell, with the same time scheme as the grains.
#pragma once

#include <string_view>

#include "common/core/error.hpp"
#include "common/engine/bodies.hpp"
#include "common/neighbour/verlet_list.hpp"
#include "md/contact_pass.hpp"
#include "md/contacts.hpp"
#include "md/grain_pass.hpp"

namespace galet::md {

template <Layout Y>
class SoftEngine final : public Engine<Y.dim> {
 public:
  static constexpr int D = Y.dim;

  SoftEngine(const Scene& scene, const Derived& derived, const Sample<D>& sample)
      : soft_(*derived.soft), friction_(derived.friction), dt_(*derived.md_dt) {
    bodies_.start(scene, derived, sample);
    const std::size_t grains = bodies_.position.size();
    seen_.velocity = bodies_.velocity;
    seen_.gradient = bodies_.cell.rate;
    if constexpr (Y.friction) seen_.spin = bodies_.spin;
    acceleration_.linear.assign(grains, Vec<D>::Zero());
    if constexpr (Y.friction) acceleration_.angular.assign(grains, zero_spin<D>());
    acceleration_.modes.assign(bodies_.modes.size(), 0.0);
    list_.configure(0, 0.15 * derived.grains.mean_diameter);
    update_neighbours();
    evaluate(0);
  }

  std::string_view name() const override { return "md"; }
  Layout layout() const override { return Y; }
  double dt() const override { return dt_; }
  double time() const override { return static_cast<double>(steps_) * dt_; }
  long steps() const override { return steps_; }
  const Profile& profile() const override { return profile_; }

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

  EnergyParts energy() const override {
    EnergyParts parts = bodies_.energy();
    for (std::size_t row = 0; row < list_.size(); ++row) {
      if (!contacts_.touching[row]) continue;
      const ContactFrame<D> frame = frame_of(row);
      parts.elastic_normal += 0.5 * soft_.normal_stiffness * frame.gap * frame.gap;
      if constexpr (Y.friction) {
        const Vec<D> tangential = contacts_.force[row] - contacts_.force[row].dot(frame.normal) * frame.normal;
        if (soft_.tangential_stiffness > 0)
          parts.elastic_tangential += 0.5 * tangential.squaredNorm() / soft_.tangential_stiffness;
      }
    }
    return parts;
  }

  void save(Archive& archive) const override {
    bodies_.save(archive);
    list_.save(archive);
    contacts_.save(archive);
    put_column(archive, "md.acceleration", acceleration_.linear);
    if constexpr (Y.friction) put_column(archive, "md.angular_acceleration", acceleration_.angular);
    archive.reals["md.mode_acceleration"] = acceleration_.modes;
    archive.reals["md.dt"] = {dt_};
    archive.integers["steps"] = {steps_};
  }

  void restore(const Archive& archive) override {
    bodies_.restore(archive);
    list_.restore(archive, bodies_.grains());
    contacts_.restore(archive, list_.size());
    take_column(archive, "md.acceleration", acceleration_.linear);
    if constexpr (Y.friction) take_column(archive, "md.angular_acceleration", acceleration_.angular);
    take_column(archive, "md.mode_acceleration", acceleration_.modes);
    dt_ = real_column(archive, "md.dt").at(0);
    steps_ = integer_column(archive, "steps").at(0);
  }

 private:
  void step() {
    {
      StageTimer timer(profile_, Stage::grains);
      kick_modes();
      drift(bodies_, acceleration_, seen_, dt_);
      predict_modes();
    }
    {
      StageTimer timer(profile_, Stage::neighbours);
      if (list_.expired(bodies_.position, bodies_.cell, bodies_.planes)) update_neighbours();
    }
    evaluate(dt_);
    ++steps_;
  }

  /// Forces, accelerations and the closing half kick. `dt`: time since the last evaluation, 0 at the start.
  void evaluate(double dt) {
    const PassLaw law{
        soft_.normal_stiffness, soft_.convention, {soft_.tangential_stiffness, friction_, 0.5 * dt, 0.5 * dt_}, dt};
    Mat<D> virial;
    {
      StageTimer timer(profile_, Stage::contacts);
      virial = pass_.run(bodies_, seen_, list_, law, contacts_);
    }
    {
      StageTimer timer(profile_, Stage::grains);
      gather(bodies_, seen_, list_, contacts_, acceleration_, 0.5 * dt);
    }
    GALET_ENSURE(forces_balance(), "contact forces add up to zero over the grains and planes");
    StageTimer timer(profile_, Stage::drives);
    if (bodies_.stress_driven()) accelerate_modes(virial + kinetic_virial(bodies_, partial_), 0.5 * dt);
  }

  /// Whether the sum of m (a + L v - gravity) is that of the forces from planes (action and reaction).
  bool forces_balance() const {
    Vec<D> sum = Vec<D>::Zero(), from_planes = Vec<D>::Zero();
    double scale = 1e-300;
    for (int i = 0; i < bodies_.grains(); ++i)
      sum += bodies_.mass[i] * (acceleration_.linear[i] + seen_.gradient * seen_.velocity[i] - bodies_.gravity);
    for (std::size_t row = 0; row < list_.size(); ++row) {
      scale += contacts_.force[row].norm();
      if (list_.pairs().j[row] >= bodies_.grains()) from_planes -= contacts_.force[row];
    }
    for (int i = 0; i < bodies_.grains(); ++i)
      scale += bodies_.mass[i] * ((seen_.gradient * seen_.velocity[i]).norm() + bodies_.gravity.norm());
    // Rounding of sums of this many terms; anything systematic is far above.
    return !((sum - from_planes).norm() > 1e-10 * scale);
  }

  void kick_modes() {
    if (bodies_.modes.empty()) return;
    for (std::size_t k = 0; k < bodies_.modes.size(); ++k) bodies_.modes[k].rate += 0.5 * dt_ * acceleration_.modes[k];
    bodies_.cell.rate = velocity_gradient(bodies_.modes);
  }

  void predict_modes() {
    seen_.gradient = bodies_.cell.rate;
    for (std::size_t k = 0; k < bodies_.modes.size(); ++k)
      seen_.gradient += 0.5 * dt_ * acceleration_.modes[k] * bodies_.modes[k].direction;
  }

  void accelerate_modes(const Mat<D>& virial, double kick_dt) {
    const double volume = bodies_.cell.volume();
    for (std::size_t k = 0; k < bodies_.modes.size(); ++k) {
      CellMode<D>& mode = bodies_.modes[k];
      if (!mode.stress_driven) continue;
      acceleration_.modes[k] = (virial.cwiseProduct(mode.direction).sum() - volume * mode.load) / mode.inertia;
      mode.rate += kick_dt * acceleration_.modes[k];
    }
    bodies_.cell.rate = velocity_gradient(bodies_.modes);
  }

  void update_neighbours() {
    std::swap(contacts_, carried_);
    list_.build(bodies_.position, bodies_.radius, bodies_.cell, bodies_.planes);
    contacts_.carry(carried_, list_);
    const PairColumns<D>& pairs = list_.pairs();
    for (std::size_t row = 0; row < list_.size(); ++row) {
      const double mass_i = bodies_.mass[pairs.i[row]];
      const double reduced = pairs.j[row] < bodies_.grains()
                                 ? mass_i * bodies_.mass[pairs.j[row]] / (mass_i + bodies_.mass[pairs.j[row]])
                                 : mass_i;
      contacts_.damping[row] = soft_.damping_ratio * 2 * std::sqrt(reduced * soft_.normal_stiffness);
    }
  }

  ContactFrame<D> frame_of(std::size_t row) const {
    const PairColumns<D>& pairs = list_.pairs();
    const int i = pairs.i[row], j = pairs.j[row];
    if (j >= bodies_.grains())
      return plane_frame<D>(bodies_.position[i], bodies_.radius[i], bodies_.planes[j - bodies_.grains()]);
    const Vec<D> branch = bodies_.position[j] - bodies_.position[i] + lattice<D>(bodies_.cell.box, pairs.image[row]);
    return grain_frame<D>(branch, branch.squaredNorm(), bodies_.radius[i], bodies_.radius[j]);
  }

  void fill_shown() {
    shown_.clear();
    for (std::size_t row = 0; row < list_.size(); ++row) {
      if (!contacts_.touching[row]) continue;
      const ContactFrame<D> frame = frame_of(row);
      shown_.i.push_back(list_.pairs().i[row]);
      shown_.j.push_back(list_.pairs().j[row]);
      shown_.image.push_back(list_.pairs().image[row]);
      shown_.normal.push_back(frame.normal);
      shown_.branch.push_back(frame.branch);
      shown_.gap.push_back(frame.gap);
      shown_.force.push_back(contacts_.force[row]);
    }
  }

  SoftContact soft_;
  double friction_;
  double dt_;
  long steps_ = 0;

  Bodies<Y> bodies_;
  Seen<Y> seen_;
  Accelerations<Y> acceleration_;
  VerletList<D> list_;
  Contacts<Y> contacts_, carried_;
  ContactPass<Y> pass_;
  ContactColumns<D> shown_;
  std::vector<Mat<D>> partial_;
  Profile profile_;
};

}  // namespace galet::md
