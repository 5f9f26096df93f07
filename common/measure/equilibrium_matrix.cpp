#include "common/measure/equilibrium_matrix.hpp"

#include <Eigen/SPQRSupport>
#include <SuiteSparseQR.hpp>

#include "common/core/error.hpp"
#include "common/geometry/contact_frame.hpp"
#include "common/measure/coordination.hpp"

namespace galet {

namespace {

using Triplets = std::vector<Eigen::Triplet<double>>;
using WideMatrix = Eigen::SparseMatrix<double, Eigen::ColMajor, SuiteSparse_long>;

/// n, and with friction the tangents, as columns.
template <int D>
Eigen::Matrix<double, D, Eigen::Dynamic> force_frame(const Vec<D>& normal, int components) {
  Eigen::Matrix<double, D, Eigen::Dynamic> frame(D, components);
  frame.col(0) = normal;
  if (components == 1) return frame;
  if constexpr (D == 2) {
    frame.col(1) = tangent(normal);
  } else {
    frame.col(1) = normal.unitOrthogonal();
    frame.col(2) = normal.cross(Vec<3>(frame.col(1)));
  }
  return frame;
}

/// First row of each grain's freedoms, or -1 for a grain that is left out; the number of rows behind the last.
std::vector<int> first_rows(const std::vector<char>& loose, int freedoms) {
  std::vector<int> first(loose.size() + 1, -1);
  int next = 0;
  for (std::size_t i = 0; i < loose.size(); ++i) {
    if (loose[i]) continue;
    first[i] = next;
    next += freedoms;
  }
  first.back() = next;
  return first;
}

/// Resultant of the force `f` and its moment on a grain, in the rows from `row` on.
template <int D>
void add_end(Triplets& entries, int row, int column, const Vec<D>& f, const Spin<D>* torque) {
  for (int a = 0; a < D; ++a) entries.emplace_back(row + a, column, f[a]);
  if (torque == nullptr) return;
  if constexpr (D == 2)
    entries.emplace_back(row + 2, column, *torque);
  else
    for (int a = 0; a < 3; ++a) entries.emplace_back(row + 3 + a, column, (*torque)[a]);
}

/// QR of G^T, whose rank is that of G and whose Q ends with the self-stresses.
class TransposedQr : public Eigen::SPQR<WideMatrix> {
 public:
  explicit TransposedQr(const Eigen::SparseMatrix<double>& matrix) {
    compute(WideMatrix(matrix.transpose()));
    require(info() == Eigen::Success, "the QR factorisation of the equilibrium matrix failed");
  }
};

}  // namespace

template <int D>
std::vector<Mat<D>> unit_strains() {
  std::vector<Mat<D>> strains;
  for (int a = 0; a < D; ++a) {
    strains.push_back(Mat<D>::Zero());
    strains.back()(a, a) = 1;
  }
  for (int a = 0; a < D; ++a)
    for (int b = a + 1; b < D; ++b) {
      strains.push_back(Mat<D>::Zero());
      strains.back()(a, b) = strains.back()(b, a) = 0.5;
    }
  return strains;
}

template <int D>
EquilibriumMatrix<D> equilibrium_matrix(const Snapshot<D>& snapshot, const NetworkOptions& options,
                                        const std::vector<Mat<D>>& strains) {
  const ContactColumns<D>& contacts = *snapshot.contacts;
  const int grains = snapshot.grains(), rotations = options.friction ? (D == 2 ? 1 : 3) : 0;
  const std::vector<char> loose =
      options.leave_out_rattlers ? rattlers(snapshot, options.friction) : std::vector<char>(grains, 0);
  const std::vector<int> first = first_rows(loose, D + rotations);
  EquilibriumMatrix<D> result;
  result.components = options.friction ? D : 1;
  result.grain_freedoms = first.back();
  Triplets entries;
  int column = 0;
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const int i = contacts.i[c], j = contacts.j[c];
    const bool plane = j >= grains;
    if (!contacts.touches(c) || loose[i] || (!plane && loose[j])) continue;
    result.contact.push_back(static_cast<int>(c));
    result.frame.push_back(force_frame<D>(contacts.normal[c], result.components));
    const double length = contacts.branch[c].norm();
    const double arm = length / (snapshot.radius[i] + (plane ? 0 : snapshot.radius[j]));
    for (int k = 0; k < result.components; ++k, ++column) {
      const Vec<D> f = result.frame.back().col(k);
      const Spin<D> twist = -arm * cross(contacts.normal[c], f);  // torque per unit of radius
      const Spin<D> on_i = snapshot.radius[i] * twist, on_j = plane ? twist : snapshot.radius[j] * twist;
      add_end<D>(entries, first[i], column, -f, rotations > 0 ? &on_i : nullptr);
      if (!plane) add_end<D>(entries, first[j], column, f, rotations > 0 ? &on_j : nullptr);
      for (std::size_t s = 0; s < strains.size(); ++s)
        entries.emplace_back(first.back() + static_cast<int>(s), column, f.dot(strains[s] * contacts.branch[c]));
    }
  }
  result.matrix.resize(first.back() + static_cast<int>(strains.size()), column);
  result.matrix.setFromTriplets(entries.begin(), entries.end());  // adds the two ends of a self-image pair
  return result;
}

