#include "common/scene/derive.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include <fmt/format.h>

#include "common/core/error.hpp"
#include "common/scene/packing.hpp"

namespace galet {

namespace {

constexpr double pi = std::numbers::pi;

/// Stability bound of the md step. Elastic part: the stiffest mode of a packing has
/// omega^2 <= 1.15 z K_N / m_least * max(1, (K_T/K_N) (1 + m R^2/I)), z the largest number of neighbours of the
/// lightest grain (6 disks, 9 spheres): above every eigenvalue measured for K_T/K_N in 0 .. 0.8. Damping: the normal
/// damping rate of the stiffest mode is c = alpha z / m_least; with zeta = c / (2 omega) the scheme is stable for
/// omega dt <= 1 / (0.5 + 1.9 zeta) (a fit below the scheme's own limit for every zeta <= 3).
double stable_dt(int dim, const SoftContact& soft, double least_mass) {
  const double neighbours = dim == 2 ? 6 : 9;
  const double turning = 1 + 1 / (dim == 2 ? inertia_ratio<2> : inertia_ratio<3>);
  const double ratio = soft.tangential_stiffness / soft.normal_stiffness;
  const double omega =
      std::sqrt(1.15 * neighbours * soft.normal_stiffness / least_mass * std::max(1.0, ratio * turning));
  const double alpha = soft.damping_ratio * 2 * std::sqrt(least_mass / 2 * soft.normal_stiffness);
  const double zeta = alpha * neighbours / least_mass / (2 * omega);
  return 1 / (omega * (0.5 + 1.9 * zeta));
}

double force_scale_power(int dim, double diameter) { return dim == 2 ? 1 : diameter; }

void derive_material(const Scene& scene, Derived& derived) {
  const MaterialSpec& material = scene.material;
  derived.friction = material.friction;
  derived.layout = {scene.dimension, material.friction > 0};
  const double zeta = material.damping_ratio
                          ? *material.damping_ratio
                          : (material.restitution.value_or(1) > 0
                                 ? damping_of_restitution(material.restitution.value_or(1), material.convention)
                                 : 1.0);
  derived.restitution =
      material.restitution ? *material.restitution : restitution_of_damping(zeta, material.convention);
  const double d_power = force_scale_power(scene.dimension, derived.grains.mean_diameter);
  std::optional<double> stiffness = material.normal_stiffness;
  if (!stiffness && material.stiffness_level && derived.pressure)
    stiffness = *material.stiffness_level * *derived.pressure * d_power;
  if (!stiffness) return;
  derived.soft = SoftContact{*stiffness, material.tangential_stiffness_ratio * *stiffness, zeta, material.convention};
  if (derived.pressure) derived.stiffness_level = *stiffness / (*derived.pressure * d_power);
}

void derive_times(const Scene& scene, Derived& derived) {
  const GrainFacts& grains = derived.grains;
  if (derived.pressure)
    derived.inertial_time =
        std::sqrt(grains.mean_mass / (*derived.pressure * force_scale_power(scene.dimension, grains.mean_diameter)));
  const LoadingSpec& loading = scene.loading;
  if (loading.shear_rate) derived.shear_rate = loading.shear_rate;
  for (const CellDrive& drive : loading.drives)
    if (drive.component == "xy" && drive.rate) derived.shear_rate = drive.rate;
  if (loading.inertial_number && derived.inertial_time)
    derived.shear_rate = *loading.inertial_number / *derived.inertial_time;
  if (derived.shear_rate && derived.inertial_time)
    derived.inertial_number = std::abs(*derived.shear_rate) * *derived.inertial_time;
  if (scene.run.duration) {
    derived.duration = *scene.run.duration;
  } else if (scene.run.strain && derived.shear_rate && *derived.shear_rate != 0) {
    derived.duration = *scene.run.strain / std::abs(*derived.shear_rate);
  } else {
    throw InputError("run: give run.duration, or run.strain with a shear rate");
  }
}

void derive_md_step(const Scene& scene, Derived& derived) {
  if (!derived.soft) return;
  const SoftContact& soft = *derived.soft;
  derived.collision_time =
      collision_duration(soft.damping_ratio, soft.convention, derived.grains.mean_mass / 2, soft.normal_stiffness);
  derived.md_dt_stable = stable_dt(scene.dimension, soft, derived.grains.least_mass);
  // With strong damping the contact lasts long for reasons that a step must not follow: the undamped duration bounds.
  const double undamped = collision_duration(0, soft.convention, derived.grains.least_mass / 2, soft.normal_stiffness);
  const double lightest =
      collision_duration(soft.damping_ratio, soft.convention, derived.grains.least_mass / 2, soft.normal_stiffness);
  derived.md_dt = scene.md.dt
                      ? *scene.md.dt
                      : std::min({std::min(undamped, lightest) / scene.md.steps_per_contact, *derived.md_dt_stable});
}

/// Shortest of the times in which something moves by its own size.
double shortest_time(const Scene& scene, const Derived& derived) {
  const double d = derived.grains.mean_diameter;
  double shortest = derived.duration;
  const auto consider = [&](double time) {
    if (time > 0 && std::isfinite(time)) shortest = std::min(shortest, time);
  };
  if (derived.inertial_time) consider(*derived.inertial_time);
  if (derived.shear_rate) consider(1 / std::abs(*derived.shear_rate));
  if (derived.grains.largest_speed > 0) consider(d / derived.grains.largest_speed);
  double gravity = 0;
  for (double component : scene.loading.gravity) gravity += component * component;
  if (gravity > 0) consider(std::sqrt(d / std::sqrt(gravity)));
  for (const PlaneSpec& plane : scene.planes) {
    double speed = 0;
    for (double component : plane.velocity) speed += component * component;
    if (speed > 0) consider(d / std::sqrt(speed));
  }
  for (const CellDrive& drive : scene.loading.drives)
    if (drive.rate && *drive.rate != 0) consider(1 / std::abs(*drive.rate));
  return shortest;
}

template <int D>
double squared_speed(const Sample<D>& sample, int i) {
  return (sample.velocity[i] + sample.cell.rate * sample.position[i]).squaredNorm();
}

}  // namespace

template <int D>
GrainFacts grain_facts(const Scene& scene, const Sample<D>& sample) {
  require(sample.count() > 0, "a sample needs at least one grain");
  GrainFacts facts;
  facts.count = sample.count();
  facts.mean_diameter = mean_diameter(scene, sample.radius);
  const auto [least, largest] = std::minmax_element(sample.radius.begin(), sample.radius.end());
  facts.least_diameter = 2 * *least;
  facts.largest_diameter = 2 * *largest;
  facts.least_mass = *std::min_element(sample.mass.begin(), sample.mass.end());
  const double mass = std::accumulate(sample.mass.begin(), sample.mass.end(), 0.0);
  facts.mean_mass = mass / sample.solid_volume() * grain_volume<D>(facts.mean_diameter);
  double fastest = 0;
  for (int i = 0; i < sample.count(); ++i) fastest = std::max(fastest, squared_speed(sample, i));
  facts.largest_speed = std::sqrt(fastest);
  return facts;
}

Derived derive(const Scene& scene, const GrainFacts& facts) {
  Derived derived;
  derived.grains = facts;
  derived.pressure = scene.loading.pressure;
  derive_material(scene, derived);
  derive_times(scene, derived);
  derive_md_step(scene, derived);
  derived.cd_dt = scene.cd.dt ? *scene.cd.dt : scene.cd.dt_factor * shortest_time(scene, derived);
  return derived;
}

// ---- the cell's degrees of freedom -------------------------------------------------------------------------

namespace {

/// Inertia of a mode with which the cell answers within a few inertial times: that of the grains themselves moving
/// affinely in a cell of equal edges, m_total V^(2/D) / 12 per driven component. (The volume, and not an edge, because
/// the same periodic sample has many cells.)
template <int D>
double default_inertia(const Mat<D>& direction, const Sample<D>& sample, double factor) {
  const double mass = std::accumulate(sample.mass.begin(), sample.mass.end(), 0.0);
  const double edge = std::pow(sample.cell.volume(), 1.0 / D);
  return factor * mass * edge * edge * direction.squaredNorm() / 12;
}

template <int D>
Mat<D> component_direction(const std::string& component) {
  Mat<D> direction = Mat<D>::Zero();
  if (component == "isotropic") return Mat<D>::Identity();
  const int a = component[0] - 'x', b = component[1] - 'x';
  require(component.size() == 2 && a >= 0 && a < D && b >= 0 && b < D, "no cell component '" + component + "'");
  direction(a, b) = 1;
  return direction;
}

}  // namespace

template <int D>
std::vector<CellMode<D>> cell_modes(const Scene& scene, const Derived& derived, const Sample<D>& sample) {
  std::vector<CellDrive> drives;
  const LoadingSpec& loading = scene.loading;
  if (loading.kind == LoadingKind::plane_shear) {
    drives.push_back({"xy", derived.shear_rate, std::nullopt});
    if (loading.pressure) drives.push_back({"yy", std::nullopt, loading.pressure});
  } else if (loading.kind == LoadingKind::isotropic) {
    drives.push_back({"isotropic", std::nullopt, loading.pressure});
  } else if (loading.kind == LoadingKind::drives) {
    drives = loading.drives;
  }
  std::vector<CellMode<D>> modes;
  for (const CellDrive& drive : drives) {
    CellMode<D> mode;
    mode.direction = component_direction<D>(drive.component);
    mode.stress_driven = drive.stress.has_value();
    if (mode.stress_driven) {
      // Sigma : direction for the target; "isotropic" sums over the D diagonal components.
      mode.load = *drive.stress * (drive.component == "isotropic" ? D : 1);
      mode.inertia = default_inertia<D>(mode.direction, sample, scene.cell.inertia_factor);
    } else {
      mode.rate = *drive.rate;
    }
    modes.push_back(mode);
  }
  return modes;
}

// ---- restitution of the linear law -------------------------------------------------------------------------

double restitution_of_damping(double zeta, DampingConvention convention) {
  if (zeta == 0) return 1;
  if (convention == DampingConvention::elastic) return zeta < 1 ? std::exp(-pi * zeta / std::sqrt(1 - zeta * zeta)) : 0;
  // Both branches meet at zeta = 1, where e = exp(-2); near it the closed forms are 0/0, the limit is exact to 1e-9.
  if (std::abs(zeta - 1) < 1e-9) return std::exp(-2.0);
  if (zeta < 1) return std::exp(-zeta / std::sqrt(1 - zeta * zeta) * (pi - 2 * std::asin(zeta)));
  return std::exp(-2 * zeta * std::acosh(zeta) / std::sqrt(zeta * zeta - 1));
}

double damping_of_restitution(double e, DampingConvention convention) {
  require(e > 0 && e <= 1, "restitution must be in (0, 1]");
  if (e == 1) return 0;
  if (convention == DampingConvention::elastic) {
    const double log_e = std::log(e);
    return -log_e / std::sqrt(pi * pi + log_e * log_e);
  }
  // e falls monotonically with zeta, like zeta^-2 at large zeta.
  double low = 0, high = 1;
  while (restitution_of_damping(high, convention) > e) high *= 2;
  for (int k = 0; k < 200 && high - low > 1e-16 * high; ++k) {
    const double middle = 0.5 * (low + high);
    (restitution_of_damping(middle, convention) > e ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

double collision_duration(double zeta, DampingConvention convention, double reduced_mass, double stiffness) {
  const double omega = std::sqrt(stiffness / reduced_mass);
  if (convention == DampingConvention::elastic) {
    // An overdamped pair never separates: its slow relaxation time stands for the duration.
    return zeta < 1 ? pi / (omega * std::sqrt(1 - zeta * zeta)) : 2 * pi * zeta / omega;
  }
  if (std::abs(zeta - 1) < 1e-9) return 2 / omega;
  if (zeta < 1) return (pi - 2 * std::asin(zeta)) / (omega * std::sqrt(1 - zeta * zeta));
  return 2 * std::acosh(zeta) / (omega * std::sqrt(zeta * zeta - 1));
}

// ---- explanation -------------------------------------------------------------------------------------------

std::vector<DerivedLine> explain(const Scene& scene, const Derived& derived) {
  std::vector<DerivedLine> lines;
  const auto add = [&](const char* symbol, std::optional<double> value, const char* from) {
    if (value) lines.push_back({symbol, fmt::format("{:.6g}", *value), from});
  };
  const GrainFacts& grains = derived.grains;
  lines.push_back({"layout", to_string(derived.layout), "smallest that the material's friction needs"});
  lines.push_back({"N", fmt::format("{}", grains.count), "grains"});
  add("d", grains.mean_diameter, "mean diameter");
  add("d_max/d_min", grains.largest_diameter / grains.least_diameter, "of the grains drawn");
  add("m", grains.mean_mass, "mass of a grain of diameter d");
  add("P", derived.pressure, "loading.pressure");
  add("mu", derived.friction, "material.friction");
  add("e", derived.restitution, scene.material.restitution ? "material.restitution" : "from zeta, exact for the law");
  if (derived.soft) {
    add("zeta", derived.soft->damping_ratio,
        scene.material.damping_ratio ? "material.damping_ratio" : "inverted so that a collision has exactly e");
    add("K_N", derived.soft->normal_stiffness,
        scene.material.normal_stiffness ? "material.normal_stiffness" : "kappa P d^(D-2)");
    add("K_T", derived.soft->tangential_stiffness, "K_N * tangential_stiffness_ratio");
  }
  add("kappa", derived.stiffness_level, "K_N / (P d^(D-2))");
  add("tau_i", derived.inertial_time, "inertial time sqrt(m / (P d^(D-2)))");
  add("shear rate", derived.shear_rate, "I / tau_i or as given");
  add("I", derived.inertial_number, "shear rate * tau_i");
  add("tau_c", derived.collision_time, "duration of a head-on collision of two mean grains");
  add("duration", derived.duration, "simulated time");
  add("md dt", derived.md_dt,
      scene.md.dt ? "md.dt" : "tau_c of the lightest pair / md.steps_per_contact, within the bound");
  add("md dt bound", derived.md_dt_stable, "stability: stiffness, least mass, damping, 6 (2D) or 9 (3D) neighbours");
  add("cd dt", derived.cd_dt, scene.cd.dt ? "cd.dt" : "cd.dt_factor * shortest of tau_i, 1/rate, d/speed, sqrt(d/g)");
  return lines;
}

template GrainFacts grain_facts<2>(const Scene&, const Sample<2>&);
template GrainFacts grain_facts<3>(const Scene&, const Sample<3>&);
template std::vector<CellMode<2>> cell_modes<2>(const Scene&, const Derived&, const Sample<2>&);
template std::vector<CellMode<3>> cell_modes<3>(const Scene&, const Derived&, const Sample<3>&);

}  // namespace galet
