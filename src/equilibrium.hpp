// When a sample counts as being in equilibrium under its loading:
//   kinetic energy (translation fluctuations, rotations, stress-driven cell) per grain < threshold * P d^D, and
//   |sigma : direction - load| <= 1 % of |load| for every stress-driven mode of the cell.
// Instantaneous values: at rest they don't fluctuate. Source: chapter, sec. comp; Agnolin and Roux 2007.
#pragma once

#include <vector>

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
  bool reached(const Measurement& sample) const { return at_rest(sample) && balanced(sample); }
  bool at_rest(const Measurement& sample) const;
  bool balanced(const Measurement& sample) const;
  double largest_energy() const { return largest_energy_; }  ///< per grain

 private:
  std::vector<CellMode<D>> held_;  ///< the stress-driven modes
  double pressure_ = 0;
  double largest_energy_ = 0;
  int grains_ = 1;
};

extern template class EquilibriumTest<2>;
extern template class EquilibriumTest<3>;

}  // namespace galet
