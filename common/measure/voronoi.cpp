#include "common/measure/voronoi.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/QR>
#include <voro++.hh>

#include "common/core/error.hpp"
#include "common/geometry/wrap.hpp"

namespace galet {

namespace {

constexpr double grains_per_block = 5;  // voro++ searches blocks; its manual finds about this many best

/// The cell as voro++ wants it: a 3D box whose matrix is upper triangular with a positive diagonal.
struct Box {
  Mat<3> matrix = Mat<3>::Identity();
  double slab = 1;  ///< thickness of the third direction in 2D
};

/// The upper triangular matrix that is `box` turned: the triangle of its QR factorisation.
template <int D>
Mat<D> turned(const Mat<D>& box) {
  const Eigen::HouseholderQR<Mat<D>> qr(box);
  Mat<D> upper = qr.matrixQR().template triangularView<Eigen::Upper>();
  for (int a = 0; a < D; ++a)
    if (upper(a, a) < 0) upper.row(a) *= -1;
  return upper;
}

template <int D>
Box box_of(const Snapshot<D>& snapshot) {
  Box box;
  box.matrix.topLeftCorner<D, D>() = turned<D>(snapshot.cell->box);
  if constexpr (D == 2) {
    // Any thickness gives the same prisms; this one makes the blocks of the search about as thick as wide.
    box.slab = 2 * *std::max_element(snapshot.radius.begin(), snapshot.radius.end());
    box.matrix(2, 2) = box.slab;
  }
  return box;
}

/// Blocks along each direction.
std::array<int, 3> blocks_of(const Mat<3>& box, int grains) {
  const double edge = std::cbrt(box.determinant() * grains_per_block / std::max(1, grains));
  std::array<int, 3> blocks{};
  for (int a = 0; a < 3; ++a) blocks[a] = std::max(1, static_cast<int>(box(a, a) / edge));
  return blocks;
}

/// Puts the grains into a container of voro++, and takes the volumes of their cells.
template <int D, class Container, class Loop>
std::vector<double> tessellate(const Snapshot<D>& snapshot, const Box& box, Container& container, Loop&& make_loop) {
  const Mat<D> inverse = snapshot.cell->box.inverse();
  for (int i = 0; i < snapshot.grains(); ++i) {
    Vec<3> s = Vec<3>::Constant(D == 2 ? 0.5 : 0);
    s.head<D>() = wrapped_fraction<D>(*snapshot.cell, inverse, snapshot.position[i]);
    const Vec<3> x = box.matrix * s;
    container.put(i, x.x(), x.y(), x.z(), snapshot.radius[i]);
  }
  std::vector<double> volumes(snapshot.grains(), 0.0);
  auto loop = make_loop(container);
  voro::voronoicell cell;
  if (loop.start()) do {
      if (container.compute_cell(cell, loop)) volumes[loop.pid()] = cell.volume() / box.slab;
    } while (loop.inc());
  return volumes;
}

}  // namespace

template <int D>
std::vector<double> voronoi_volumes(const Snapshot<D>& snapshot) {
  if (snapshot.grains() == 0) return {};
  const auto& periodic = snapshot.cell->periodic;
  const long open = std::count(periodic.begin(), periodic.end(), false);
  const Box box = box_of(snapshot);
  const std::array<int, 3> blocks = blocks_of(box.matrix, snapshot.grains());
  const Mat<3>& b = box.matrix;
  constexpr int memory = 8;  // grains that a block holds before it grows
  if (open == 0) {
    voro::container_periodic_poly container(b(0, 0), b(0, 1), b(1, 1), b(0, 2), b(1, 2), b(2, 2), blocks[0], blocks[1],
                                            blocks[2], memory);
    return tessellate(snapshot, box, container, [](auto& c) { return voro::c_loop_all_periodic(c); });
  }
  require(open == D && snapshot.cell->box.isDiagonal(0),
          "Voronoi cells need a cell that is periodic in each direction, or open in each and rectangular");
  voro::container_poly container(0, b(0, 0), 0, b(1, 1), 0, b(2, 2), blocks[0], blocks[1], blocks[2], false, false,
                                 D == 2, memory);
  return tessellate(snapshot, box, container, [](auto& c) { return voro::c_loop_all(c); });
}

template <int D>
std::vector<double> local_solid_fraction(const Snapshot<D>& snapshot) {
  std::vector<double> values = voronoi_volumes(snapshot);
  for (int i = 0; i < snapshot.grains(); ++i)
    values[i] =
        values[i] > 0 ? grain_volume<D>(2 * snapshot.radius[i]) / values[i] : std::numeric_limits<double>::quiet_NaN();
  return values;
}

template std::vector<double> voronoi_volumes<2>(const Snapshot<2>&);
template std::vector<double> voronoi_volumes<3>(const Snapshot<3>&);
template std::vector<double> local_solid_fraction<2>(const Snapshot<2>&);
template std::vector<double> local_solid_fraction<3>(const Snapshot<3>&);

}  // namespace galet
