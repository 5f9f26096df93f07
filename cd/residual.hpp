// How far an iterate is from a solution: the natural map of the frictional contact problem, contact by contact scaled
// to a unit mean block, relative to the impulses.
//   err = sqrt( sum |r~ - P_K(r~ - u^)|^2 / sum |r~|^2 ),   u^ = (u_N + offset + mu |u_T|, u_T) / sqrt(w),
//   r~ = r sqrt(w),  w = mean of the diagonal of the contact's block W_cc,  K Coulomb's cone.
// r~ and u^ are square roots of energies, so err depends on no unit; it reads as the relative error of the impulses
// that the worst-case linear answer of each contact alone would show. It is zero exactly at solutions. (The usual
// denominator max(|q|, |r|, |u|) is not used: in a flow, sliding velocities are far above r w, and the forces would
// then be tested against a scale that grows as dt falls.)
// Source: natural map after De Saxce and Feng 1998; Acary, Bremond and Huber 2018. Cost: one pass.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "cd/problem.hpp"
#include "common/core/parallel.hpp"

namespace galet::cd {

/// Squared distance of r to P_K(r - u^) in scaled form, for components (N, |T| along t), and |r~|^2.
struct ResidualParts {
  double map = 0;
  double impulse = 0;
  ResidualParts& operator+=(const ResidualParts& other) {
    map += other.map;
    impulse += other.impulse;
    return *this;
  }
};

/// Projection of (z_n, z_t) on the cone |z_t| <= mu z_n; Tangent is a number or a vector.
template <class Tangent>
inline void project_on_cone(double mu, double& z_n, Tangent& z_t, double norm_t) {
  if (norm_t <= mu * z_n) return;
  if (mu * norm_t <= -z_n) {
    z_n = 0;
    z_t *= 0.0;
    return;
  }
  const double along = (z_n + mu * norm_t) / (1 + mu * mu);
  z_t *= mu * along / norm_t;
  z_n = along;
}

template <Layout Y>
inline ResidualParts contact_residual(const Problem<Y>& problem, const Iterate<Y>& iterate, std::size_t k) {
  constexpr int D = Y.dim;
  const Vec<D> u = relative_velocity(problem, iterate, iterate.gradient, k);
  const Vec<D>& n = problem.normal[k];
  const Reaction<Y>& r = iterate.reaction[k];
  const double u_n = n.dot(u) + problem.offset[k];
  if (problem.inverse_wn[k] == 0) return {};  // nothing can move this contact
  if constexpr (!Y.friction) {
    const double w = problem.wn[k];
    const double miss = r[0] - std::max(0.0, r[0] - u_n / w);
    return {w * miss * miss, w * r[0] * r[0]};
  } else {
    const double w = (problem.wn[k] + (D - 1) / problem.inverse_wt[k]) / D;
    const Vec<D> u_t = u - n.dot(u) * n;
    const Vec<D> p = impulse_vector<Y>(n, r);
    const double p_n = n.dot(p);
    const Vec<D> p_t = p - p_n * n;
    double z_n = p_n - (u_n + problem.friction * u_t.norm()) / w;
    Vec<D> z_t = p_t - u_t / w;
    project_on_cone(problem.friction, z_n, z_t, z_t.norm());
    return {w * ((p_n - z_n) * (p_n - z_n) + (p_t - z_t).squaredNorm()), w * p.squaredNorm()};
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
