// When a sample counts as being in equilibrium under its loading:
//   |sigma : direction - load| <= tolerance |load| for every stress-driven mode of the cell (default 1 %);
//   kinetic energy (fluctuations and rotations) per grain of the backbone < run.equilibrium * P d^D, and so is the
//   kinetic energy of the cell per grain (where run.equilibrium is asked for);
//   unbalanced force ratio of the backbone < run.unbalanced (where that is asked for; common/measure);
//   at most half of the grains are rattlers: a gas may happen to have the right stress.
// Rattlers don't count: nothing stops one that spins or drifts without touching, and it carries no stress.
// Each is asked of instantaneous values; the run loop wants them to hold for one inertial time. Source: chapter, sec.
// comp; Agnolin and Roux 2007.
#pragma once

#include <optional>
#include <vector>

#include "common/engine/snapshot.hpp"
#include "common/scene/derive.hpp"
#include "common/scene/scene.hpp"
#include "src/observable.hpp"

namespace galet {

inline constexpr double equilibrium_stress_tolerance = 0.01;  ///< where the scene says nothing

template <int D>
class EquilibriumTest {
 public:
  /// The test that run.equilibrium and run.unbalanced ask for. Throws InputError when the scene has no pressure to
  /// compare with.
  EquilibriumTest(const Scene& scene, const Derived& derived);

  /// `sample` is the measurement of `snapshot`.
  bool reached(const Measurement& sample, const Snapshot<D>& snapshot) const;

  bool balanced(const Measurement& sample) const;
  double stress_tolerance() const { return tolerance_; }
  /// Kinetic energy per grain of the backbone, in units of P d^D; 0 without a backbone.
  double backbone_energy(const Snapshot<D>& snapshot) const;
  /// Unbalanced force ratio of the backbone.
  double unbalanced(const Snapshot<D>& snapshot) const;

 private:
  std::vector<CellMode<D>> held_;  ///< the stress-driven modes
  double pressure_ = 0;
  double energy_unit_ = 0;  ///< P d^D
  double tolerance_ = equilibrium_stress_tolerance;
  std::optional<double> energy_threshold_, unbalanced_threshold_;
  Vec<D> gravity_ = Vec<D>::Zero();
  bool friction_ = false;
};

extern template class EquilibriumTest<2>;
extern template class EquilibriumTest<3>;

}  // namespace galet
