// The bodies of a run in a layout's columns: grains, planes, cell. Both engines hold their state in this form.
#pragma once

#include "common/core/archive_columns.hpp"
#include "common/core/column.hpp"
#include "common/core/layout.hpp"
#include "common/core/memory_use.hpp"
#include "common/engine/engine.hpp"
#include "common/geometry/cell.hpp"
#include "common/geometry/plane.hpp"
#include "common/scene/derive.hpp"
#include "common/scene/sample.hpp"

namespace galet {

/// A rough wall: a rigid body of grains that moves without turning.
template <int D>
struct Wall {
  Vec<D> velocity = Vec<D>::Zero();
  Vec<D> force = Vec<D>::Zero();
  Vec<D> mobility = Vec<D>::Zero();  ///< 1 / mass along its free directions, 0 along the others
};

template <Layout Y>
struct Bodies {
  static constexpr int D = Y.dim;

  Column<Vec<D>> position;
  Column<Vec<D>> velocity;  ///< fluctuation v
  Column<double> radius, mass;
  std::vector<int> material;  ///< index into the scene's materials; fixed, hence not part of a checkpoint's state
  Column<Spin<D>, Y.friction> spin;
  Column<double, Y.friction> inertia;  ///< I

  Cell<D> cell;
  std::vector<CellMode<D>> modes;
  std::vector<Plane<D>> planes;
  std::vector<int> plane_material;
  std::vector<Wall<D>> walls;
  std::vector<int> wall_of;  ///< index of each grain's wall, or -1; empty: there are no walls
  Vec<D> gravity = Vec<D>::Zero();

  std::size_t bytes() const { return bytes_of(position, velocity, radius, mass, material, spin, inertia, wall_of); }
  int grains() const { return static_cast<int>(position.size()); }
  bool stress_driven() const {
    for (const CellMode<D>& mode : modes)
      if (mode.stress_driven) return true;
    return false;
  }

  void start(const Scene& scene, const Derived& derived, const Sample<D>& sample) {
    position.assign(sample.position.begin(), sample.position.end());
    velocity.assign(sample.velocity.begin(), sample.velocity.end());
    radius.assign(sample.radius.begin(), sample.radius.end());
    mass.assign(sample.mass.begin(), sample.mass.end());
    if constexpr (Y.friction) {
      spin.assign(sample.spin.begin(), sample.spin.end());
      inertia.resize(mass.size());
      for (std::size_t i = 0; i < mass.size(); ++i) inertia[i] = inertia_ratio<D> * mass[i] * radius[i] * radius[i];
    }
    cell = sample.cell;
    planes = sample.planes;
    material = sample.material;
    material.resize(position.size(), 0);
    plane_material = sample.plane_material;
    plane_material.resize(planes.size(), 0);
    start_walls(scene, sample);
    modes = cell_modes<D>(scene, derived, sample);
    if (!modes.empty()) cell.rate = velocity_gradient(modes);
    for (std::size_t a = 0; a < scene.loading.gravity.size(); ++a) gravity[a] = scene.loading.gravity[a];
  }

  /// Another loading from now on: new modes and gravity. Components driven in stress keep the rate that they have.
  void change_loading(const Scene& scene, const Derived& derived) {
    const Mat<D> rate = cell.rate;
    double total = 0;
    for (const double m : mass) total += m;
    modes = cell_modes<D>(scene, derived, total, cell.volume());
    for (CellMode<D>& mode : modes)
      if (mode.stress_driven) mode.rate = rate.cwiseProduct(mode.direction).sum() / mode.direction.squaredNorm();
    cell.rate = velocity_gradient(modes);
    gravity.setZero();
    for (std::size_t a = 0; a < scene.loading.gravity.size(); ++a) gravity[a] = scene.loading.gravity[a];
  }

  /// Targets that change with time.
  void advance_loads(double dt) {
    for (CellMode<D>& mode : modes)
      if (mode.load_rate != 0) mode.load += dt * mode.load_rate;
  }

  void start_walls(const Scene& scene, const Sample<D>& sample) {
    wall_of = sample.wall;
    walls.assign(wall_of.empty() ? 0 : scene.walls.size(), {});
    for (std::size_t w = 0; w < walls.size(); ++w) {
      const WallSpec& spec = scene.walls[w];
      double total = 0;
      for (int i = 0; i < grains(); ++i)
        if (wall_of[i] == static_cast<int>(w)) total += mass[i];
      for (int a = 0; a < D; ++a) {
        if (!spec.velocity.empty()) walls[w].velocity[a] = spec.velocity[a];
        if (!spec.force.empty()) walls[w].force[a] = spec.force[a];
        if (!spec.free.empty() && spec.free[a]) walls[w].mobility[a] = 1 / spec.mass.value_or(total);
      }
    }
    follow_walls();
  }

