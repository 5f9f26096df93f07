#include "common/io/particle_text.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "common/core/error.hpp"
#include "common/geometry/wrap.hpp"

namespace galet {

namespace {

/// The cell in space: disks get a third direction, open and as thick as the largest of them.
template <int D>
Mat<3> box_in_space(const Snapshot<D>& snapshot) {
  Mat<3> box = Mat<3>::Identity();
  box.topLeftCorner<D, D>() = snapshot.cell->box;
  if constexpr (D == 2)
    if (!snapshot.radius.empty()) box(2, 2) = 2 * *std::max_element(snapshot.radius.begin(), snapshot.radius.end());
  return box;
}

/// A grain in space.
struct Particle {
  Vec<3> position = Vec<3>::Zero(), velocity = Vec<3>::Zero(), spin = Vec<3>::Zero();
};

template <int D>
Particle particle(const Snapshot<D>& snapshot, const Mat<D>& inverse, int i) {
  Particle result;
  const Vec<D> x = wrapped_position<D>(*snapshot.cell, inverse, snapshot.position[i]);
  result.position.head<D>() = x;
  result.velocity.head<D>() = snapshot.velocity[i] + snapshot.cell->rate * x;
  if (snapshot.spin.empty()) return result;
  if constexpr (D == 2)
    result.spin.z() = snapshot.spin[i];
  else
    result.spin = snapshot.spin[i];
  return result;
}

std::string three(const Vec<3>& v) { return fmt::format("{} {} {}", v.x(), v.y(), v.z()); }

int type_of(const std::vector<int>& material, int i) { return material.empty() ? 1 : material[i] + 1; }

}  // namespace

template <int D>
std::string extended_xyz(const Snapshot<D>& snapshot, const std::vector<int>& material) {
  const Mat<3> box = box_in_space(snapshot);
  const Mat<D> inverse = snapshot.cell->box.inverse();
  std::string text = fmt::format("{}\nLattice=\"{} {} {}\" pbc=\"", snapshot.grains(), three(box.col(0)),
                                 three(box.col(1)), three(box.col(2)));
  for (int a = 0; a < 3; ++a)
    text += fmt::format("{}{}", a == 0 ? "" : " ", a < D && snapshot.cell->periodic[a] ? 'T' : 'F');
  text += fmt::format("\" Time={} Properties=id:I:1:species:S:1:pos:R:3:radius:R:1:mass:R:1:velo:R:3:omega:R:3\n",
                      snapshot.time);
  for (int i = 0; i < snapshot.grains(); ++i) {
    const Particle grain = particle(snapshot, inverse, i);
    text += fmt::format("{} {} {} {} {} {} {}\n", i, type_of(material, i), three(grain.position), snapshot.radius[i],
                        snapshot.mass[i], three(grain.velocity), three(grain.spin));
  }
  return text;
}

template <int D>
std::string lammps_dump(const Snapshot<D>& snapshot, long step, const std::vector<int>& material) {
  const Mat<3> box = box_in_space(snapshot);
  require(box(1, 0) == 0 && box(2, 0) == 0 && box(2, 1) == 0,
          "LAMMPS knows only cells whose first vector is along x and whose second is in the plane (x, y)");
  const Mat<D> inverse = snapshot.cell->box.inverse();
  const double xy = box(0, 1), xz = box(0, 2), yz = box(1, 2);
  const bool tilted = xy != 0 || xz != 0 || yz != 0;
  // Bounds are those of the rectangular box around a tilted one.
  const double low_x = std::min({0.0, xy, xz, xy + xz}), high_x = box(0, 0) + std::max({0.0, xy, xz, xy + xz});
  const double low_y = std::min(0.0, yz), high_y = box(1, 1) + std::max(0.0, yz);
  const double half = D == 2 ? box(2, 2) / 2 : 0;
  std::string text = fmt::format("ITEM: TIMESTEP\n{}\nITEM: NUMBER OF ATOMS\n{}\nITEM: BOX BOUNDS{}", step,
                                 snapshot.grains(), tilted ? " xy xz yz" : "");
  for (int a = 0; a < 3; ++a) text += a < D && snapshot.cell->periodic[a] ? " pp" : " ff";
  const auto bound = [&](double low, double high, double tilt) {
    text += tilted ? fmt::format("\n{} {} {}", low, high, tilt) : fmt::format("\n{} {}", low, high);
  };
  bound(low_x, high_x, xy), bound(low_y, high_y, xz), bound(-half, box(2, 2) - half, yz);
  text += "\nITEM: ATOMS id type radius mass x y z vx vy vz omegax omegay omegaz\n";
  for (int i = 0; i < snapshot.grains(); ++i) {
    const Particle grain = particle(snapshot, inverse, i);
    text += fmt::format("{} {} {} {} {} {} {}\n", i + 1, type_of(material, i), snapshot.radius[i], snapshot.mass[i],
                        three(grain.position), three(grain.velocity), three(grain.spin));
  }
  return text;
}

template std::string extended_xyz<2>(const Snapshot<2>&, const std::vector<int>&);
template std::string extended_xyz<3>(const Snapshot<3>&, const std::vector<int>&);
template std::string lammps_dump<2>(const Snapshot<2>&, long, const std::vector<int>&);
template std::string lammps_dump<3>(const Snapshot<3>&, long, const std::vector<int>&);

}  // namespace galet
