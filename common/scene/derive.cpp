#include "common/scene/derive.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "common/core/error.hpp"
#include "common/scene/loading.hpp"
#include "common/scene/md_step.hpp"
#include "common/scene/packing.hpp"
#include "common/scene/rigid_bodies.hpp"
#include "common/scene/stages.hpp"

namespace galet {

namespace {

double force_scale_power(int dim, double diameter) { return dim == 2 ? 1 : diameter; }

void derive_material(const Scene& scene, Derived& derived) {
  derived.laws = law_table(scene, derived.pressure, derived.grains.mean_diameter);
  derived.layout = {scene.dimension, derived.laws.any_rotation() || any_turning(scene), derived.laws.any_rolling()};
  if (derived.laws.stiff && derived.pressure)
    derived.stiffness_level =
        stiffness_level(derived.laws.at(0, 0), scene.dimension, *derived.pressure, derived.grains.mean_diameter);
}

/// What run.strain counts: |L_xy|, the axial rate, or that of the first drive that has one.
double strain_rate(const Scene& scene, const Derived& derived) {
  if (derived.shear_rate.value_or(0) != 0) return std::abs(*derived.shear_rate);
  if (derived.compression_rate) return std::abs(*derived.compression_rate);
  for (const CellDrive& drive : scene.loading.drives)
    if (drive.rate.value_or(0) != 0) return std::abs(*drive.rate);
  return 0;
}

void derive_times(const Scene& scene, Derived& derived) {
  const GrainFacts& grains = derived.grains;
  if (derived.pressure)
    derived.inertial_time =
        std::sqrt(grains.mean_mass / (*derived.pressure * force_scale_power(scene.dimension, grains.mean_diameter)));
  const LoadingSpec& loading = scene.loading;
  derived.shear_rate = loading.shear_rate;
  derived.compression_rate = loading.compression_rate;
  for (const CellDrive& drive : loading.drives)
    if (drive.component == "xy" && drive.rate) derived.shear_rate = drive.rate;
  if (loading.inertial_number && derived.inertial_time)
    (has_axis(loading.kind) ? derived.compression_rate : derived.shear_rate) =
        *loading.inertial_number / *derived.inertial_time;
  const double rate = strain_rate(scene, derived);
  if (rate != 0 && derived.inertial_time && (derived.shear_rate || derived.compression_rate))
    derived.inertial_number = rate * *derived.inertial_time;
  if (scene.run.duration) {
    derived.duration = *scene.run.duration;
  } else if (scene.run.strain && rate != 0) {
    derived.duration = *scene.run.strain / rate;
  } else {
    throw InputError("run: give run.duration, or run.strain with a loading that imposes a rate");
  }
}

/// A time in which something moves by its own size, and what it is.
struct NamedTime {
  double value;
  std::string_view name;
};

/// The shortest of them.
NamedTime shortest_time(const Scene& scene, const Derived& derived) {
  const double d = derived.grains.mean_diameter;
  NamedTime shortest{derived.duration, "the duration"};
  const auto consider = [&](double time, std::string_view name) {
    if (time > 0 && std::isfinite(time) && time < shortest.value) shortest = {time, name};
  };
  if (derived.inertial_time) consider(*derived.inertial_time, "tau_i");
  if (derived.shear_rate) consider(1 / std::abs(*derived.shear_rate), "1/shear rate");
  if (derived.compression_rate) consider(1 / std::abs(*derived.compression_rate), "1/compression rate");
  if (derived.grains.largest_speed > 0) consider(d / derived.grains.largest_speed, "d / largest speed at the start");
  double gravity = 0;
  for (double component : scene.loading.gravity) gravity += component * component;
  if (gravity > 0) consider(std::sqrt(d / std::sqrt(gravity)), "sqrt(d / g)");
  if (derived.grains.largest_acceleration > 0)
    consider(std::sqrt(d / derived.grains.largest_acceleration), "sqrt(d / acceleration) of a body");
  for (const PlaneSpec& plane : scene.planes) {
    double speed = 0;
    for (double component : plane.velocity) speed += component * component;
    if (speed > 0) consider(d / std::sqrt(speed), "d / speed of a plane");
    if (plane.mass && plane.force != 0)
      consider(std::sqrt(d * *plane.mass / std::abs(plane.force)), "sqrt(d mass / force) of a plane");
  }
  for (const CylinderSpec& cylinder : scene.cylinders)
    if (surface_speed(cylinder) > 0) consider(d / surface_speed(cylinder), "d / speed of a cylinder's surface");
  for (const CellDrive& drive : scene.loading.drives)
    if (drive.rate && *drive.rate != 0) consider(1 / std::abs(*drive.rate), "1/rate of a drive");
  for (const PairLaw& law : derived.laws.pairs)
    // A tenth of the bond's own time by default: docs/theory.md, "Time step".
    if (law.cohesion_range > 0)
      consider(10 * std::sqrt(law.cohesion_range * derived.grains.least_mass / law.cohesion), "10 sqrt(D0 m / F0)");
  return shortest;
}

template <int D>
double squared_speed(const Sample<D>& sample, int i) {
  return (sample.velocity[i] + sample.cell.rate * sample.position[i]).squaredNorm();
}

/// What rigid bodies add to the facts. A body of n grains meets n times the contacts of one: it counts as grains of
/// mass M / n, and in rotation as grains whose I, with their r^2, add up to its own.
template <int D>
void add_body_facts(const Scene& scene, const Sample<D>& sample, GrainFacts& facts) {
  const RigidBodies<D> bodies = rigid_bodies<D>(scene, sample);
  for (std::size_t b = 0; b < bodies.body.size(); ++b) {
    const RigidBody<D>& body = bodies.body[b];
    const Vec<D> push = body.mobility * body.force;
    const Spin<D> turn = turning_mobility(body) * body.torque;
    Spin<D> share = zero_spin<D>();
    for (int k = bodies.first[b]; k < bodies.first[b + 1]; ++k) {
      const Vec<D>& arm = bodies.offset[bodies.member[k]];
      const double radius = sample.radius[bodies.member[k]], own = inertia_ratio<D> * radius * radius;
      if constexpr (D == 2)
        share += own + arm.squaredNorm();
      else
        share += Vec<3>((own + arm.squaredNorm()) * Vec<3>::Ones() - arm.cwiseAbs2());
      facts.largest_acceleration =
          std::max(facts.largest_acceleration, push.norm() + std::sqrt(squared(turn)) * arm.norm());
    }
    if (!body.mobility.isZero(0))
      facts.least_mass = std::min(facts.least_mass, body.mass / (bodies.first[b + 1] - bodies.first[b]));
    if (body.turning == Turning::imposed) continue;
    if constexpr (D == 2)
      facts.least_mass = std::min(facts.least_mass, body.moments / share);
    else
      facts.least_mass = std::min(facts.least_mass, body.moments.cwiseQuotient(share).minCoeff());
  }
}

}  // namespace

double surface_speed(const CylinderSpec& cylinder) {
  double square = 0;
  for (const double component : cylinder.velocity) square += component * component;
  return std::sqrt(square) + std::abs(cylinder.spin) * cylinder.radius;
}

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
  if (!sample.body.empty()) add_body_facts(scene, sample, facts);
  return facts;
}

