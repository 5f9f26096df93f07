// The skin of the neighbour list, tuned by the run itself: a wide skin lists pairs that never touch, a narrow one makes
// the list anew too often. With e pairs per grain and unit skin that don't touch, a cost C of building (in evaluations
// of a pair, per grain) and a skin s that lasted n steps, the cost per step e s' + C (s / n) / s' is least for
//   s'^2 = C s / (e n)
// It depends on counts only, never on time measured, so that runs are repeatable.
#pragma once

#include <algorithm>
#include <cmath>

namespace galet::md {

class Skin {
 public:
  explicit Skin(double diameter) : diameter_(diameter) {}

  static constexpr double least = 0.005, most = 0.2;  ///< of the mean diameter
  static constexpr double building_cost = 75;         ///< C
  static constexpr long longest_age = 250;            ///< steps after which a wide list is made anew

  /// Whether a list that still holds is wider than it should be.
  bool too_wide(double skin, long age) const { return age >= longest_age && skin > 3 * least * diameter_; }

  /// The list is built with this skin once, before the first one: columns then have room for every list to come of a
  /// sample that keeps its density.
  double widest() const { return most * diameter_; }
  double first() const { return 0.03 * diameter_; }

  /// The next skin, after one that lasted `age` steps; `idle`: listed pairs per grain that don't touch.
  double next(double skin, long age, double idle) const {
    const double wanted = std::sqrt(building_cost * skin * skin / (std::max(idle, 1e-3) * std::max(age, 1L)));
    return std::clamp(std::clamp(wanted, skin / 4, 2 * skin), least * diameter_, most * diameter_);
  }

 private:
  double diameter_;
};

}  // namespace galet::md