  /// Grains of walls move as these do.
  void follow_walls() {
    for (std::size_t i = 0; i < wall_of.size(); ++i) {
      if (wall_of[i] < 0) continue;
      velocity[i] = walls[wall_of[i]].velocity;
      if constexpr (Y.friction) spin[i] = zero_spin<D>();
    }
  }

  /// Kinetic, rotational, cell and gravity parts of the energy.
  EnergyParts energy() const {
    EnergyParts parts;
    for (int i = 0; i < grains(); ++i) {
      parts.kinetic += 0.5 * mass[i] * velocity[i].squaredNorm();
      parts.gravity -= mass[i] * gravity.dot(position[i]);
      if constexpr (Y.friction) parts.rotational += 0.5 * inertia[i] * squared(spin[i]);
    }
    for (const CellMode<D>& mode : modes)
      if (mode.stress_driven) parts.cell += 0.5 * mode.inertia * mode.rate * mode.rate;
    return parts;
  }

  /// The fields of a snapshot that do not depend on the engine.
  Snapshot<D> view() const {
    Snapshot<D> shown;
    shown.cell = &cell;
    shown.planes = planes;
    shown.position = position;
    shown.velocity = velocity;
    if constexpr (Y.friction) shown.spin = spin;
    shown.radius = radius;
    shown.mass = mass;
    return shown;
  }

  void save(Archive& archive) const {
    put_column(archive, "grains.position", position);
    put_column(archive, "grains.velocity", velocity);
    put_column(archive, "grains.radius", radius);
    put_column(archive, "grains.mass", mass);
    if constexpr (Y.friction) put_column(archive, "grains.spin", spin);
    std::vector<double>& box = archive.reals["cell.box"];
    box.assign(cell.box.data(), cell.box.data() + D * D);
    std::vector<double>& rate = archive.reals["cell.rate"];
    rate.assign(cell.rate.data(), cell.rate.data() + D * D);
    archive.reals["cell.strain"].assign(cell.strain.data(), cell.strain.data() + D * D);
    std::vector<double>& mode_columns = archive.reals["cell.modes"];
    mode_columns.clear();
    for (const CellMode<D>& mode : modes) {
      mode_columns.insert(mode_columns.end(), {mode.rate, mode.load, mode.load_rate, mode.inertia});
    }
    std::vector<double>& points = archive.reals["planes.point"];
    std::vector<double>& velocities = archive.reals["planes.velocity"];
    points.clear(), velocities.clear();
    for (const Plane<D>& plane : planes) append(points, plane.point), append(velocities, plane.velocity);
    std::vector<double>& moving = archive.reals["walls.velocity"];
    moving.clear();
    for (const Wall<D>& wall : walls) append(moving, wall.velocity);
    archive.integers["layout"] = {Y.dim, Y.friction, Y.rolling};
  }

  void restore(const Archive& archive) {
    if (integer_column(archive, "layout") != std::vector<std::int64_t>{Y.dim, Y.friction, Y.rolling})
      throw InputError("the checkpoint was written in another layout than " + to_string(Y));
    take_column(archive, "grains.position", position);
    take_column(archive, "grains.velocity", velocity);
    take_column(archive, "grains.radius", radius);
    take_column(archive, "grains.mass", mass);
    if constexpr (Y.friction) {
      take_column(archive, "grains.spin", spin);
      for (int i = 0; i < grains(); ++i) inertia[i] = inertia_ratio<D> * mass[i] * radius[i] * radius[i];
    }
    std::vector<double> numbers(D * D);
    take_column(archive, "cell.box", numbers);
    cell.box = Eigen::Map<const Mat<D>>(numbers.data());
    take_column(archive, "cell.rate", numbers);
    cell.rate = Eigen::Map<const Mat<D>>(numbers.data());
    take_column(archive, "cell.strain", numbers);
    cell.strain = Eigen::Map<const Mat<D>>(numbers.data());
    numbers.resize(4 * modes.size());
    take_column(archive, "cell.modes", numbers);
    for (std::size_t k = 0; k < modes.size(); ++k) {
      const double* from = numbers.data() + 4 * k;
      modes[k].rate = from[0], modes[k].load = from[1], modes[k].load_rate = from[2], modes[k].inertia = from[3];
    }
    numbers.resize(D * planes.size());
    take_column(archive, "planes.point", numbers);
    for (std::size_t p = 0; p < planes.size(); ++p) extract(numbers.data() + D * p, planes[p].point);
    take_column(archive, "planes.velocity", numbers);
    for (std::size_t p = 0; p < planes.size(); ++p) extract(numbers.data() + D * p, planes[p].velocity);
    numbers.resize(D * walls.size());
    take_column(archive, "walls.velocity", numbers);
    for (std::size_t w = 0; w < walls.size(); ++w) extract(numbers.data() + D * w, walls[w].velocity);
  }
};

}  // namespace galet
