// What an engine shows of its state: the same columns whichever engine ran, so that a measure can't tell.
// Views stay valid until the engine advances.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "common/core/types.hpp"
#include "common/geometry/cell.hpp"
#include "common/geometry/plane.hpp"
#include "common/geometry/rigid_body.hpp"

namespace galet {

/// The pairs that carry a force, one entry each, sorted by (i, j, image): contacts, and with a cohesion of range D0
/// also pairs that attract each other across a gap.
/// j >= number of grains means plane j - grains.
template <int D>
struct ContactColumns {
  std::vector<int> i, j;
  std::vector<Image<D>> image;         ///< of j, as seen from i
  std::vector<Vec<D>> normal;          ///< n, from i to j
  std::vector<Vec<D>> branch;          ///< b, from i's centre to j's centre (to the contact point on a plane)
  std::vector<double> gap;             ///< g, negative in overlap
  std::vector<Vec<D>> force;           ///< F on j (cd: reaction / dt)
  std::vector<Spin<D>> torque;         ///< rolling and pivoting torque on j, in layouts with rolling resistance
  std::vector<std::uint8_t> touching;  ///< 0 for a pair that attracts across a gap; empty: all touch
  std::vector<double> mobilised;       ///< |F_T| / its bound, at most 1; NaN without friction, empty without any

  std::size_t size() const { return i.size(); }
  bool touches(std::size_t c) const { return touching.empty() || touching[c] != 0; }
  void clear() {
    i.clear(), j.clear(), image.clear(), normal.clear(), branch.clear(), gap.clear(), force.clear();
    torque.clear(), touching.clear(), mobilised.clear();
  }
};

template <int D>
struct Snapshot {
  std::string_view engine;  ///< "md" or "cd"
  double time = 0;
  const Cell<D>* cell = nullptr;
  std::span<const Plane<D>> planes;
  std::span<const Vec<D>> position;
  std::span<const Vec<D>> velocity;  ///< fluctuation v
  std::span<const Spin<D>> spin;     ///< empty in a frictionless layout
  std::span<const double> radius;
  std::span<const double> mass;
  std::span<const RigidBody<D>> bodies;  ///< rigid bodies, in the order of the scene
  std::span<const int> body_of;          ///< each grain's rigid body, or -1; empty without bodies
  std::span<const Vec<D>> arm;           ///< of each grain from its body's centre; empty without bodies
  const ContactColumns<D>* contacts = nullptr;

  int grains() const { return static_cast<int>(position.size()); }
  /// Whether a grain is part of a rigid body that moves as grains do.
  bool in_free_body(int grain) const {
    return grain < static_cast<int>(body_of.size()) && body_of[grain] >= 0 && bodies[body_of[grain]].is_free();
  }
};

}  // namespace galet
