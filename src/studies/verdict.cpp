#include "src/studies/verdict.hpp"

#include <cmath>

#include <fmt/format.h>

namespace galet {

Verdict judge(const Estimate& ours, const Published& published) {
  if (!std::isfinite(ours.value) || !std::isfinite(ours.error)) return Verdict::open;
  const double noise = 2 * ours.error;
  if (published.claim == Claim::equal) {
    const double distance = std::abs(ours.value - published.value);
    if (distance <= published.uncertainty) return Verdict::agrees;
    return distance <= noise ? Verdict::within_errors : Verdict::differs;
  }
  const double margin =
      published.claim == Claim::at_least ? ours.value - published.value : published.value - ours.value;
  if (margin >= noise) return Verdict::agrees;
  return margin >= -noise ? Verdict::within_errors : Verdict::differs;
}

std::string to_string(Verdict verdict) {
  switch (verdict) {
    case Verdict::agrees:
      return "yes";
    case Verdict::within_errors:
      return "yes (2 errors)";
    case Verdict::differs:
      return "NO";
    case Verdict::open:
      return "-";
  }
  return "";
}

std::string claim_text(const Published& published) {
  if (published.claim == Claim::at_least) return fmt::format(">= {:g}", published.value);
  if (published.claim == Claim::at_most) return fmt::format("<= {:g}", published.value);
  return fmt::format("{:g} ±{:g}", published.value, published.uncertainty);
}

}  // namespace galet
