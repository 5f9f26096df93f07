// The problem of one contact with the others held: closed form for disks and spheres.
//   r_N' = max(0, r_N - (u_N + offset) / W_NN)
//   r_T' = P_disc(mu r_N')(r_T - u_T / W_TT)         radial projection on the disc (an interval in 2D)
// Exact, because the block is diagonal: r_N' does not depend on r_T, and the projection solves Coulomb's law for an
// isotropic W_TT. Signs: u_N > 0 opening, r_T opposes u_T. Source: Jean 1999; Jourdan, Alart and Jean 1998.
#pragma once

#include <algorithm>
#include <cmath>

#include "cd/problem.hpp"

namespace galet::cd {

/// New impulse of contact k, given its relative velocity u.
template <Layout Y>
inline Reaction<Y> solve_contact(const Problem<Y>& problem, std::size_t k, const Vec<Y.dim>& u, const Reaction<Y>& r) {
  const Vec<Y.dim>& n = problem.normal[k];
  const double u_n = n.dot(u);
  if constexpr (!Y.friction) {
    return Reaction<Y>(std::max(0.0, r[0] - (u_n + problem.offset[k]) * problem.inverse_wn[k]));
  } else if constexpr (Y.dim == 2) {
    const double r_n = std::max(0.0, r[0] - (u_n + problem.offset[k]) * problem.inverse_wn[k]);
    const double u_t = n.x() * u.y() - n.y() * u.x();
    const double limit = problem.friction * r_n;
    return {r_n, std::clamp(r[1] - u_t * problem.inverse_wt[k], -limit, limit)};
  } else {
    const double old_n = n.dot(r);
    const double r_n = old_n - (u_n + problem.offset[k]) * problem.inverse_wn[k];
    if (r_n <= 0) return Reaction<Y>::Zero();
    Vec<3> tangential = r - old_n * n - problem.inverse_wt[k] * (u - u_n * n);
    const double limit = problem.friction * r_n, squared = tangential.squaredNorm();
    if (squared > limit * limit) tangential *= limit / std::sqrt(squared);
    return r_n * n + tangential;
  }
}

}  // namespace galet::cd