template <int D>
Indeterminacy indeterminacy(const Snapshot<D>& snapshot, const NetworkOptions& options,
                            const std::vector<Mat<D>>& strains) {
  const EquilibriumMatrix<D> network = equilibrium_matrix(snapshot, options, strains);
  Indeterminacy result{network.matrix.cols(), network.matrix.rows(), 0};
  if (network.matrix.nonZeros() > 0) result.rank = TransposedQr(network.matrix).rank();
  return result;
}

template <int D>
std::vector<std::vector<Vec<D>>> self_stresses(const Snapshot<D>& snapshot, const NetworkOptions& options,
                                               const std::vector<Mat<D>>& strains) {
  const EquilibriumMatrix<D> network = equilibrium_matrix(snapshot, options, strains);
  std::vector<std::vector<Vec<D>>> basis;
  if (network.matrix.nonZeros() == 0) return basis;
  const TransposedQr qr(network.matrix);
  const long forces = network.matrix.cols();
  for (long k = qr.rank(); k < forces; ++k) {
    // The columns of Q behind the rank are orthogonal to the range of G^T.
    const Eigen::MatrixXd unit = Eigen::VectorXd::Unit(forces, k), self = qr.matrixQ() * unit;
    std::vector<Vec<D>>& force = basis.emplace_back(snapshot.contacts->size(), Vec<D>::Zero());
    for (std::size_t block = 0; block < network.contact.size(); ++block)
      force[network.contact[block]] =
          network.frame[block] * self.block(static_cast<long>(block) * network.components, 0, network.components, 1);
  }
  return basis;
}

template std::vector<Mat<2>> unit_strains<2>();
template std::vector<Mat<3>> unit_strains<3>();
template EquilibriumMatrix<2> equilibrium_matrix<2>(const Snapshot<2>&, const NetworkOptions&,
                                                    const std::vector<Mat<2>>&);
template EquilibriumMatrix<3> equilibrium_matrix<3>(const Snapshot<3>&, const NetworkOptions&,
                                                    const std::vector<Mat<3>>&);
template Indeterminacy indeterminacy<2>(const Snapshot<2>&, const NetworkOptions&, const std::vector<Mat<2>>&);
template Indeterminacy indeterminacy<3>(const Snapshot<3>&, const NetworkOptions&, const std::vector<Mat<3>>&);
template std::vector<std::vector<Vec<2>>> self_stresses<2>(const Snapshot<2>&, const NetworkOptions&,
                                                           const std::vector<Mat<2>>&);
template std::vector<std::vector<Vec<3>>> self_stresses<3>(const Snapshot<3>&, const NetworkOptions&,
                                                           const std::vector<Mat<3>>&);

}  // namespace galet
