// Projection on the cone of the contact bounds, {z : |z_b| <= mu_b z_n for each part b}.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

namespace galet::cd {

/// The normal part of the projection of a point on the cone {|z_b| <= mu_b z_n for each part b}: the point's own normal
/// part is z_n, the norms of its other parts are `norms`. The other parts are then cut to mu_b times the result.
/// Minimum over s >= 0 of (s - z_n)^2 + sum of max(0, norm_b - mu_b s)^2, convex and piecewise quadratic: parts leave
/// the sum as s grows, so that it is enough to add them in the order in which they do.
template <std::size_t N>
inline double projected_normal(double z_n, const std::array<double, N>& norms, const std::array<double, N>& mu) {
  // Parts that are still cut at the minimum: start with all, and let go of those that the result contains.
  std::array<bool, N> cut;
  cut.fill(true);
  for (std::size_t round = 0;; ++round) {
    double numerator = z_n, denominator = 1;
    for (std::size_t b = 0; b < N; ++b)
      if (cut[b]) numerator += mu[b] * norms[b], denominator += mu[b] * mu[b];
    const double s = std::max(0.0, numerator / denominator);
    bool stands = true;
    for (std::size_t b = 0; b < N; ++b)
      if (cut[b] && norms[b] <= mu[b] * s) cut[b] = false, stands = false;
    if (stands || round == N) return s;
  }
}

/// How much of a part of norm `norm` stays within `bound`.
inline double kept(double norm, double bound) { return norm > bound ? bound / norm : 1; }

}  // namespace galet::cd
