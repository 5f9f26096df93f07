#include "src/studies/effect.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "common/core/error.hpp"
#include "src/studies/estimates.hpp"

namespace galet {

namespace {

double surely(const Effect& effect) {
  return (std::abs(effect.change.value) - effect.quantile * effect.change.error) / effect.threshold;
}

double possibly(const Effect& effect) {
  return (std::abs(effect.change.value) + effect.quantile * effect.change.error) / effect.threshold;
}

}  // namespace

double student_quantile(int degrees_of_freedom) {
  constexpr std::array table = {12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306, 2.262, 2.228};
  require(degrees_of_freedom >= 1, "Student's distribution needs a degree of freedom");
  if (degrees_of_freedom <= static_cast<int>(table.size())) return table[degrees_of_freedom - 1];
  // Cornish and Fisher's expansion about the normal quantile z: right to 1e-3 from 10 on.
  constexpr double z = 1.959964;
  const double n = degrees_of_freedom;
  return z + (z * z * z + z) / (4 * n) + (5 * std::pow(z, 5) + 16 * z * z * z + 3 * z) / (96 * n * n);
}

Effect effect_of_averages(const Estimate& reference, const Estimate& changed, double threshold) {
  return {ratio(changed, reference) - Estimate{1, 0}, threshold, 2};
}

Effect effect_of_pairs(std::span<const double> reference, std::span<const double> changed, double threshold) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  const std::size_t pairs = std::min(reference.size(), changed.size());
  std::vector<Estimate> changes;
  for (std::size_t k = 0; k < pairs; ++k) changes.push_back({changed[k] / reference[k] - 1, 0});
  if (pairs < 2) return {{none, none}, threshold, 2};
  return {weighted_mean(changes), threshold, student_quantile(static_cast<int>(pairs) - 1)};
}

char letter_of(const Effect& effect) {
  if (surely(effect) > 1) return 'Y';
  return possibly(effect) < 1 ? 'N' : '?';
}

char letter_of(std::span<const Effect> effects) {
  bool none = !effects.empty();
  for (const Effect& effect : effects) {
    if (letter_of(effect) == 'Y') return 'Y';
    none = none && letter_of(effect) == 'N';
  }
  return none ? 'N' : '?';
}

const Effect& decisive_effect(std::span<const Effect> effects) {
  require(!effects.empty(), "no effect to choose from");
  const bool yes = letter_of(effects) == 'Y';
  return *std::max_element(effects.begin(), effects.end(), [&](const Effect& a, const Effect& b) {
    return yes ? surely(a) < surely(b) : possibly(a) < possibly(b);
  });
}

Estimate in_thresholds(const Effect& effect) {
  return {std::abs(effect.change.value) / effect.threshold,
          0.5 * effect.quantile * effect.change.error / effect.threshold};
}

}  // namespace galet
