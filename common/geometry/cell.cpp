#include "common/geometry/cell.hpp"

#include <cmath>

namespace galet {

template <int D>
Eigen::Matrix<int, D, D> tilt_reduction(const Cell<D>& cell) {
  // A little more than one half: a tilt of exactly one half would otherwise flip back and forth by rounding.
  constexpr double largest_tilt = 0.5 + 1e-9;
  Eigen::Matrix<int, D, D> total = Eigen::Matrix<int, D, D>::Identity();
  Mat<D> box = cell.box;
  const double rate = cell.rate.norm();
  for (int b = 0; b < D; ++b) {
    for (int a = 0; a < D; ++a) {
      if (a == b || !cell.periodic[a] || !cell.periodic[b]) continue;
      // Only a vector that the flow tilts is mended: long thin cells keep the axes they were given.
      const double tilting = (cell.rate * box.col(b)).dot(box.col(a));
      if (std::abs(tilting) <= 1e-12 * rate * box.col(a).norm() * box.col(b).norm()) continue;
      const double tilt = box.col(b).dot(box.col(a)) / box.col(a).squaredNorm();
      if (std::abs(tilt) <= largest_tilt) continue;
      const int turns = static_cast<int>(std::lround(tilt));
      box.col(b) -= turns * box.col(a);
      total.col(b) -= turns * total.col(a);
    }
  }
  return total;
}

template Eigen::Matrix<int, 2, 2> tilt_reduction<2>(const Cell<2>&);
template Eigen::Matrix<int, 3, 3> tilt_reduction<3>(const Cell<3>&);

}  // namespace galet
