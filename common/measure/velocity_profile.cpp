#include "common/measure/velocity_profile.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/core/error.hpp"
#include "common/geometry/wrap.hpp"

namespace galet {

namespace {

/// Volume of the part of a grain of radius R that lies below height t, measured from its centre.
template <int D>
double volume_below(double t, double radius) {
  t = std::clamp(t, -radius, radius);
  if constexpr (D == 2) {
    const double half_chord = std::sqrt((radius - t) * (radius + t));
    return radius * radius * (std::numbers::pi / 2 + std::atan2(t, half_chord)) + t * half_chord;
  } else {
    return std::numbers::pi * (radius + t) * (radius + t) * (2 * radius - t) / 3;
  }
}

/// Adds the volume of a grain whose centre is at `height` to the layers that it crosses.
template <int D>
void add_matter(std::vector<ProfileRow>& rows, double height, double radius, double thickness, bool periodic) {
  const int layers = static_cast<int>(rows.size());
  const int lowest = static_cast<int>(std::floor((height - radius) / thickness));
  const int highest = static_cast<int>(std::floor((height + radius) / thickness));
  for (int layer = lowest; layer <= highest; ++layer) {
    if (!periodic && (layer < 0 || layer >= layers)) continue;
    const double below = volume_below<D>(layer * thickness - height, radius);
    const double above = volume_below<D>((layer + 1) * thickness - height, radius);
    rows[((layer % layers) + layers) % layers].solid_fraction += above - below;
  }
}

}  // namespace

template <int D>
std::vector<ProfileRow> velocity_profile(const Snapshot<D>& snapshot, int layers) {
  require(layers > 0, "a velocity profile needs at least one layer");
  const Cell<D>& cell = *snapshot.cell;
  const Mat<D> inverse = cell.box.inverse();
  const double height = face_distances<D>(cell.box)[1], thickness = height / layers;
  std::vector<ProfileRow> rows(layers);
  std::vector<Vec<D>> sum(layers, Vec<D>::Zero());
  std::vector<double> squares(layers, 0.0);
  std::vector<int> layer_of(snapshot.grains());

  for (int i = 0; i < snapshot.grains(); ++i) {
    const Vec<D> s = wrapped_fraction<D>(cell, inverse, snapshot.position[i]);
    const int layer = std::clamp(static_cast<int>(std::floor(s[1] * layers)), 0, layers - 1);
    layer_of[i] = layer;
    ++rows[layer].grains;
    sum[layer] += snapshot.velocity[i];
    rows[layer].velocity += (snapshot.velocity[i] + cell.rate * (cell.box * s)).x();
    add_matter<D>(rows, s[1] * height, snapshot.radius[i], thickness, cell.periodic[1]);
  }
  for (int i = 0; i < snapshot.grains(); ++i) {
    const int layer = layer_of[i];
    squares[layer] += (snapshot.velocity[i] - sum[layer] / rows[layer].grains).squaredNorm();
  }
  for (int layer = 0; layer < layers; ++layer) {
    ProfileRow& row = rows[layer];
    row.y = (layer + 0.5) * thickness;
    row.solid_fraction /= cell.volume() / layers;
    if (row.grains == 0) continue;
    row.velocity /= row.grains;
    row.fluctuation = std::sqrt(squares[layer] / (D * row.grains));
  }
  return rows;
}

template std::vector<ProfileRow> velocity_profile<2>(const Snapshot<2>&, int);
template std::vector<ProfileRow> velocity_profile<3>(const Snapshot<3>&, int);

}  // namespace galet
