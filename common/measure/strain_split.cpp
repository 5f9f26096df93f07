#include "common/measure/strain_split.hpp"

#include <Eigen/Eigenvalues>

#include "common/core/error.hpp"

namespace galet {

namespace {

constexpr double least_stiffness = 1e-6;  // eigenvalue of C over the largest

/// Components in the order of the moduli; `shear`: factor of those off the diagonal.
template <int D>
Eigen::VectorXd voigt(const Mat<D>& tensor, double shear) {
  Eigen::VectorXd components(D * (D + 1) / 2);
  int next = 0;
  for (int a = 0; a < D; ++a) components[next++] = tensor(a, a);
  for (int a = 0; a < D; ++a)
    for (int b = a + 1; b < D; ++b) components[next++] = shear * 0.5 * (tensor(a, b) + tensor(b, a));
  return components;
}

}  // namespace

template <int D>
std::optional<StrainSplit> strain_split(const StressStrain<D>& before, const StressStrain<D>& after,
                                        const ElasticModuli& moduli) {
  require(moduli.stiffness.rows() == D * (D + 1) / 2, "the moduli are of another dimension");
  const Eigen::MatrixXd symmetric = 0.5 * (moduli.stiffness + moduli.stiffness.transpose());
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(symmetric);
  const Eigen::VectorXd& values = solver.eigenvalues();
  if (!(values[0] > least_stiffness * values[values.size() - 1])) return std::nullopt;
  StrainSplit split;
  split.total = voigt<D>(after.strain - before.strain, 2);
  const Eigen::VectorXd stress = voigt<D>(after.stress - before.stress, 1);
  split.type_one = solver.eigenvectors() * (solver.eigenvectors().transpose() * stress).cwiseQuotient(values);
  split.type_two = split.total - split.type_one;
  return split;
}

template std::optional<StrainSplit> strain_split<2>(const StressStrain<2>&, const StressStrain<2>&,
                                                    const ElasticModuli&);
template std::optional<StrainSplit> strain_split<3>(const StressStrain<3>&, const StressStrain<3>&,
                                                    const ElasticModuli&);

}  // namespace galet
