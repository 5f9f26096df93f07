// A sample: the grains in their cell, before any engine holds them. Engines start from a sample; packing files and
// pictures are samples too.
#pragma once

#include <vector>

#include "common/core/types.hpp"
#include "common/geometry/cell.hpp"
#include "common/geometry/plane.hpp"

namespace galet {

template <int D>
struct Sample {
  Cell<D> cell;
  std::vector<Plane<D>> planes;
  std::vector<Vec<D>> position;
  std::vector<Vec<D>> velocity;  ///< fluctuation v: the grain moves with v + L x
  std::vector<Spin<D>> spin;     ///< angular velocity
  std::vector<double> radius;
  std::vector<double> mass;
  std::vector<int> material;        ///< index: 0 is [material], 1.. the scene's further materials
  std::vector<int> plane_material;  ///< the same, one per plane; empty: all 0
  std::vector<int> body;  ///< index of the scene's rigid body that the grain is glued to, or -1; empty: none is

  int count() const { return static_cast<int>(position.size()); }
  void resize(int count) {
    position.assign(count, Vec<D>::Zero());
    velocity.assign(count, Vec<D>::Zero());
    spin.assign(count, zero_spin<D>());
    radius.assign(count, 0.5);
    mass.assign(count, 1.0);
    material.assign(count, 0);
  }
  /// Volume (area) of the grains' matter.
  double solid_volume() const {
    double sum = 0;
    for (double r : radius) sum += grain_volume<D>(2 * r);
    return sum;
  }
  double solid_fraction() const { return solid_volume() / cell.volume(); }
};

}  // namespace galet
