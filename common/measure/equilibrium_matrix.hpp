// Equilibrium matrix of the contact network, its rank, and the forces that are in equilibrium without any load.
//   G f = external load,   G^T v = relative velocities at the contacts
// f: components of the contact forces in the frame (n, t_1, t_2), or F_N alone without friction; rows of G: resultants
// on the grains (D translations; rotations with friction: 1 in 2D, 3 in 3D), then the virial sum F.(strain b) of each
// direction of strain in which the cell is free. Signs and lever arms: core/conventions.hpp.
//   force indeterminacy  h = forces - rank         dimension of the self-stresses, G f = 0
//   mechanisms           k = freedoms - rank       velocities that no contact opposes
//   freedoms + h = forces + k
// k counts rigid motions too: in a cell that is periodic in each direction and has no planes the D translations.
// Isostatic: h = k = 0 (but for those). Rank by sparse QR with column pivoting for rank (SPQR, tolerance of some
// hundred rounding errors of the largest column). Forces that rolling and pivoting resistance add are not counted.
// Contacts are those that touch; rattlers (coordination.hpp) and their contacts are left out.
// Sources: Roux 2000; Agnolin and Roux 2007 (h, k with cell strains); T12 of the tests: a disk in a groove has h = 1.
// Cost: sparse QR of freedoms x forces, N^1.5 (2D) to N^2 (3D).
#pragma once

#include <vector>

#include <Eigen/SparseCore>

#include "common/engine/snapshot.hpp"

namespace galet {

struct NetworkOptions {
  bool friction = false;
  bool leave_out_rattlers = true;
};

/// Symmetric unit strains, in the order xx, yy, (zz,) xy, (xz, yz): e_xy has 1/2 in both places.
template <int D>
std::vector<Mat<D>> unit_strains();

template <int D>
struct EquilibriumMatrix {
  Eigen::SparseMatrix<double> matrix;  ///< G
  std::vector<int> contact;            ///< contact (index of the columns) of each block of components
  std::vector<Eigen::Matrix<double, D, Eigen::Dynamic>> frame;  ///< of each such contact: n, and tangents with friction
  int components = 1;                                           ///< per contact: 1, or D with friction
  int grain_freedoms = 0;                                       ///< rows before those of the strains
};

template <int D>
EquilibriumMatrix<D> equilibrium_matrix(const Snapshot<D>& snapshot, const NetworkOptions& options,
                                        const std::vector<Mat<D>>& strains);

struct Indeterminacy {
  long forces = 0;
  long freedoms = 0;
  long rank = 0;
  long indeterminacy() const { return forces - rank; }
  long mechanisms() const { return freedoms - rank; }
};

/// `strains`: directions in which the cell is free; none: it is held.
template <int D>
Indeterminacy indeterminacy(const Snapshot<D>& snapshot, const NetworkOptions& options,
                            const std::vector<Mat<D>>& strains = {});

/// An orthonormal basis of the self-stresses: each a force (on j) per contact of the columns, zero where it has none.
/// Memory: contacts * D * h numbers.
template <int D>
std::vector<std::vector<Vec<D>>> self_stresses(const Snapshot<D>& snapshot, const NetworkOptions& options,
                                               const std::vector<Mat<D>>& strains = {});

extern template std::vector<Mat<2>> unit_strains<2>();
extern template std::vector<Mat<3>> unit_strains<3>();
extern template EquilibriumMatrix<2> equilibrium_matrix<2>(const Snapshot<2>&, const NetworkOptions&,
                                                           const std::vector<Mat<2>>&);
extern template EquilibriumMatrix<3> equilibrium_matrix<3>(const Snapshot<3>&, const NetworkOptions&,
                                                           const std::vector<Mat<3>>&);
extern template Indeterminacy indeterminacy<2>(const Snapshot<2>&, const NetworkOptions&, const std::vector<Mat<2>>&);
extern template Indeterminacy indeterminacy<3>(const Snapshot<3>&, const NetworkOptions&, const std::vector<Mat<3>>&);
extern template std::vector<std::vector<Vec<2>>> self_stresses<2>(const Snapshot<2>&, const NetworkOptions&,
                                                                  const std::vector<Mat<2>>&);
extern template std::vector<std::vector<Vec<3>>> self_stresses<3>(const Snapshot<3>&, const NetworkOptions&,
                                                                  const std::vector<Mat<3>>&);

}  // namespace galet
