#include "common/scene/md_step.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace galet {

namespace {

/// How strongly contacts are pressed, and how fast grains meet.
struct Severity {
  double force = 0;  ///< static, per contact
  double speed = 0;  ///< relative, of impacts
};

double norm(const std::vector<double>& components) {
  double sum = 0;
  for (const double x : components) sum += x * x;
  return std::sqrt(sum);
}

/// Mean loads. `peaks`: the largest ones of a packing (forces up to 8 times P d^(D-1), chains up to 4 times the mean
/// weight above) and of its collapse from a gas (a few d per inertial time).
Severity severity(const Scene& scene, const Derived& derived, const PairLaw& law, bool peaks) {
  const GrainFacts& grains = derived.grains;
  const double d = grains.mean_diameter;
  Severity found;
  if (derived.pressure) found.force = (peaks ? 8 : 1) * *derived.pressure * std::pow(d, scene.dimension - 1);
  const double layers = std::pow(grains.count, 1.0 / scene.dimension);
  found.force = std::max(found.force, (peaks ? 4 : 1) * grains.mean_mass * norm(scene.loading.gravity) * layers);
  found.force += law.cohesion;
  double moving = 2 * grains.largest_speed;
  for (const PlaneSpec& plane : scene.planes) moving = std::max(moving, grains.largest_speed + norm(plane.velocity));
  found.speed = moving;
  if (peaks && derived.inertial_time && scene.loading.kind != LoadingKind::none)
    found.speed = std::max(found.speed, 3 * d / *derived.inertial_time);
  return found;
}

/// K_N of a contact of two mean grains under such loads; 0 when nothing presses them (hertz only).
double stiffness_at(const Derived& derived, const PairLaw& law, const Severity& loads) {
  const double k = normal_coefficient(law, derived.grains.mean_diameter / 4);
  const double force =
      std::max(loads.force, impact_force(law.normal_law, k, derived.grains.mean_mass / 2, loads.speed));
  double stiffness = tangent_stiffness(law.normal_law, k, deflection_under(law.normal_law, k, force));
  // Attraction across a gap changes by F0 over D0: it must be resolved like a stiffness.
  if (law.cohesion_range > 0) stiffness = std::max(stiffness, law.cohesion / law.cohesion_range);
  return stiffness;
}

/// Stability bound of the step. Elastic part: the stiffest mode of a packing has
/// omega^2 <= 1.15 z K_N / m_least * max(1, (K_T/K_N) (1 + m R^2/I) + K_R / (K_N I/m)), z the largest number of
/// neighbours of the lightest grain (6 disks, 9 spheres): above every eigenvalue measured for K_T/K_N in 0 .. 0.8.
/// Damping: the damping rate of the stiffest mode is c = alpha z / m_least; with zeta = c / (2 omega) the scheme is
/// stable for omega dt <= 1 / (0.5 + 1.9 zeta) (a fit below the scheme's own limit for every zeta <= 3).
double stable_dt(int dim, const PairLaw& law, double stiffness, const GrainFacts& grains) {
  const double neighbours = dim == 2 ? 6 : 9;
  const double gyration = dim == 2 ? inertia_ratio<2> : inertia_ratio<3>;  // I / (m R^2)
  const double mass = grains.least_mass;
  const double sliding = law.friction > 0 ? law.tangential_ratio * (1 + 1 / gyration) : 0;
  const double lever = 2 * std::max(law.rolling_friction, law.pivoting_friction) / grains.least_diameter;
  const double turning = sliding + law.rolling_ratio * lever * lever / gyration;
  const double omega = std::sqrt(1.15 * neighbours * stiffness / mass * std::max(1.0, turning));
  const double damping = std::max(law.damping_ratio, law.tangential_damping_ratio * std::sqrt(sliding));
  const double alpha = damping * 2 * std::sqrt(mass / 2 * stiffness);
  const double zeta = alpha * neighbours / mass / (2 * omega);
  return 1 / (omega * (0.5 + 1.9 * zeta));
}

}  // namespace

void derive_md_step(const Scene& scene, Derived& derived) {
  derived.md_dt = scene.md.dt;
  if (!derived.laws.stiff) {
    derived.md_dt.reset();
    return;
  }
  double shortest = std::numeric_limits<double>::infinity(), bound = shortest;
  const double mean = derived.grains.mean_mass / 2, least = derived.grains.least_mass / 2;
  for (const PairLaw& law : derived.laws.pairs) {
    const double typical = stiffness_at(derived, law, severity(scene, derived, law, false));
    const double most = stiffness_at(derived, law, severity(scene, derived, law, true));
    if (most <= 0) return;
    derived.md_stiffest = std::max(derived.md_stiffest, most);
    derived.contact_stiffness = std::max(derived.contact_stiffness.value_or(0), typical);
    bound = std::min(bound, stable_dt(scene.dimension, law, most, derived.grains));
    // With strong damping the contact lasts long for reasons that a step must not follow: the undamped one bounds.
    for (const double zeta : {0.0, law.damping_ratio})
      shortest = std::min(shortest, collision_duration(zeta, law.convention, least, typical > 0 ? typical : most));
  }
  const PairLaw& base = derived.laws.at(0, 0);
  const double typical = *derived.contact_stiffness > 0 ? *derived.contact_stiffness : derived.md_stiffest;
  derived.collision_time = collision_duration(base.damping_ratio, base.convention, mean, typical);
  derived.md_dt_stable = bound;
  if (!derived.md_dt) derived.md_dt = std::min(shortest / scene.md.steps_per_contact, bound);
}

}  // namespace galet
