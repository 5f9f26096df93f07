// A bound of the grains' non-affine displacements since the neighbour list was built, from velocities: so that
// positions need to be looked at only when the list could have expired. The list's own test decides, so that the bound
// changes when it is made, but never what it finds.
#pragma once

#include <limits>

#include "common/core/types.hpp"

namespace galet::md {

class MoveBound {
 public:
  /// The displacements are at most `largest` now.
  void set(double largest) { bound_ = largest; }
  /// Nothing is known.
  void forget() { bound_ = std::numeric_limits<double>::infinity(); }

  /// A step with half-step velocities of at most `fastest` in the velocity gradient L: s' = F s + dt A v with A and F
  /// of md/grain_pass.hpp, whose norms are at most 1 / (1 - dt |L| / 2) and (1 + dt |L| / 2) / (1 - dt |L| / 2).
  template <class Matrix>
  void moved(double fastest, const Matrix& gradient, double dt) {
    const double turn = 0.5 * dt * gradient.norm();
    bound_ = turn < 1 ? ((1 + turn) * bound_ + dt * fastest) / (1 - turn) : std::numeric_limits<double>::infinity();
  }

  /// Whether it may be more (with room for rounding), or is unknown.
  bool exceeds(double allowed) const { return !((1 + 1e-9) * bound_ <= allowed); }

 private:
  double bound_ = std::numeric_limits<double>::infinity();
};

}  // namespace galet::md
