// Small scenes and samples for tests, and what one asks of their result. All in reduced units: a grain has diameter
// and mass of order 1.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include <Eigen/LU>

#include "cd/engine.hpp"
#include "common/core/random.hpp"
#include "common/engine/engine.hpp"
#include "common/scene/derive.hpp"
#include "common/scene/sample.hpp"
#include "common/scene/scene.hpp"
#include "md/engine.hpp"

namespace galet::test {

inline constexpr double pi = std::numbers::pi;
inline constexpr std::array both_engines{EngineKind::md, EngineKind::cd};
inline constexpr std::array both_conventions{DampingConvention::elastic, DampingConvention::total};

inline std::string to_string(EngineKind kind) { return kind == EngineKind::md ? "md" : "cd"; }
inline std::string to_string(DampingConvention convention) {
  return convention == DampingConvention::elastic ? "elastic" : "total";
}

/// A scene without loading in a cell that is no boundary: grains in free space.
inline Scene free_scene(int dim, double friction, double restitution, double stiffness) {
  Scene scene;
  scene.dimension = dim;
  scene.initial.kind = InitialKind::listed;
  scene.cell.periodic.assign(dim, false);
  scene.material.friction = friction;
  scene.material.restitution = restitution;
  scene.material.normal_stiffness = stiffness;
  scene.run.duration = 1;
  return scene;
}

/// The same in a cell that is periodic in every direction.
inline Scene periodic_scene(int dim, double friction, double restitution, double stiffness) {
  Scene scene = free_scene(dim, friction, restitution, stiffness);
  scene.cell.periodic.assign(dim, true);
  return scene;
}

template <int D>
Derived derive_for(const Scene& scene, const Sample<D>& sample) {
  return derive(scene, grain_facts<D>(scene, sample));
}

/// The engine of a scene; `larger_layout` forces the layout with friction on a frictionless scene.
template <int D>
std::unique_ptr<Engine<D>> make_engine(EngineKind kind, Scene scene, const Sample<D>& sample,
                                       bool larger_layout = false) {
  scene.engine = kind;
  scene.grains.count = sample.count();
  Derived derived = derive_for<D>(scene, sample);
  if (larger_layout) derived.layout.friction = true;
  return kind == EngineKind::md ? md::make_engine<D>(scene, derived, sample)
                                : cd::make_engine<D>(scene, derived, sample);
}

/// Forces the time step of both engines.
inline void set_dt(Scene& scene, double dt) {
  scene.md.dt = dt;
  scene.cd.dt = dt;
}

template <int D>
Cell<D> cube(double edge, bool periodic) {
  Cell<D> cell;
  cell.box = edge * Mat<D>::Identity();
  cell.periodic.fill(periodic);
  return cell;
}

/// A unit vector along no axis.
template <int D>
Vec<D> generic_direction() {
  if constexpr (D == 2)
    return Vec<2>(0.6, 0.8);
  else
    return Vec<3>(2, 3, 6).normalized();
}

/// A unit vector across `normal`, again along no axis in 3D.
template <int D>
Vec<D> generic_tangent(const Vec<D>& normal) {
  if constexpr (D == 2)
    return Vec<2>(-normal.y(), normal.x());
  else
    return normal.cross(Vec<3>(0.3, -0.5, 0.9)).normalized();
}

/// The direction that gravity tests call up: the last axis.
template <int D>
Vec<D> up() {
  return Vec<D>::Unit(D - 1);
}

/// Grains 0 and 1 in the middle of a large cell, 1 lying in `direction` of 0.
template <int D>
Sample<D> pair_sample(const Vec<D>& direction, double gap, std::array<double, 2> radius = {0.5, 0.5},
                      std::array<double, 2> mass = {1, 1}) {
  Sample<D> sample;
  sample.cell = cube<D>(20, false);
  sample.resize(2);
  sample.radius = {radius[0], radius[1]};
  sample.mass = {mass[0], mass[1]};
  sample.position[0] = Vec<D>::Constant(10);
  sample.position[1] = sample.position[0] + (radius[0] + radius[1] + gap) * direction;
  return sample;
}

/// Gives the pair (or the ball on a plane) the relative velocity u, at zero total momentum for a pair.
template <int D>
void set_relative_velocity(Sample<D>& sample, const Vec<D>& u) {
  if (sample.count() == 1) {
    sample.velocity[0] = -u;
    return;
  }
  const double total = sample.mass[0] + sample.mass[1];
  sample.velocity[0] = -sample.mass[1] / total * u;
  sample.velocity[1] = sample.mass[0] / total * u;
}

/// One grain above a plane through the middle of a large cell; `normal` points from the plane to the grain.
template <int D>
Sample<D> ball_on_plane(const Vec<D>& normal, double gap, double radius = 0.5, double mass = 1) {
  Sample<D> sample;
  sample.cell = cube<D>(40, false);
  sample.resize(1);
  sample.radius[0] = radius;
  sample.mass[0] = mass;
  sample.planes.push_back({Vec<D>::Constant(16), normal, Vec<D>::Zero()});
  sample.position[0] = sample.planes[0].point + (radius + gap) * normal;
  return sample;
}

/// `count` equal grains (d = m = 1) one above the other on a plane, grain 0 at the bottom, all just touching.
template <int D>
Sample<D> column_sample(int count) {
  Sample<D> sample = ball_on_plane<D>(up<D>(), 0.0);
  const Vec<D> bottom = sample.position[0];
  const std::vector<Plane<D>> planes = sample.planes;
  sample.resize(count);
  sample.planes = planes;
  for (int k = 0; k < count; ++k) sample.position[k] = bottom + k * up<D>();
  return sample;
}

/// Sets diameters uniform on [1 - spread, 1 + spread], masses for uniform density (mass 1 at d = 1).
template <int D>
void vary_sizes(Sample<D>& sample, double spread, std::uint64_t seed) {
  for (int i = 0; i < sample.count(); ++i) {
    const double diameter = RandomStream(seed, i).uniform(1 - spread, 1 + spread);
    sample.radius[i] = diameter / 2;
    sample.mass[i] = std::pow(diameter, D);
  }
}

/// Normal velocities (rms `speed` per component) and spins, at zero total momentum.
template <int D>
void shake(Sample<D>& sample, double speed, std::uint64_t seed, double spin_speed = 0) {
  Vec<D> momentum = Vec<D>::Zero();
  double mass = 0;
  for (int i = 0; i < sample.count(); ++i) {
    RandomStream random(seed, 1000003 + i);
    for (int a = 0; a < D; ++a) sample.velocity[i][a] = speed * random.normal();
    if constexpr (D == 2)
      sample.spin[i] = spin_speed * random.normal();
    else
      sample.spin[i] = spin_speed * Vec<3>(random.normal(), random.normal(), random.normal());
    momentum += sample.mass[i] * sample.velocity[i];
    mass += sample.mass[i];
  }
  for (Vec<D>& velocity : sample.velocity) velocity -= momentum / mass;
}

/// side^D grains on a square or cubic lattice of the given spacing, in a periodic cell.
template <int D>
Sample<D> lattice_sample(int side, double spacing) {
  Sample<D> sample;
  sample.cell = cube<D>(side * spacing, true);
  sample.resize(D == 2 ? side * side : side * side * side);
  for (int i = 0; i < sample.count(); ++i)
    for (int a = 0, rest = i; a < D; ++a, rest /= side) sample.position[i][a] = (rest % side + 0.5) * spacing;
  return sample;
}

/// A gas: grains of diameters 1 +- spread on a loose lattice, with random velocities and spins.
template <int D>
Sample<D> gas_sample(int side, double solid_fraction, double spread, std::uint64_t seed, double speed = 1) {
  const double spacing = std::pow(grain_volume<D>(1.0) / solid_fraction, 1.0 / D);
  if (spacing < 1 + spread) throw std::invalid_argument("a gas as dense as this starts with overlaps");
  Sample<D> sample = lattice_sample<D>(side, spacing);
  vary_sizes<D>(sample, spread, seed);
  shake<D>(sample, speed, seed, speed);
  return sample;
}

/// Triangular (2D) or face-centred cubic (3D) crystal of cells^D unit cells, nearest neighbours at `spacing`.
template <int D>
Sample<D> crystal_sample(int cells, double spacing) {
  std::vector<Vec<D>> basis;
  Vec<D> edge;
  if constexpr (D == 2) {
    edge = Vec<2>(1, std::sqrt(3.0)) * spacing;
    basis = {Vec<2>(0.25, 0.25), Vec<2>(0.75, 0.75)};
  } else {
    edge = Vec<3>::Constant(std::sqrt(2.0) * spacing);
    basis = {Vec<3>(0.25, 0.25, 0.25), Vec<3>(0.75, 0.75, 0.25), Vec<3>(0.75, 0.25, 0.75), Vec<3>(0.25, 0.75, 0.75)};
  }
  Sample<D> sample;
  sample.cell = cube<D>(1, true);
  sample.cell.box = (cells * edge).asDiagonal();
  const int cell_total = D == 2 ? cells * cells : cells * cells * cells;
  sample.resize(cell_total * static_cast<int>(basis.size()));
  for (int i = 0; i < sample.count(); ++i) {
    Vec<D> corner;
    for (int a = 0, rest = i / static_cast<int>(basis.size()); a < D; ++a, rest /= cells) corner[a] = rest % cells;
    sample.position[i] = (corner + basis[i % basis.size()]).cwiseProduct(edge);
  }
  return sample;
}

/// A loosened crystal of unequal grains, in quick motion: they collide within a time of 0.1. Solid fraction 0.69 (2D)
/// or 0.49 (3D) by default: loose enough that rigid grains can be sheared at constant volume.
template <int D>
Sample<D> sheared_sample(int cells, double spacing = 1.15) {
  Sample<D> sample = crystal_sample<D>(cells, spacing);
  vary_sizes<D>(sample, 0.05, 11);
  shake<D>(sample, 1, 12, 1);
  return sample;
}

template <int D>
Scene sheared_scene(double shear_rate, double pressure) {
  Scene scene = periodic_scene(D, 0.4, 0.3, 1e3);
  scene.loading.kind = LoadingKind::plane_shear;
  scene.loading.shear_rate = shear_rate;
  if (pressure > 0) scene.loading.pressure = pressure;
  return scene;
}

/// Velocity of grain 1 (or of the plane) seen from grain 0, without spins.
template <int D>
Vec<D> relative_velocity(const Snapshot<D>& snapshot) {
  if (snapshot.grains() == 1) return -snapshot.velocity[0];
  return snapshot.velocity[1] - snapshot.velocity[0];
}

/// True when some contact carries a force.
template <int D>
bool in_contact(const Snapshot<D>& snapshot) {
  return std::ranges::any_of(snapshot.contacts->force, [](const Vec<D>& force) { return force.squaredNorm() > 0; });
}

/// Distance between a and b up to lattice vectors.
template <int D>
double lattice_distance(const Cell<D>& cell, const Vec<D>& a, const Vec<D>& b) {
  Vec<D> fraction = cell.box.inverse() * (a - b);
  for (int k = 0; k < D; ++k)
    if (cell.periodic[k]) fraction[k] -= std::round(fraction[k]);
  return (cell.box * fraction).norm();
}

/// Norm of a spin, written alike for disks and spheres.
inline double spin_norm(double spin) { return std::abs(spin); }
inline double spin_norm(const Vec<3>& spin) { return spin.norm(); }

template <int D>
double largest_difference(std::span<const Vec<D>> a, std::span<const Vec<D>> b) {
  double largest = a.size() == b.size() ? 0 : INFINITY;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) largest = std::max(largest, (a[i] - b[i]).norm());
  return largest;
}

/// Slope of log(error) against log(step) by least squares: the observed order of convergence.
inline double observed_order(std::span<const double> step, std::span<const double> error) {
  double sum_x = 0, sum_y = 0, sum_xx = 0, sum_xy = 0;
  const double count = static_cast<double>(step.size());
  for (std::size_t k = 0; k < step.size(); ++k) {
    const double x = std::log(step[k]), y = std::log(error[k]);
    sum_x += x, sum_y += y, sum_xx += x * x, sum_xy += x * y;
  }
  return (count * sum_xy - sum_x * sum_y) / (count * sum_xx - sum_x * sum_x);
}

}  // namespace galet::test
