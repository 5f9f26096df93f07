// How far impulses are from a solution of a discrete contact problem, independent of every solver.
//
//   errS = |r~ - P_K(r~ - u^~)| / max(|q~|, |r~|, |u~|)      in the scaled problem (cd/discrete/scaled_problem.hpp)
//   errP = |r - P_K(r - u^)| / max(|q|, |r|, |u|)            in the given units
//
// with u^ = u + (mu |u_T| + mu_R |u_R|) e_N. errS depends on no unit; errP is the error that Siconos reports
// (Acary, Bremond and Huber 2018). Nothing is divided where the denominator is at most 1e-16. Both are zero exactly at
// solutions. Where |r| is far above |q| (wedges, or impulses that grow for want of a solution) both turn lax: the miss
// itself is given too, beside |q~| and |r~|. Cost: one product with W.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>

#include "cd/discrete/scaled_problem.hpp"

namespace galet::cd {

struct DiscreteError {
  double scaled = 0;     ///< errS
  double siconos = 0;    ///< errP
  double force = 0;      ///< |r~ - P_K(r~ - u^~)| / |r~|
  double violation = 0;  ///< largest -u_N, in given units
  double miss = 0;       ///< |r~ - P_K(r~ - u^~)|
  double load = 0;       ///< |q~|
  double impulse = 0;    ///< |r~|
};

template <int B>
DiscreteError discrete_error(const ScaledProblem<B>& problem, std::span<const typename ScaledProblem<B>::Vector> r) {
  using Vector = typename ScaledProblem<B>::Vector;
  struct Sums {
    double map = 0, r = 0, u = 0, q = 0;
    void add(const Cone<B>& cone, const Vector& impulse, const Vector& motion, const Vector& load) {
      Vector corrected = motion;
      corrected[0] += cone.corrected(motion);
      map += (impulse - cone.project(impulse - corrected)).squaredNorm();
      r += impulse.squaredNorm(), u += motion.squaredNorm(), q += load.squaredNorm();
    }
    double relative() const {
      const double size = std::sqrt(std::max({r, u, q}));
      return size > 1e-16 ? std::sqrt(map) / size : std::sqrt(map);
    }
  } scaled, given;
  DiscreteError error;
  for (int c = 0; c < problem.size(); ++c) {
    const Vector u = problem.motion(c, r);
    const Vector& scale = problem.scale[c];
    scaled.add(problem.cone[c], r[c], u, problem.q[c]);
    Cone<B> cone = problem.cone[c];
    if constexpr (B == 5) cone.mu_r *= scale[B - 1] / scale[0];
    const Vector given_u = u.cwiseQuotient(scale);
    given.add(cone, scale.cwiseProduct(r[c]), given_u, problem.q[c].cwiseQuotient(scale));
    error.violation = std::max(error.violation, -given_u[0]);
  }
  error.scaled = scaled.relative();
  error.siconos = given.relative();
  error.miss = std::sqrt(scaled.map), error.load = std::sqrt(scaled.q), error.impulse = std::sqrt(scaled.r);
  error.force = scaled.r > 0 ? std::sqrt(scaled.map / scaled.r) : std::sqrt(scaled.map);
  return error;
}

}  // namespace galet::cd
