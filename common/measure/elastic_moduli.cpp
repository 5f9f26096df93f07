#include "common/measure/elastic_moduli.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/CholmodSupport>

#include "common/core/error.hpp"

namespace galet {

namespace {

using Sparse = Eigen::SparseMatrix<double>;

/// Bulk and shear modulus of the isotropic average of C.
template <int D>
std::pair<double, double> isotropic(const Eigen::MatrixXd& stiffness) {
  double normal = 0, all = 0;  // C_iijj, C_ijij
  for (int a = 0; a < D; ++a)
    for (int b = 0; b < D; ++b) normal += stiffness(a, b);
  for (int a = 0; a < stiffness.rows(); ++a) all += (a < D ? 1 : 2) * stiffness(a, a);
  return {normal / (D * D), (all - normal / D) / ((D + 2) * (D - 1))};
}

/// X with K X = F for F in the range of the positive semidefinite K, up to motions that K does not oppose.
Eigen::MatrixXd relaxed(const Sparse& matrix, const Eigen::MatrixXd& load) {
  double largest = 0;
  for (int k = 0; k < matrix.rows(); ++k) largest = std::max(largest, matrix.coeff(k, k));
  Eigen::CholmodDecomposition<Sparse> factor;
  factor.setShift(1e-10 * largest);
  factor.compute(matrix);
  require(factor.info() == Eigen::Success, "the factorisation of the stiffness matrix failed");
  Eigen::MatrixXd motion = factor.solve(load);
  for (int round = 0; round < 2; ++round) motion += factor.solve(load - matrix * motion);
  return motion;
}

template <int D>
double contact_tangent(const PairLaw& law, double coefficient, double gap, double force) {
  const double attraction = law.cohesion;
  double deflection = -gap;
  if (!(deflection > 0)) deflection = deflection_under(law.normal_law, coefficient, std::max(0.0, force + attraction));
  double stiffness = tangent_stiffness(law.normal_law, coefficient, deflection);
  if (law.cohesion_law == CohesionLaw::square_root && attraction > 0 && deflection > 0)
    stiffness -= std::sqrt(coefficient * attraction / deflection);
  return stiffness;
}

}  // namespace

template <int D>
std::vector<ContactStiffness> contact_stiffness(const Snapshot<D>& snapshot, const LawTable& laws,
                                                const std::vector<int>& material,
                                                const std::vector<int>& plane_material) {
  const ContactColumns<D>& contacts = *snapshot.contacts;
  std::vector<ContactStiffness> result(contacts.size());
  const auto of = [](const std::vector<int>& table, int k) { return table.empty() ? 0 : table[k]; };
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    if (!contacts.touches(c)) continue;
    const int i = contacts.i[c], j = contacts.j[c];
    const bool plane = j >= snapshot.grains();
    const PairLaw& law = laws.at(of(material, i), plane ? of(plane_material, j - snapshot.grains()) : of(material, j));
    const double radius = plane ? snapshot.radius[i] : reduced_radius(snapshot.radius[i], snapshot.radius[j]);
    const double coefficient = normal_coefficient(law, radius);
    const double force = contacts.force[c].dot(contacts.normal[c]);
    result[c].normal = contact_tangent<D>(law, coefficient, contacts.gap[c], force);
    // The tangential spring knows nothing of attraction.
    PairLaw bare = law;
    bare.cohesion_law = CohesionLaw::constant;
    if (law.friction > 0)
      result[c].tangential = law.tangential_ratio * contact_tangent<D>(bare, coefficient, contacts.gap[c], force);
  }
  return result;
}

template <int D>
std::optional<ElasticModuli> elastic_moduli(const Snapshot<D>& snapshot, const std::vector<ContactStiffness>& stiffness,
                                            const NetworkOptions& options) {
  for (const bool periodic : snapshot.cell->periodic)
    if (!periodic) return std::nullopt;
  if (!snapshot.planes.empty()) return std::nullopt;
  const EquilibriumMatrix<D> network = equilibrium_matrix(snapshot, options, unit_strains<D>());
  if (network.contact.empty()) return std::nullopt;

  Eigen::VectorXd springs(network.matrix.cols());
  for (std::size_t block = 0; block < network.contact.size(); ++block)
    for (int k = 0; k < network.components; ++k) {
      const ContactStiffness& contact = stiffness[network.contact[block]];
      springs[static_cast<long>(block) * network.components + k] = k == 0 ? contact.normal : contact.tangential;
    }
  const Sparse full = network.matrix * springs.asDiagonal() * Sparse(network.matrix.transpose());
  const int grains = network.grain_freedoms, strains = static_cast<int>(full.rows()) - grains;
  const Sparse inner = full.topLeftCorner(grains, grains);
  const Eigen::MatrixXd coupling = Sparse(full.topRightCorner(grains, strains));
  ElasticModuli result;
  const double volume = snapshot.cell->volume();
  result.affine = Eigen::MatrixXd(Sparse(full.bottomRightCorner(strains, strains))) / volume;
  result.stiffness = result.affine - coupling.transpose() * relaxed(inner, coupling) / volume;
  std::tie(result.bulk, result.shear) = isotropic<D>(result.stiffness);
  std::tie(result.affine_bulk, result.affine_shear) = isotropic<D>(result.affine);
  return result;
}

template std::vector<ContactStiffness> contact_stiffness<2>(const Snapshot<2>&, const LawTable&,
                                                            const std::vector<int>&, const std::vector<int>&);
template std::vector<ContactStiffness> contact_stiffness<3>(const Snapshot<3>&, const LawTable&,
                                                            const std::vector<int>&, const std::vector<int>&);
template std::optional<ElasticModuli> elastic_moduli<2>(const Snapshot<2>&, const std::vector<ContactStiffness>&,
                                                        const NetworkOptions&);
template std::optional<ElasticModuli> elastic_moduli<3>(const Snapshot<3>&, const std::vector<ContactStiffness>&,
                                                        const NetworkOptions&);

}  // namespace galet
