#include "common/measure/fabric.hpp"

#include <limits>

#include <Eigen/Eigenvalues>

namespace galet {

namespace {

template <int D>
Mat<D> deviator(const Mat<D>& tensor) {
  const Mat<D> symmetric = 0.5 * (tensor + tensor.transpose());
  return symmetric - symmetric.trace() / D * Mat<D>::Identity();
}

}  // namespace

template <int D>
Fabric<D> fabric(const Snapshot<D>& snapshot) {
  const ContactColumns<D>& contacts = *snapshot.contacts;
  Fabric<D> result;
  Mat<D> normal = Mat<D>::Zero(), tangential = Mat<D>::Zero(), virial = Mat<D>::Zero();
  double normal_sum = 0;
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    if (!contacts.touches(c) || contacts.j[c] >= snapshot.grains()) continue;
    const Vec<D>&n = contacts.normal[c], &force = contacts.force[c];
    const double pressing = force.dot(n);
    ++result.contacts;
    normal_sum += pressing;
    result.orientation += n * n.transpose();
    normal += pressing * n * n.transpose();
    tangential += (force - pressing * n) * n.transpose();
    virial += force * contacts.branch[c].transpose();
  }
  if (result.contacts == 0) return result;
  result.orientation /= static_cast<double>(result.contacts);
  result.mean_normal_force = normal_sum / static_cast<double>(result.contacts);
  result.contact = deviator<D>(result.orientation);
  result.normal = deviator<D>(normal / normal_sum) - result.contact;
  result.tangential = deviator<D>(tangential / normal_sum);
  const Mat<D> stress = deviator<D>(virial / virial.trace());
  result.branch = stress - result.contact - result.normal - result.tangential;
  if (!stress.allFinite()) return result;
  const Eigen::SelfAdjointEigenSolver<Mat<D>> principal(stress);  // ascending
  result.major = principal.eigenvectors().col(D - 1);
  result.minor = principal.eigenvectors().col(0);
  return result;
}

template <int D>
Anisotropies anisotropies(const Fabric<D>& fabric) {
  if (fabric.contacts == 0 || !(fabric.mean_normal_force > 0)) {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    return {none, none, none, none};
  }
  const auto along_stress = [&](const Mat<D>& tensor) {
    return anisotropy_scale<D> * (fabric.major.dot(tensor * fabric.major) - fabric.minor.dot(tensor * fabric.minor));
  };
  return {along_stress(fabric.contact), along_stress(fabric.normal), along_stress(fabric.tangential),
          along_stress(fabric.branch)};
}

template Fabric<2> fabric<2>(const Snapshot<2>&);
template Fabric<3> fabric<3>(const Snapshot<3>&);
template Anisotropies anisotropies<2>(const Fabric<2>&);
template Anisotropies anisotropies<3>(const Fabric<3>&);

}  // namespace galet
