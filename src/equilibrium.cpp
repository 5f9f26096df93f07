#include "src/equilibrium.hpp"

#include <algorithm>
#include <cmath>

#include "common/core/error.hpp"
#include "common/measure/balance.hpp"
#include "common/measure/coordination.hpp"
#include "common/scene/loading.hpp"

namespace galet {

namespace {

constexpr double largest_rattler_fraction = 0.5;

template <int D>
Mat<D> stress_of(const Measurement& sample) {
  Mat<D> sigma = Mat<D>::Zero();
  sigma(0, 0) = sample[Observable::sigma_xx];
  sigma(1, 1) = sample[Observable::sigma_yy];
  sigma(0, 1) = sigma(1, 0) = sample[Observable::sigma_xy];
  if constexpr (D == 3) {
    sigma(2, 2) = sample[Observable::sigma_zz];
    sigma(0, 2) = sigma(2, 0) = sample[Observable::sigma_xz];
    sigma(1, 2) = sigma(2, 1) = sample[Observable::sigma_yz];
  }
  return sigma;
}

}  // namespace

template <int D>
EquilibriumTest<D>::EquilibriumTest(const Scene& scene, const Derived& derived)
    : tolerance_(scene.run.stress_tolerance.value_or(equilibrium_stress_tolerance)),
      energy_threshold_(scene.run.equilibrium),
      unbalanced_threshold_(scene.run.unbalanced),
      friction_(derived.layout.friction) {
  if (!derived.pressure) throw InputError("run.equilibrium needs loading.pressure: it is measured against P d^D");
  pressure_ = *derived.pressure;
  energy_unit_ = pressure_ * std::pow(derived.grains.mean_diameter, D);
  const std::vector<double> gravity = gravity_of(scene.loading);
  for (std::size_t a = 0; a < gravity.size(); ++a) gravity_[a] = gravity[a];
  for (const CellMode<D>& mode : cell_modes<D>(scene, derived, 1, 1))
    if (mode.stress_driven) held_.push_back(mode);
}

template <int D>
bool EquilibriumTest<D>::reached(const Measurement& sample, const Snapshot<D>& snapshot) const {
  // The cheap conditions first: few samples get as far as the search for rattlers.
  if (!balanced(sample) || sample[Observable::rattler_fraction] > largest_rattler_fraction) return false;
  if (energy_threshold_ && !(sample[Observable::cell] / snapshot.grains() < *energy_threshold_ * energy_unit_ &&
                             backbone_energy(snapshot) < *energy_threshold_))
    return false;
  return !unbalanced_threshold_ || unbalanced(snapshot) < *unbalanced_threshold_;
}

template <int D>
double EquilibriumTest<D>::unbalanced(const Snapshot<D>& snapshot) const {
  return unbalance<D>(snapshot, rattlers(snapshot, friction_), gravity_).force;
}

template <int D>
double EquilibriumTest<D>::backbone_energy(const Snapshot<D>& snapshot) const {
  const std::vector<char> rattles = rattlers(snapshot, friction_);
  double energy = 0;
  int grains = 0;
  for (int i = 0; i < snapshot.grains(); ++i) {
    if (rattles[i]) continue;
    const double inertia = inertia_ratio<D> * snapshot.mass[i] * snapshot.radius[i] * snapshot.radius[i];
    energy += 0.5 * snapshot.mass[i] * snapshot.velocity[i].squaredNorm();
    if (!snapshot.spin.empty()) energy += 0.5 * inertia * squared(snapshot.spin[i]);
    ++grains;
  }
  return grains > 0 ? energy / (grains * energy_unit_) : 0;
}

template <int D>
bool EquilibriumTest<D>::balanced(const Measurement& sample) const {
  const Mat<D> sigma = stress_of<D>(sample);
  return std::all_of(held_.begin(), held_.end(), [&](const CellMode<D>& mode) {
    const double stress = sigma.cwiseProduct(mode.direction).sum();
    // A target of zero stress is compared on the scale of the pressure.
    const double scale = mode.load != 0 ? std::abs(mode.load) : pressure_;
    return std::abs(stress - mode.load) <= tolerance_ * scale;
  });
}

template class EquilibriumTest<2>;
template class EquilibriumTest<3>;

}  // namespace galet
