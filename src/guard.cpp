#include "src/guard.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "common/core/error.hpp"

namespace galet {

namespace {

double norm(const std::vector<double>& values) {
  double sum = 0;
  for (double value : values) sum += value * value;
  return std::sqrt(sum);
}

double largest_cohesion(const LawTable& laws) {
  double largest = 0;
  for (const PairLaw& law : laws.pairs) largest = std::max(largest, law.cohesion);
  return largest;
}

/// v_s of the header.
template <int D>
double scene_speed(const Scene& scene, const Derived& derived, const Sample<D>& start, EngineKind engine) {
  const double mass = derived.grains.mean_mass, diameter = derived.grains.mean_diameter;
  const double size = start.cell.box.colwise().norm().maxCoeff();
  double speed = derived.grains.largest_speed;
  const auto count = [&](double other) { speed = std::max(speed, other); };
  const auto count_force = [&](double force) { count(std::sqrt(std::abs(force) * diameter / mass)); };
  for (const CellMode<D>& mode : cell_modes(scene, derived, start)) count(std::abs(mode.rate) * size);
  for (const Plane<D>& plane : start.planes) {
    count(plane.velocity.norm()), count_force(plane.force);
    if (plane.curved()) count(std::sqrt(squared(plane.spin)) * plane.radius);
  }
  for (const BodySpec& body : scene.bodies) {
    count(norm(body.velocity)), count(norm(body.spin) * size);
    count_force(norm(body.force)), count_force(norm(body.torque) / diameter);
  }
  count(std::sqrt(2 * norm(scene.loading.gravity) * size));
  if (derived.pressure) count_force(*derived.pressure * std::pow(diameter, D - 1));
  count_force(largest_cohesion(derived.laws));
  if (engine == EngineKind::md && derived.contact_stiffness)
    count(1e-3 * diameter * std::sqrt(*derived.contact_stiffness / mass));
  return speed;
}

bool finite(double value) { return std::isfinite(value); }
bool finite(const Vec<3>& value) { return value.allFinite(); }

}  // namespace

template <int D>
Guard<D>::Guard(const Scene& scene, const Derived& derived, const Sample<D>& start, EngineKind engine)
    : bounds_(scene.guard),
      own_speed_(scene_speed(scene, derived, start, engine)),
      mass_(derived.grains.mean_mass),
      smaller_step_(engine == EngineKind::md ? "lower md.dt (or raise md.steps_per_contact)"
                                             : "lower cd.dt (or cd.dt_factor)"),
      stiffer_(engine == EngineKind::md ? "raise the material's stiffness or lower the load, or lower md.dt"
                                        : "lower cd.tolerance or cd.dt") {}

template <int D>
void Guard<D>::check(const Snapshot<D>& snapshot) const {
  check_grains(snapshot);
  check_contacts(snapshot);
}

template <int D>
void Guard<D>::check_grains(const Snapshot<D>& snapshot) const {
  double energy = 0;
  for (int i = 0; i < snapshot.grains(); ++i) {
    const bool sound = snapshot.position[i].allFinite() && snapshot.velocity[i].allFinite() &&
                       (snapshot.spin.empty() || finite(snapshot.spin[i]));
    if (!sound)
      throw RunError(
          fmt::format("at time {:.6g} the state of grain {} is not finite: {}", snapshot.time, i, smaller_step_));
    const double speed = snapshot.velocity[i].norm();
    if (own_speed_ > 0 && speed > bounds_.speed * own_speed_)
      throw RunError(fmt::format(
          "at time {:.6g} grain {} moves at {:.3g}, {:.3g} times the scene's own speed {:.3g} (guard.speed = {:g}): {}",
          snapshot.time, i, speed, speed / own_speed_, own_speed_, bounds_.speed, smaller_step_));
    energy += 0.5 * snapshot.mass[i] * speed * speed;
    for (std::size_t p = 0; p < snapshot.planes.size(); ++p)
      if (distance_from<D>(snapshot.planes[p], snapshot.position[i]) < 0)
        throw RunError(fmt::format("at time {:.6g} grain {} is behind {}: {}", snapshot.time, i,
                                   boundary_name(snapshot.planes, p), smaller_step_));
  }
  const double unit = 0.5 * mass_ * own_speed_ * own_speed_;
  const double mean = snapshot.grains() > 0 ? energy / snapshot.grains() : 0;
  if (unit > 0 && mean > bounds_.energy * unit)
    throw RunError(
        fmt::format("at time {:.6g} the kinetic energy per grain is {:.3g}, {:.3g} times that of the scene's own speed "
                    "{:.3g} (guard.energy = {:g}): {}",
                    snapshot.time, mean, mean / unit, own_speed_, bounds_.energy, smaller_step_));
}

template <int D>
void Guard<D>::check_contacts(const Snapshot<D>& snapshot) const {
  const ContactColumns<D>& contacts = *snapshot.contacts;
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const int i = contacts.i[c], j = contacts.j[c];
    const bool plane = j >= snapshot.grains();
    const double radius = plane ? snapshot.radius[i] : std::min(snapshot.radius[i], snapshot.radius[j]);
    if (!(-contacts.gap[c] > bounds_.overlap * radius)) continue;
    throw RunError(fmt::format(
        "at time {:.6g} grain {} and {} {} overlap by {:.3g}, {:.3g} of the smaller radius (guard.overlap = {:g}): {}",
        snapshot.time, i, plane ? "plane" : "grain", plane ? j - snapshot.grains() : j, -contacts.gap[c],
        -contacts.gap[c] / radius, bounds_.overlap, stiffer_));
  }
}

template class Guard<2>;
template class Guard<3>;

}  // namespace galet
