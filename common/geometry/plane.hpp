// A plane boundary: grains stay on the side that its normal points to. It moves with an imposed velocity.
#pragma once

#include "common/core/types.hpp"

namespace galet {

template <int D>
struct Plane {
  Vec<D> point = Vec<D>::Zero();
  Vec<D> normal = Vec<D>::UnitY();  ///< unit vector, from the plane into the grains' side
  Vec<D> velocity = Vec<D>::Zero();
};

}  // namespace galet