namespace {

Derived derive_all_stages(const Scene& scene, const GrainFacts& facts) {
  const std::vector<Derived> stages = derive_stages(scene, facts);
  Derived whole = stages.front();
  for (std::size_t k = 1; k < stages.size(); ++k) whole.duration += stages[k].duration;
  return whole;
}

}  // namespace

Derived derive(const Scene& scene, const GrainFacts& facts) {
  if (!scene.stages.empty()) return derive_all_stages(scene, facts);
  Derived derived;
  derived.grains = facts;
  derived.pressure = scene.loading.unit_pressure ? scene.loading.unit_pressure : scene.loading.pressure;
  derive_material(scene, derived);
  derive_times(scene, derived);
  derive_md_step(scene, derived);
  const NamedTime shortest = shortest_time(scene, derived);
  derived.cd_dt = scene.cd.dt ? *scene.cd.dt : scene.cd.dt_factor * shortest.value;
  derived.cd_dt_from =
      scene.cd.dt ? "cd.dt" : fmt::format("{:g} (cd.dt_factor) * {}", scene.cd.dt_factor, shortest.name);
  return derived;
}

// ---- the cell's degrees of freedom -------------------------------------------------------------------------

namespace {

/// Inertia of a mode with which the cell answers within a few inertial times: that of the grains themselves moving
/// affinely in a cell of equal edges, m_total V^(2/D) / 12 per driven component. (The volume, and not an edge, because
/// the same periodic sample has many cells.)
template <int D>
double default_inertia(const Mat<D>& direction, double mass, double volume, double factor) {
  const double edge = std::pow(volume, 1.0 / D);
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
std::vector<CellMode<D>> cell_modes(const Scene& scene, const Derived& derived, double mass, double volume) {
  std::vector<CellMode<D>> modes;
  for (const CellDrive& drive : loading_drives(scene, derived)) {
    CellMode<D> mode;
    mode.direction = component_direction<D>(drive.component);
    mode.stress_driven = !drive.rate;
    if (mode.stress_driven) {
      // Sigma : direction for the target; "isotropic" sums over the D diagonal components. What is held at the present
      // stress gets its load when the stage starts (stages.hpp).
      const double components = drive.component == "isotropic" ? D : 1;
      mode.load = drive.stress.value_or(0) * components;
      if (drive.stress_to) mode.load_rate = (*drive.stress_to * components - mode.load) / derived.duration;
      mode.inertia = default_inertia<D>(mode.direction, mass, volume, scene.cell.inertia_factor);
    } else {
      mode.rate = *drive.rate;
    }
    modes.push_back(mode);
  }
  return modes;
}

template <int D>
std::vector<CellMode<D>> cell_modes(const Scene& scene, const Derived& derived, const Sample<D>& sample) {
  const double mass = std::accumulate(sample.mass.begin(), sample.mass.end(), 0.0);
  return cell_modes<D>(scene, derived, mass, sample.cell.volume());
}

// ---- explanation -------------------------------------------------------------------------------------------

namespace {

/// h of two grains of mean diameter that F0 alone presses together.
double deflection_of_bond(const Derived& derived, const PairLaw& law) {
  const double k = normal_coefficient(law, derived.grains.mean_diameter / 4);
  return deflection_under(law.normal_law, k, law.cohesion);
}

void explain_laws(const Scene& scene, const Derived& derived, std::vector<DerivedLine>& lines) {
  const LawTable& laws = derived.laws;
  const MaterialSpec& material = scene.material;
  const bool hertz = material.normal_law == NormalLaw::hertz;
  std::vector<std::string> names{material.name};
  for (const OtherMaterial& other : scene.other_materials) names.push_back(other.name);
  for (int a = 0; a < laws.materials; ++a)
    for (int b = a; b < laws.materials; ++b) {
      const PairLaw& law = laws.at(a, b);
      const std::string of = laws.materials > 1 ? fmt::format(" ({}, {})", names[a], names[b]) : "";
      const auto add = [&](const char* symbol, double value, const char* from) {
        lines.push_back({symbol + of, fmt::format("{:.6g}", value), from});
      };
      const char* mixed = a == b ? "the material's" : "mixed, or as given for the pair";
      add("mu", law.friction, mixed);
      add("e", law.restitution, "of a head-on collision, exact for the law");
      if (law.tangential_restitution > 0) add("e_T", law.tangential_restitution, mixed);
      if (law.rolling_friction > 0) add("mu_R", law.rolling_friction, mixed);
      if (law.pivoting_friction > 0) add("mu_P", law.pivoting_friction, mixed);
      if (law.cohesion > 0) add("F0", law.cohesion, material.cohesion_number ? "eta P d^(D-1)" : mixed);
      if (law.cohesion > 0 && law.cohesion_law == CohesionLaw::constant)
        add("D0", law.cohesion_range,
            law.cohesion_range > 0 ? "cohesion_range" : "no cohesion_range: bonds of rigid grains hold no energy");
      if (!laws.stiff) continue;
      if (law.cohesion > 0 && law.cohesion_range > 0)
        add("h0/D0", deflection_of_bond(derived, law) / law.cohesion_range,
            "deflection under F0 over the range: kappa matters to bonds until it is small");
      add("zeta", law.damping_ratio, material.damping_ratio ? mixed : "inverted so that a collision has exactly e");
      if (law.tangential_damping_ratio > 0) add("zeta_T", law.tangential_damping_ratio, "tangential_damping_ratio");
      add(hertz ? "E*" : "K_N", law.stiffness,
          hertz                       ? "1/E* = sum of (1 - nu^2)/E"
          : material.normal_stiffness ? mixed
                                      : "kappa P d^(D-2)");
      add("K_T/K_N", law.tangential_ratio, hertz ? "4 G*/E*, from nu" : "tangential_stiffness_ratio");
    }
  if (derived.stiffness_level)
    lines.push_back({"kappa", fmt::format("{:.6g}", *derived.stiffness_level),
                     hertz ? "(E / ((1 - nu^2) P))^(2/3)" : "K_N / (P d^(D-2))"});
  if (derived.pressure && laws.at(0, 0).cohesion > 0)
    lines.push_back({"eta",
                     fmt::format("{:.6g}", laws.at(0, 0).cohesion / *derived.pressure /
                                               std::pow(derived.grains.mean_diameter, scene.dimension - 1)),
                     "F0 / (P d^(D-1))"});
}

}  // namespace

std::vector<DerivedLine> explain(const Scene& scene, const Derived& derived) {
  std::vector<DerivedLine> lines;
  const auto add = [&](const char* symbol, std::optional<double> value, const char* from) {
    if (value) lines.push_back({symbol, fmt::format("{:.6g}", *value), from});
  };
  const GrainFacts& grains = derived.grains;
  lines.push_back({"layout", to_string(derived.layout), "smallest that friction and bodies that turn need"});
  lines.push_back({"N", fmt::format("{}", grains.count), "grains"});
  add("d", grains.mean_diameter, "mean diameter");
  add("d_max/d_min", grains.largest_diameter / grains.least_diameter, "of the grains drawn");
  add("m", grains.mean_mass, "mass of a grain of diameter d");
  add("P", derived.pressure, "loading.pressure");
  explain_laws(scene, derived, lines);
  add("tau_i", derived.inertial_time, "inertial time sqrt(m / (P d^(D-2)))");
  add("shear rate", derived.shear_rate, "I / tau_i or as given");
  add("compression rate", derived.compression_rate, "I / tau_i or as given");
  add("I", derived.inertial_number, derived.shear_rate ? "shear rate * tau_i" : "compression rate * tau_i");
  if (scene.material.normal_law == NormalLaw::hertz)
    add("K_N typical", derived.contact_stiffness, "dF_N/dh where pressure, weight, cohesion or impacts press contacts");
  const PairLaw& base = derived.laws.at(0, 0);
  if (scene.initial.speed > 0 && base.cohesion_range > 0 && base.cohesion > 0)
    add("V/V*", scene.initial.speed / std::sqrt(base.cohesion_range * base.cohesion / grains.mean_mass),
        "initial.speed / sqrt(D0 F0 / m): fast against what cohesion can hold, above 1");
  add("tau_c", derived.collision_time, "duration of a head-on collision of two mean grains");
  add("duration", derived.duration, "simulated time");
  add("md dt", derived.md_dt,
      scene.md.dt ? "md.dt" : "tau_c of the lightest pair / md.steps_per_contact, within the bound");
  add("md dt bound", derived.md_dt_stable, "stability: stiffness, least mass, damping, 6 (2D) or 12 (3D) neighbours");
  add("cd dt", derived.cd_dt, derived.cd_dt_from.c_str());
  add("cd dt u/d", 0.25 * grains.least_diameter / grains.mean_diameter,
      "a step in which grains move further is taken in parts");
  add("cd penetration", scene.cd.penetration, "cd.penetration: largest overlap that drift may reach, in units of d");
  return lines;
}

template GrainFacts grain_facts<2>(const Scene&, const Sample<2>&);
template GrainFacts grain_facts<3>(const Scene&, const Sample<3>&);
template std::vector<CellMode<2>> cell_modes<2>(const Scene&, const Derived&, const Sample<2>&);
template std::vector<CellMode<3>> cell_modes<3>(const Scene&, const Derived&, const Sample<3>&);
template std::vector<CellMode<2>> cell_modes<2>(const Scene&, const Derived&, double, double);
template std::vector<CellMode<3>> cell_modes<3>(const Scene&, const Derived&, double, double);

}  // namespace galet
