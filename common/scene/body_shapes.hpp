// Grains of rigid bodies that a scene gives by a shape, and those that it lists for bodies beside drawn grains.
//
//   wall  a row (disks) or square layer (spheres) across the cell: along each direction of the wall as many grains as
//         lie `spacing` mean diameters or more apart, evenly; centres at the coordinate `at` of the direction `across`
//   ring  likewise on a circle of radius `radius` about `centre`; in 3D a stack of rings along z, every second one
//   turned
//         by half a place: a rough cylinder. `segments` of it are bodies of their own, each free along its radius and
//         pressed on the grains with pressure * arc (* height in 3D): a rough boundary that yields like a membrane
//   chain, polygon  `size` equal grains in line, or at the corners of a regular polygon, neighbours `spacing` diameters
//         apart: clumps. `copies` of them are placed where their enclosing spheres find room, and turned at random
// Their diameters are drawn from the scene's distribution, one stream per body. Neighbours may overlap: they are glued.
//
// Walls and rings are also the bounds within which free grains are placed: between a wall and the middle of the cell,
// inside or outside a ring.
#pragma once

#include <vector>

#include "common/geometry/cell.hpp"
#include "common/scene/random_insertion.hpp"
#include "common/scene/scene.hpp"

namespace galet {

/// Grains of rigid bodies.
template <int D>
struct GluedGrains : Obstacles<D> {
  std::vector<int> body;      ///< index of the scene's body
  std::vector<int> material;  ///< index of the scene's material
  void add(const Vec<D>& x, double r, int of, int made_of) {
    this->position.push_back(x), this->radius.push_back(r);
    body.push_back(of), material.push_back(made_of);
  }
};

/// Whether a body of the scene has its grains made.
bool any_shape(const Scene& scene);
inline bool is_clump(const BodySpec& body) {
  return body.shape == BodyShape::chain || body.shape == BodyShape::polygon;
}

/// The scene with a body for each copy of a clump and each segment of a ring, called "name 1", "name 2", ... Scenes
/// that are read from files are so already; doing it again changes nothing.
Scene with_bodies_apart(Scene scene);

/// Clumps before they have a place: index and enclosing radius.
struct UnplacedClump {
  int body;
  double radius;
};
std::vector<UnplacedClump> unplaced_clumps(const Scene& scene);

/// Grains of a clump whose centre is at `centre`.
template <int D>
void add_clump(const Scene& scene, const UnplacedClump& clump, const Vec<D>& centre, GluedGrains<D>& glued);

/// Grains of walls and rings.
template <int D>
void add_shapes(const Scene& scene, const Cell<D>& cell, GluedGrains<D>& glued);

/// Surfaces that bound the free grains when they are placed: those through the centres of walls and rings.
template <int D>
std::vector<Plane<D>> shape_bounds(const Scene& scene, const Cell<D>& cell);

extern template void add_clump<2>(const Scene&, const UnplacedClump&, const Vec<2>&, GluedGrains<2>&);
extern template void add_clump<3>(const Scene&, const UnplacedClump&, const Vec<3>&, GluedGrains<3>&);
extern template void add_shapes<2>(const Scene&, const Cell<2>&, GluedGrains<2>&);
extern template void add_shapes<3>(const Scene&, const Cell<3>&, GluedGrains<3>&);
extern template std::vector<Plane<2>> shape_bounds<2>(const Scene&, const Cell<2>&);
extern template std::vector<Plane<3>> shape_bounds<3>(const Scene&, const Cell<3>&);

}  // namespace galet
