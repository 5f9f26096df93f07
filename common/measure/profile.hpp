// Profile across a sample: layers of equal thickness along one cell vector.
//   velocity        mean over the layer's grains (by centre) of v + L x, x wrapped into the cell
//   shear_rate      d velocity / dy, from the neighbouring layers' means at the mean heights of their grains (at an
//   open
//                   end, and beside an empty layer, from one side)
//   fluctuation     sqrt(<|v - <v>|^2> / D), per component, <.> over the layer's grains; v is measured about its own
//                   mean in the layer, so that the affine flow L x adds nothing to it
//   temperature     <m |v - <v>|^2> / D, an energy
//   solid_fraction  volume of grains inside the layer (each grain cut exactly at the layer's faces) / layer volume
//   stress          sum over contacts of share * F (x) b, plus sum over the layer's grains of m (v - <v>) (x) (v -
//   <v>),
//                   over the layer volume; share: the part of the branch that lies in the layer, so that the contact
//                   parts of all layers have the mean of the sample's contact stress. Positive in compression.
// Layers are cut in the fractional coordinate of the cell vector, so that they fit a periodic cell however tilted;
// `position` (y) is the distance of the layer's middle from the cell's lower face, along the faces' normal. In a cell
// that is not periodic there, centres outside it count in the end layers and matter outside it is not counted.
// Vectors and tensors of disks have zeros for z. Sources: Love-Weber stress by layers as in da Cruz et al. 2005.
// Cost: one pass over grains and contacts.
#pragma once

#include <vector>

#include "common/engine/snapshot.hpp"

namespace galet {

struct ProfileRow {
  double position = 0;
  int grains = 0;                      ///< centres in the layer
  Vec<3> velocity = Vec<3>::Zero();    ///< 0 in a layer without grains
  Vec<3> shear_rate = Vec<3>::Zero();  ///< 0 where it has no meaning
  double fluctuation = 0;
  double temperature = 0;
  double solid_fraction = 0;
  Mat<3> stress = Mat<3>::Zero();
};

/// Layers along cell vector `direction` (0, 1 or 2; 1 is the gradient of plane shear).
template <int D>
std::vector<ProfileRow> layer_profile(const Snapshot<D>& snapshot, int layers, int direction = 1);

extern template std::vector<ProfileRow> layer_profile<2>(const Snapshot<2>&, int, int);
extern template std::vector<ProfileRow> layer_profile<3>(const Snapshot<3>&, int, int);

}  // namespace galet
