#include "common/scene/md_step.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/scene/loading.hpp"

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
  const double stress = std::max(derived.pressure.value_or(0), largest_stress(scene.loading));
  found.force = (peaks ? 8 : 1) * stress * std::pow(d, scene.dimension - 1);
  const double layers = std::pow(grains.count, 1.0 / scene.dimension);
  found.force = std::max(found.force, (peaks ? 4 : 1) * grains.mean_mass * norm(scene.loading.gravity) * layers);
  found.force += law.cohesion;
  double moving = 2 * grains.largest_speed;
  for (const PlaneSpec& plane : scene.planes) moving = std::max(moving, grains.largest_speed + norm(plane.velocity));
  for (const CylinderSpec& cylinder : scene.cylinders)
    moving = std::max(moving, grains.largest_speed + surface_speed(cylinder));
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

/// Neighbours in crystals; packings stay below, as long as they are not pressed together by a tenth of d.
double crystal_neighbours(int dim) { return dim == 2 ? 6 : 12; }

/// Stability bound of the step. Stiffest modes of a packing whose lightest grain has z neighbours, in units of
/// K_N / m_least:
///   translations            z
///   all spins alike         2 z (K_T/K_N) (m R^2/I), in 3D 2/3 of it: every contact slides by both spins
///   spins against another   2 z K_R / (K_N I/m)
/// omega^2 is 1.15 times the largest one (of the sum of the last two), for unlike grains and mixed modes. Damping: with
/// c the rate of the mode's dashpots and zeta = c / (2 omega) the scheme is stable for
///   omega dt <= 1 / (0.5 + 2.75 zeta), with friction also <= 0.94
/// (largest eigenvalue of one step of an oscillator whose spring follows the position, or the velocities that contacts
/// see, or both: a fit below the scheme's own limit for every zeta <= 3).
double stable_dt(int dim, const PairLaw& law, double stiffness, const GrainFacts& grains, double neighbours) {
  const double gyration = dim == 2 ? inertia_ratio<2> : inertia_ratio<3>;  // I / (m R^2)
  const double mass = grains.least_mass;
  const double spinning = 2 / gyration * (dim == 2 ? 1 : 2.0 / 3);
  const double sliding = law.friction > 0 ? law.tangential_ratio * spinning : 0;
  const double lever = 2 * std::max(law.rolling_friction, law.pivoting_friction) / grains.least_diameter;
  const double turning = sliding + 2 * law.rolling_ratio * lever * lever / gyration;
  const double omega = std::sqrt(1.15 * neighbours * stiffness / mass * std::max(1.0, turning));
  // alpha_T of a pair is zeta_T sqrt(K_T/K_N k/(1 + k)) times the critical normal one, k = I / (m R^2).
  const double tangential =
      law.tangential_damping_ratio * std::sqrt(law.tangential_ratio * gyration / (1 + gyration)) * spinning;
  const double damping = std::max(law.damping_ratio, law.friction > 0 ? tangential : 0);
  const double zeta = damping * 2 * std::sqrt(mass / 2 * stiffness) * neighbours / mass / (2 * omega);
  const double limit = 1 / (0.5 + 2.75 * zeta);
  return (law.friction > 0 ? std::min(0.94, limit) : limit) / omega;
}

/// The neighbours that the lightest grain may have at this step: stable_dt falls with their number.
double neighbours_allowed(int dim, const PairLaw& law, double stiffness, const GrainFacts& grains, double dt) {
  double least = 0, most = 1e6;
  for (int k = 0; k < 60; ++k) {
    const double middle = 0.5 * (least + most);
    (stable_dt(dim, law, stiffness, grains, middle) >= dt ? least : most) = middle;
  }
  return most;
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
    bound = std::min(bound, stable_dt(scene.dimension, law, most, derived.grains, crystal_neighbours(scene.dimension)));
    // With strong damping the contact lasts long for reasons that a step must not follow: the undamped one bounds.
    for (const double zeta : {0.0, law.damping_ratio})
      shortest = std::min(shortest, collision_duration(zeta, law.convention, least, typical > 0 ? typical : most));
  }
  const PairLaw& base = derived.laws.at(0, 0);
  const double typical = *derived.contact_stiffness > 0 ? *derived.contact_stiffness : derived.md_stiffest;
  derived.collision_time = collision_duration(base.damping_ratio, base.convention, mean, typical);
  derived.md_dt_stable = bound;
  if (!derived.md_dt) derived.md_dt = std::min(shortest / scene.md.steps_per_contact, bound);
  derived.md_most_neighbours = std::numeric_limits<double>::infinity();
  for (const PairLaw& law : derived.laws.pairs)
    derived.md_most_neighbours =
        std::min(derived.md_most_neighbours,
                 neighbours_allowed(scene.dimension, law, derived.md_stiffest, derived.grains, *derived.md_dt));
}

}  // namespace galet
