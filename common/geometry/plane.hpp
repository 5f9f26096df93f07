// A plane boundary: grains stay on the side that its normal points to. It moves with an imposed velocity, or, with a
// mass, freely along its normal under the grains' forces and a force of its own (across the normal always as imposed).
#pragma once

#include "common/core/types.hpp"

namespace galet {

template <int D>
struct Plane {
  Vec<D> point = Vec<D>::Zero();
  Vec<D> normal = Vec<D>::UnitY();  ///< unit vector, from the plane into the grains' side
  Vec<D> velocity = Vec<D>::Zero();
  double inverse_mass = 0;  ///< 1 / mass of a plane that is free along its normal; 0: imposed velocity
  double force = 0;         ///< on a free plane, along its normal
};

}  // namespace galet
