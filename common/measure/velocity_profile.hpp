// Profile across a sheared sample: layers of equal thickness along the gradient direction y.
//   velocity        mean over the layer's grains (by centre) of (v + L x)_x, x wrapped into the cell
//   fluctuation     sqrt( <|v - <v>|^2> / D ), per component, <.> over the layer's grains; v is measured about its own
//                   mean in the layer, so that the affine flow L x adds nothing to it
//   solid_fraction  volume of grains inside the layer (each grain cut exactly at the layer's faces) / layer volume
// Layers are cut in the fractional coordinate of the second cell vector, so that they fit a periodic cell however
// tilted; y is the distance of the layer's middle from the cell's lower face. In a cell that is not periodic along y,
// centres outside it count in the end layers and matter outside it is not counted. Cost: one pass.
#pragma once

#include <vector>

#include "common/engine/snapshot.hpp"

namespace galet {

struct ProfileRow {
  double y = 0;
  double velocity = 0;  ///< 0 in a layer without grains
  double fluctuation = 0;
  double solid_fraction = 0;
  int grains = 0;  ///< centres in the layer
};

template <int D>
std::vector<ProfileRow> velocity_profile(const Snapshot<D>& snapshot, int layers);

extern template std::vector<ProfileRow> velocity_profile<2>(const Snapshot<2>&, int);
extern template std::vector<ProfileRow> velocity_profile<3>(const Snapshot<3>&, int);

}  // namespace galet
