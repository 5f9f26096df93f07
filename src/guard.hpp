// Whether the state of a run can be believed: checked every guard.every steps, before a state is kept (checkpoints, the
// copy of the last sound state), and at the end. A state is refused, with the grain or contact and what to change, when
//   a position, velocity or spin is not finite;
//   two grains, or a grain and a plane, overlap by more than guard.overlap of the smaller radius;
//   a grain's centre is behind a plane;
//   a grain's speed |v| is above guard.speed v_s, or the kinetic energy per grain above guard.energy m v_s^2 / 2.
// v_s is the scene's own speed: the largest of the grains' speeds at the start, of the imposed rates times the cell's
// size, of planes and rigid bodies, of a fall through the cell, sqrt(2 |gravity| H), sqrt(P d^D / m), sqrt(F d / m) for
// the forces F of cohesion and on planes and bodies, and (md) a thousandth of d sqrt(K_N / m), the speed of sound. A
// scene that has none of these has no bounds on speed and energy. Cost: one pass over grains and contacts, and a
// snapshot.
#pragma once

#include <string_view>

#include "common/engine/snapshot.hpp"
#include "common/scene/derive.hpp"
#include "common/scene/sample.hpp"
#include "common/scene/scene.hpp"

namespace galet {

template <int D>
class Guard {
 public:
  Guard(const Scene& scene, const Derived& derived, const Sample<D>& start, EngineKind engine);

  /// Throws RunError.
  void check(const Snapshot<D>& snapshot) const;

  double own_speed() const { return own_speed_; }

 private:
  void check_grains(const Snapshot<D>& snapshot) const;
  void check_contacts(const Snapshot<D>& snapshot) const;

  GuardSpec bounds_;
  double own_speed_ = 0;  ///< v_s
  double mass_ = 1;       ///< m
  std::string_view smaller_step_, stiffer_;
};

extern template class Guard<2>;
extern template class Guard<3>;

}  // namespace galet
