// The deformable periodic cell, and its degrees of freedom. Nothing else knows about images and image velocities.
//
// A cell has a box matrix (columns: cell vectors) and a velocity gradient L (`rate`), d(box)/dt = L box. Laws and
// measures never see it: they get branch vectors and relative velocities (conventions.hpp).
#pragma once

#include <array>
#include <vector>

#include "common/core/types.hpp"

namespace galet {

template <int D>
struct Cell {
  Mat<D> box = Mat<D>::Identity();
  Mat<D> rate = Mat<D>::Zero();    ///< velocity gradient L
  std::array<bool, D> periodic{};  ///< per cell vector; without periodicity the vector only bounds the volume
  Mat<D> strain =
      Mat<D>::Zero();  ///< integral of L since the start of the run: logarithmic strains, < 0 in compression

  double volume() const { return box.determinant(); }
  bool any_periodic() const {
    for (bool p : periodic)
      if (p) return true;
    return false;
  }
};

/// One degree of freedom q of the cell: it contributes q * direction to L. Driven in rate (q given) or in stress:
///   inertia dq/dt = V (sigma : direction) - V load,   load = Sigma : direction for the target stress Sigma,
/// which changes with time by d(load)/dt = load_rate.
/// Units: inertia mass * length^2, q 1/time, load a pressure.
template <int D>
struct CellMode {
  Mat<D> direction = Mat<D>::Zero();
  bool stress_driven = false;
  double load = 0;
  double inertia = 0;
  double rate = 0;       ///< q
  double load_rate = 0;  ///< d(load)/dt
};

/// L as the sum of the modes.
template <int D>
Mat<D> velocity_gradient(const std::vector<CellMode<D>>& modes) {
  Mat<D> gradient = Mat<D>::Zero();
  for (const CellMode<D>& mode : modes) gradient += mode.rate * mode.direction;
  return gradient;
}

/// Distances between opposite faces of the cell.
template <int D>
Vec<D> face_distances(const Mat<D>& box) {
  const Mat<D> inverse = box.inverse();
  Vec<D> widths;
  for (int a = 0; a < D; ++a) widths[a] = 1 / inverse.row(a).norm();
  return widths;
}

/// The unimodular integer matrix U for which box * U is the least tilted equivalent of `box`: each tilt
/// (off-diagonal part of one cell vector along another) is brought into [-1/2, 1/2] of the other's length.
/// Identity when the box is already reduced. Only vectors of periodic directions are mixed.
template <int D>
Eigen::Matrix<int, D, D> tilt_reduction(const Cell<D>& cell);

extern template Eigen::Matrix<int, 2, 2> tilt_reduction<2>(const Cell<2>&);
extern template Eigen::Matrix<int, 3, 3> tilt_reduction<3>(const Cell<3>&);

}  // namespace galet
