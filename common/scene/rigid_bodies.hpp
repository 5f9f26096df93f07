// The rigid bodies of a scene with their grains: masses, centres, inertia and the places of the grains in each body.
#pragma once

#include <vector>

#include "common/geometry/rigid_body.hpp"
#include "common/scene/sample.hpp"
#include "common/scene/scene.hpp"

namespace galet {

/// Bodies and the grains that are glued to them. All columns are empty where there are none.
template <int D>
struct RigidBodies {
  std::vector<RigidBody<D>> body;
  std::vector<int> of;     ///< index of each grain's body, or -1
  std::vector<int> group;  ///< of each grain: its body, the first one for all segments of a ring, or -1; grains of one
                           ///< group do not act on each other
  std::vector<int> first, member;  ///< grains of body b, ascending: member[first[b]] .. member[first[b + 1]]
  std::vector<Vec<D>> offset;      ///< of each grain from its body's centre, in the body's frame; zero for free grains
  std::vector<double> contact_mass;  ///< of each grain: what a blow on it meets, see contact_masses()

  bool any_turning = false;  ///< whether one of them ever turns

  bool none() const { return body.empty(); }
  bool free(int grain) const { return of.empty() || of[grain] < 0; }
};

/// From the scene's bodies and the sample's grains (at the start: bodies are not turned yet). Mass, centre and inertia
/// are given by the scene or those of the grains: M = sum of m, c = sum of m x / M, I = sum of (I_i + m r^2) (in 3D
/// m (r^2 - r r^T)); with a mass of its own the body's inertia is in proportion. Where the cell is periodic a body's
/// grains are taken to be the nearest images of each other, neighbour by neighbour.
///
/// contact_mass of a grain of a body: 1 over the mean, over the directions of the blow, of 1 / M (along the body's free
/// directions) + (r x n).I^-1 (r x n); infinite for bodies that nothing moves. Dashpots take their critical damping
/// from it. Throws InputError when a body that turns reaches around a periodic cell, or has no grain.
template <int D>
RigidBodies<D> rigid_bodies(const Scene& scene, const Sample<D>& sample);

/// RigidBodies::group of grains of those bodies.
std::vector<int> contact_groups(const Scene& scene, const std::vector<int>& body_of);

/// Gives the grains of bodies the velocities and spins of these.
template <int D>
void move_with_bodies(const Scene& scene, Sample<D>& sample);

/// Whether a body of the scene ever turns.
bool any_turning(const Scene& scene);
inline bool turns(const BodySpec& body) {
  for (const bool free : body.free_rotation)
    if (free) return true;
  for (const double component : body.spin)
    if (component != 0) return true;
  return false;
}

extern template RigidBodies<2> rigid_bodies<2>(const Scene&, const Sample<2>&);
extern template RigidBodies<3> rigid_bodies<3>(const Scene&, const Sample<3>&);
extern template void move_with_bodies<2>(const Scene&, Sample<2>&);
extern template void move_with_bodies<3>(const Scene&, Sample<3>&);

}  // namespace galet
