// The bodies of a run in a layout's columns: grains, planes, rigid bodies, cell. Both engines hold their state in this
// form.
#pragma once

#include "common/core/archive_columns.hpp"
#include "common/core/column.hpp"
#include "common/core/layout.hpp"
#include "common/core/memory_use.hpp"
#include "common/engine/engine.hpp"
#include "common/geometry/cell.hpp"
#include "common/geometry/plane.hpp"
#include "common/geometry/wrap.hpp"
#include "common/scene/derive.hpp"
#include "common/scene/loading.hpp"
#include "common/scene/rigid_bodies.hpp"
#include "common/scene/sample.hpp"

namespace galet {

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
  RigidBodies<D> rigid;
  std::vector<Vec<D>> arm;  ///< of each grain from its rigid body's centre, in the fixed frame; empty: none has one
  Vec<D> gravity = Vec<D>::Zero();

  std::size_t bytes() const {
    return bytes_of(position, velocity, radius, mass, material, spin, inertia, arm, rigid.offset, rigid.of);
  }
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
    modes = cell_modes<D>(scene, derived, sample);
    rigid = rigid_bodies<D>(scene, sample);
    if (!rigid.none()) {
      if (!modes.empty()) throw InputError("rigid bodies need a cell that does not move: loading.kind = \"none\"");
      arm.assign(position.size(), Vec<D>::Zero());
      follow();
    }
    if (!modes.empty()) cell.rate = velocity_gradient(modes);
    set_gravity(scene);
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
    set_gravity(scene);
  }

  void set_gravity(const Scene& scene) {
    gravity.setZero();
    const std::vector<double> given = gravity_of(scene.loading);
    for (std::size_t a = 0; a < given.size(); ++a) gravity[a] = given[a];
  }

  /// Gravity along periodic directions, where heights mean nothing: what it gives is work, not an energy.
  Vec<D> endless_gravity() const {
    Vec<D> part = gravity;
    for (int a = 0; a < D; ++a)
      if (!cell.periodic[a]) part[a] = 0;
    return part;
  }

  /// Targets that change with time.
  void advance_loads(double dt) {
    for (CellMode<D>& mode : modes)
      if (mode.load_rate != 0) mode.load += dt * mode.load_rate;
  }

  /// Velocities, spins and arms of the grains of rigid bodies from these. Positions are follow()'s.
  void follow_velocities() {
    for (std::size_t b = 0; b < rigid.body.size(); ++b) {
      const RigidBody<D>& body = rigid.body[b];
      const Mat<D> rotation = rotation_of(body);
      for (int k = rigid.first[b]; k < rigid.first[b + 1]; ++k) {
        const int i = rigid.member[k];
        arm[i] = rotation * rigid.offset[i];
        velocity[i] = body.velocity + cross(body.spin, arm[i]);
        if constexpr (Y.friction) spin[i] = body.spin;
      }
    }
  }

  /// Puts the grains of rigid bodies where these are, at the images nearest to where they were.
  void follow() {
    follow_velocities();
    const bool periodic = cell.any_periodic();
    Mat<D> inverse;
    if (periodic) inverse = cell.box.inverse();
    for (std::size_t b = 0; b < rigid.body.size(); ++b) {
      Vec<D>& centre = rigid.body[b].centre;
      if (periodic) centre = wrapped_position<D>(cell, inverse, centre);
      for (int k = rigid.first[b]; k < rigid.first[b + 1]; ++k) {
        const int i = rigid.member[k];
        position[i] = image_near<D>(cell, inverse, Vec<D>(centre + arm[i]), position[i]);
      }
    }
  }

  /// m* of the dashpot between two grains, or a grain and a plane (j >= grains()).
  double reduced_mass(int i, int j) const {
    const double m_i = rigid.none() ? mass[i] : rigid.contact_mass[i];
    if (j >= grains()) return std::isfinite(m_i) ? m_i : mass[i];
    const double m_j = rigid.none() ? mass[j] : rigid.contact_mass[j];
    if (std::isfinite(m_i) && std::isfinite(m_j)) return m_i * m_j / (m_i + m_j);
    // Where nothing moves either side the value does not matter.
    return std::isfinite(m_i) ? m_i : std::isfinite(m_j) ? m_j : mass[i];
  }

  /// Kinetic, rotational, cell and gravity parts of the energy. Grains of rigid bodies count by these.
  EnergyParts energy() const {
    EnergyParts parts;
    const Vec<D> steady = gravity - endless_gravity();
    for (int i = 0; i < grains(); ++i) {
      if (!rigid.free(i)) continue;
      parts.kinetic += 0.5 * mass[i] * velocity[i].squaredNorm();
      parts.gravity -= mass[i] * steady.dot(position[i]);
      if constexpr (Y.friction) parts.rotational += 0.5 * inertia[i] * squared(spin[i]);
    }
    for (const RigidBody<D>& body : rigid.body) {
      parts.kinetic += 0.5 * body.mass * body.velocity.squaredNorm();
      parts.rotational += 0.5 * dot(body.spin, angular_momentum(body));
      parts.gravity -= body.mass * steady.dot(body.centre);
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
    shown.bodies = rigid.body;
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
    save_rigid(archive);
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
    restore_rigid(archive);
  }

 private:
  void save_rigid(Archive& archive) const {
    std::vector<double>& column = archive.reals["bodies.state"];
    column.clear();
    for (const RigidBody<D>& body : rigid.body) {
      append(column, body.centre), append(column, body.velocity);
      append(column, body.spin), append(column, body.momentum);
      append(column, numbers_of(body.orientation));
    }
  }

  void restore_rigid(const Archive& archive) {
    using Orientation = decltype(numbers_of(RigidBody<D>{}.orientation));
    constexpr std::size_t size = components<Vec<D>> * 2 + components<Spin<D>> * 2 + components<Orientation>;
    std::vector<double> column(size * rigid.body.size());
    take_column(archive, "bodies.state", column);
    const double* from = column.data();
    for (RigidBody<D>& body : rigid.body) {
      from = extract(from, body.centre), from = extract(from, body.velocity);
      from = extract(from, body.spin), from = extract(from, body.momentum);
      Orientation orientation;
      from = extract(from, orientation);
      set_orientation(orientation, body.orientation);
    }
    follow_velocities();
  }
};

}  // namespace galet
