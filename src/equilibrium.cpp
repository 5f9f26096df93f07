#include "src/equilibrium.hpp"

#include <algorithm>
#include <cmath>

#include "common/core/error.hpp"

namespace galet {

namespace {

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
EquilibriumTest<D>::EquilibriumTest(const Scene& scene, const Derived& derived, const Sample<D>& sample,
                                    double threshold) {
  if (!derived.pressure) throw InputError("run.equilibrium needs loading.pressure: it is measured against P d^D");
  pressure_ = *derived.pressure;
  largest_energy_ = threshold * pressure_ * std::pow(derived.grains.mean_diameter, D);
  grains_ = sample.count();
  for (const CellMode<D>& mode : cell_modes(scene, derived, sample))
    if (mode.stress_driven) held_.push_back(mode);
}

template <int D>
bool EquilibriumTest<D>::at_rest(const Measurement& sample) const {
  return sample[Observable::kinetic_per_grain] + sample[Observable::cell] / grains_ < largest_energy_;
}

template <int D>
bool EquilibriumTest<D>::balanced(const Measurement& sample) const {
  const Mat<D> sigma = stress_of<D>(sample);
  return std::all_of(held_.begin(), held_.end(), [&](const CellMode<D>& mode) {
    const double stress = sigma.cwiseProduct(mode.direction).sum();
    // A target of zero stress is compared on the scale of the pressure.
    const double scale = mode.load != 0 ? std::abs(mode.load) : pressure_;
    return std::abs(stress - mode.load) <= equilibrium_stress_tolerance * scale;
  });
}

template class EquilibriumTest<2>;
template class EquilibriumTest<3>;

}  // namespace galet
