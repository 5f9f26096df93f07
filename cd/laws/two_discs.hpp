// Friction and rolling resistance of one contact, coupled through the spins of unlike grains:
//
//   slip = w_x x + c y + a,  |x| <= A,  slip opposite to x where |x| = A, else zero
//   turn = c x + w_y y + b,  |y| <= B,  turn opposite to y where |y| = B, else zero
//
// x, y are scalars (disks) or vectors (spheres); w_x, w_y > 0 and c^2 < w_x w_y, so that the solution is the minimum of
// a strictly convex function and unique. If x stays inside its disc it can be eliminated, and what is left for y has an
// isotropic block w_y - c^2 / w_x: a radial projection is exact. The same with x and y exchanged. Only where both are
// at their bounds the two projections alternate until they stand (a contraction by c^2 / (w_x w_y), 5/7 for a sphere on
// a plane and at most that; finitely many steps for disks). Symbols: cd/problem.hpp. Cost: two projections.
#pragma once

#include <algorithm>
#include <cmath>

#include "common/core/types.hpp"

namespace galet::cd {

/// Radial projection on the disc |value| <= bound (an interval for scalars).
inline double bounded(double value, double bound) { return std::clamp(value, -bound, bound); }
inline Vec<3> bounded(const Vec<3>& value, double bound) {
  const double squared = value.squaredNorm();
  return squared > bound * bound ? Vec<3>((bound / std::sqrt(squared)) * value) : value;
}

template <class Value>
struct TwoDiscs {
  double w_x, w_y, c;
  Value x, y;

  /// Replaces (x, y), whose slip and turn are given, by the solution within the bounds A and B.
  void solve(const Value& slip, const Value& turn, double bound_x, double bound_y) {
    if (c == 0 || w_y <= 0) {
      x = bounded(Value(x - slip / w_x), bound_x);
      y = w_y > 0 ? bounded(Value(y - turn / w_y), bound_y) : Value(0 * y);
      return;
    }
    const Value a = slip - w_x * x - c * y, b = turn - c * x - w_y * y;
    y = bounded(Value((c / w_x * a - b) / (w_y - c * c / w_x)), bound_y);
    x = -(a + c * y) / w_x;
    if (squared(x) <= bound_x * bound_x) return;
    x = bounded(Value((c / w_y * b - a) / (w_x - c * c / w_y)), bound_x);
    y = -(b + c * x) / w_y;
    if (squared(y) <= bound_y * bound_y) return;
    y = bounded(y, bound_y);
    for (int step = 0; step < 60; ++step) {
      const Value before = y;
      x = bounded(Value(-(a + c * y) / w_x), bound_x);
      y = bounded(Value(-(b + c * x) / w_y), bound_y);
      if (squared(Value(y - before)) <= 1e-30 * bound_y * bound_y) return;
    }
  }
};

}  // namespace galet::cd
