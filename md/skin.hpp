// The skins of the neighbour lists, tuned by the run itself: a wide inner skin lists pairs that never touch, a narrow
// one has the list taken anew from the outer one too often, whose skin decides how often pairs are searched for. With e
// pairs per grain and unit skin that don't touch, a displacement v per step, P pairs in the outer list and costs in
// evaluations of a pair, the cost per grain and step is
//   e s + c P v / s + C v / (S - s)
// c: of looking at an outer pair and carrying it on, C: of a search. Over the outer skin it is least for
//   (S - s)^2 = C s / (c e)
// (P grows by e S). Of thin skins the pairs that don't touch grow less: the gaps of a dense sample pile up at zero,
// their number about as s^a with a = 0.4 (spheres) to 1 (dilute). With E(s) of them the cost E(s) + c P v / s is least
// where
//   a E(s) = c P v / s = c P / n
// for a skin s that lasts n steps; from any other one, s [c P / (a E n)]^(1 / (1 + a)) comes nearer. We take a = 1/2.
// All of it depends on counts only, never on time measured, so that runs are repeatable.
#pragma once

#include <algorithm>
#include <cmath>

namespace galet::md {

class Skin {
 public:
  explicit Skin(double diameter) : diameter_(diameter) {}

  static constexpr double least = 0.0003, most = 0.2;  ///< of the mean diameter
  static constexpr double searching_cost = 75;         ///< C
  static constexpr double pair_cost = 3;               ///< c
  static constexpr double narrowing_cost = 20;         ///< c P
  static constexpr long longest_age = 250;             ///< steps after which a wide list is made anew

  /// Whether a list that still holds is wider than it should be.
  bool too_wide(double skin, long age) const { return age >= longest_age && skin > 3 * least * diameter_; }

  /// The lists are built with this skin once, before the first one: columns then have room for every list to come of a
  /// sample that keeps its density.
  double widest() const { return most * diameter_; }
  double first() const { return 0.03 * diameter_; }

  /// The next inner skin, after one that lasted `age` steps; `idle`: listed pairs per grain that don't touch.
  double next(double skin, long age, double idle) const {
    const double steps = 2 * narrowing_cost / std::max(idle, 1e-3);  // that the best skin lasts
    const double wanted = skin * std::cbrt(std::pow(steps / static_cast<double>(std::max(age, 1L)), 2));
    return std::clamp(std::clamp(wanted, skin / 4, 2 * skin), least * diameter_, most * diameter_);
  }

  /// The outer skin that goes with it; `idle_per_skin`: e.
  double outer(double skin, double idle_per_skin) const {
    const double wider = std::sqrt(searching_cost * skin / (pair_cost * std::max(idle_per_skin, 1e-3 / diameter_)));
    return std::clamp(skin + wider, skin, widest());
  }

 private:
  double diameter_;
};

}  // namespace galet::md
