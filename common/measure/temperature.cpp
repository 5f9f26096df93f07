#include "common/measure/temperature.hpp"

namespace galet {

template <int D>
Temperature granular_temperature(const Snapshot<D>& snapshot) {
  Temperature result;
  const int grains = snapshot.grains();
  if (grains == 0) return result;
  Vec<D> momentum = Vec<D>::Zero();
  double mass = 0;
  Spin<D> spin = zero_spin<D>();
  for (int i = 0; i < grains; ++i) {
    momentum += snapshot.mass[i] * snapshot.velocity[i];
    mass += snapshot.mass[i];
    if (!snapshot.spin.empty()) spin += snapshot.spin[i] / grains;
  }
  for (int i = 0; i < grains; ++i) {
    result.translational += snapshot.mass[i] * (snapshot.velocity[i] - momentum / mass).squaredNorm();
    if (snapshot.spin.empty()) continue;
    const double inertia = inertia_ratio<D> * snapshot.mass[i] * snapshot.radius[i] * snapshot.radius[i];
    result.rotational += inertia * squared(Spin<D>(snapshot.spin[i] - spin));
  }
  result.translational /= D * grains;
  result.rotational /= (D == 2 ? 1 : 3) * grains;
  return result;
}

template Temperature granular_temperature<2>(const Snapshot<2>&);
template Temperature granular_temperature<3>(const Snapshot<3>&);

}  // namespace galet
