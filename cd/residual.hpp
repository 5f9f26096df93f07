// How far an iterate is from a solution: the natural map of the frictional contact problem, contact by contact scaled
// to a unit mean block, relative to the impulses.
//   err = sqrt( sum |r~ - P_K(r~ - u^)|^2 / sum |r~|^2 ),
//   u^ = (u_N + mu |u_T| + mu_R |w_R| + mu_P |w_P|, u_T) / sqrt(w), w_R / sqrt(W_RR), w_P / sqrt(W_PP)
//   r~ = r sqrt(w), gamma sqrt(W_RR), ...;  w = mean of the diagonal of the translational block; K the cone of the
//   bounds in these units, {|r_T| <= mu r_N, |gamma_R| <= mu_R r_N, |gamma_P| <= mu_P r_N}; u the law's motion
//   (cd/problem.hpp: with offset, lag and compliance).
// r~ and u^ are square roots of energies, so err depends on no unit; it reads as the relative error of the impulses
// that the worst-case linear answer of each contact alone would show. It is zero exactly at solutions. (The usual
// denominator max(|q|, |r|, |u|) is not used: in a flow, sliding velocities are far above r w, and the forces would
// then be tested against a scale that grows as dt falls.)
// Source: natural map after De Saxce and Feng 1998; Acary, Bremond and Huber 2018. Cost: one pass.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "cd/laws/cone_projection.hpp"
#include "cd/problem.hpp"
#include "common/core/parallel.hpp"

namespace galet::cd {

/// Squared distance of r to P_K(r - u^) in scaled form, and |r~|^2.
struct ResidualParts {
  double map = 0;
  double impulse = 0;
  ResidualParts& operator+=(const ResidualParts& other) {
    map += other.map;
    impulse += other.impulse;
    return *this;
  }
};

template <Layout Y>
inline ResidualParts contact_residual(const Problem<Y>& problem, const Iterate<Y>& iterate, std::size_t k) {
  constexpr int D = Y.dim;
  if (problem.inverse_wn[k] == 0) return {};  // nothing can move this contact
  const Components<Y> r = components<Y>(problem.normal[k], iterate.reaction[k]);
  const Components<Y> u = law_motion(problem, iterate, iterate.gradient, k, r);
  if constexpr (!Y.friction) {
    const double w = problem.wn[k];
    const double miss = r.normal - std::max(0.0, r.normal - u.normal / w);
    return {w * miss * miss, w * r.normal * r.normal};
  } else {
    const ContactLaw& law = problem.laws[problem.law[k]];
    const double w = (problem.wn[k] + (D - 1) / problem.inverse_wt[k]) / D;
    double corrected = u.normal + law.friction * std::sqrt(squared(u.tangential));
    const Spin<D> z_t = r.tangential - u.tangential / w;
    const double norm_t = std::sqrt(squared(z_t));
    const auto square = [](double value) { return value * value; };
    if constexpr (!Y.rolling) {
      const double s = projected_normal<1>(r.normal - corrected / w, {norm_t}, {law.friction});
      const Spin<D> miss = r.tangential - kept(norm_t, law.friction * s) * z_t;
      return {w * (square(r.normal - s) + squared(miss)), w * (square(r.normal) + squared(r.tangential))};
    } else {
      corrected += law.rolling * std::sqrt(squared(u.rolling)) + law.pivoting * std::abs(u.pivoting);
      const double wr = problem.wr[k], wp = D == 3 ? problem.wp[k] : 0;
      const Spin<D> z_r = wr > 0 ? Spin<D>(r.rolling - u.rolling / wr) : zero_spin<D>();
      const double z_p = wp > 0 ? r.pivoting - u.pivoting / wp : 0;
      // In units of r: a rolling part counts by the length sqrt(W_RR / w).
      const double length_r = std::sqrt(wr / w), length_p = std::sqrt(wp / w), norm_r = std::sqrt(squared(z_r));
      const double s =
          projected_normal<3>(r.normal - corrected / w, {norm_t, length_r * norm_r, length_p * std::abs(z_p)},
                              {law.friction, length_r * law.rolling, length_p * law.pivoting});
      const Spin<D> miss = r.tangential - kept(norm_t, law.friction * s) * z_t;
      const Spin<D> miss_r = r.rolling - kept(norm_r, law.rolling * s) * z_r;
      const double miss_p = r.pivoting - kept(std::abs(z_p), law.pivoting * s) * z_p;
      return {w * (square(r.normal - s) + squared(miss)) + wr * squared(miss_r) + wp * square(miss_p),
              w * (square(r.normal) + squared(r.tangential)) + wr * squared(r.rolling) + wp * square(r.pivoting)};
    }
  }
}

/// The residual err; `partial` is scratch. Zero when there is no impulse and nothing asks for one.
template <Layout Y>
double residual(const Problem<Y>& problem, const Iterate<Y>& iterate, std::vector<ResidualParts>& partial) {
  refill(partial, chunk_count(problem.size()), ResidualParts{});
  parallel_chunks(problem.size(), [&](std::size_t chunk, std::size_t begin, std::size_t end) {
    ResidualParts sum;
    for (std::size_t k = begin; k < end; ++k) sum += contact_residual(problem, iterate, k);
    partial[chunk] = sum;
  });
  ResidualParts total;
  for (const ResidualParts& part : partial) total += part;
  if (total.map == 0) return 0;
  return total.impulse > 0 ? std::sqrt(total.map / total.impulse) : std::numeric_limits<double>::infinity();
}

}  // namespace galet::cd
