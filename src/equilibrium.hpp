// When a sample counts as being in equilibrium under its loading:
//   |sigma : direction - load| <= 1 % of |load| for every stress-driven mode of the cell;
//   kinetic energy (fluctuations and rotations) per grain of the backbone < threshold * P d^D, and so is the kinetic
//   energy of the cell per grain;
//   at most half of the grains are rattlers: a gas may happen to have the right stress.
// Rattlers don't count: nothing stops one that spins or drifts without touching, and it carries no stress.
// Each is asked of instantaneous values; the run loop wants them to hold for one inertial time. Source: chapter, sec.
// comp; Agnolin and Roux 2007.
#pragma once

#include <vector>

#include "common/engine/snapshot.hpp"
#include "common/scene/derive.hpp"
#include "common/scene/sample.hpp"
#include "common/scene/scene.hpp"
#include "src/observable.hpp"

namespace galet {

inline constexpr double equilibrium_stress_tolerance = 0.01;

template <int D>
class EquilibriumTest {
 public:
  /// Throws InputError when the scene has no pressure to compare with.
  EquilibriumTest(const Scene& scene, const Derived& derived, const Sample<D>& sample, double threshold);

  /// `sample` is the measurement of `snapshot`.
  bool reached(const Measurement& sample, const Snapshot<D>& snapshot) const;

  bool balanced(const Measurement& sample) const;
  /// Kinetic energy per grain of the backbone, in units of P d^D; 0 without a backbone.
  double backbone_energy(const Snapshot<D>& snapshot) const;

 private:
  std::vector<CellMode<D>> held_;  ///< the stress-driven modes
  double pressure_ = 0;
  double energy_unit_ = 0;  ///< P d^D
  double threshold_ = 0;
  bool friction_ = false;
};

extern template class EquilibriumTest<2>;
extern template class EquilibriumTest<3>;

}  // namespace galet
