// The problem of one contact with the others held, in closed form for disks and spheres.
//   r_N' = max(0, r_N - motion_N / W_NN)
//   r_T' = P(r_T - motion_T / W_TT)                    P: radial projection on the disc |r_T| <= mu r_N' (2D: interval)
//   with rolling: r_T' and gamma_R' together (two_discs.hpp), gamma_P' = P(gamma_P - motion_P / W_PP)
// Exact, because W couples r_N with nothing, and the projection solves a bounded law for an isotropic block.
// `motion` is the contact's law_motion() for the impulse r. Signs: u_N > 0 opening, r_T opposes u_T.
// Source: Jean 1999; Jourdan, Alart and Jean 1998.
#pragma once

#include <algorithm>
#include <cmath>

#include "cd/laws/two_discs.hpp"
#include "cd/problem.hpp"

namespace galet::cd {

/// New impulse of contact k.
template <Layout Y>
inline Components<Y> solve_contact(const Problem<Y>& problem, std::size_t k, const Components<Y>& motion,
                                   const Components<Y>& r) {
  Components<Y> next;
  next.normal = r.normal - motion.normal * problem.inverse_wn[k];
  if (!(next.normal > 0)) return {};
  if constexpr (Y.friction) {
    const ContactLaw& law = problem.laws[problem.law[k]];
    const double wt_inverse = problem.inverse_wt[k];
    if constexpr (!Y.rolling) {
      next.tangential = bounded(r.tangential - wt_inverse * motion.tangential, law.friction * next.normal);
    } else {
      // Tangential quantities turned by a quarter about n, where the block is symmetric (problem.hpp).
      const Vec<Y.dim>& n = problem.normal[k];
      const auto turned = [&](const Spin<Y.dim>& value) -> Spin<Y.dim> {
        if constexpr (Y.dim == 2)
          return value;
        else
          return n.cross(value);
      };
      TwoDiscs<Spin<Y.dim>> pair{1 / wt_inverse, problem.wr[k], problem.coupling[k], turned(r.tangential), r.rolling};
      pair.solve(turned(motion.tangential), motion.rolling, law.friction * next.normal, law.rolling * next.normal);
      next.rolling = pair.y;
      if constexpr (Y.dim == 2) {
        next.tangential = pair.x;
      } else {
        next.tangential = pair.x.cross(n);
        if (problem.wp[k] > 0)
          next.pivoting = bounded(r.pivoting - motion.pivoting / problem.wp[k], law.pivoting * next.normal);
      }
    }
  }
  return next;
}

}  // namespace galet::cd
