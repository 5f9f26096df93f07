#include "common/measure/profile.hpp"

#include <algorithm>
#include <cmath>

#include "common/core/error.hpp"
#include "common/geometry/wrap.hpp"
#include "common/measure/grain_cuts.hpp"

namespace galet {

namespace {

/// The layers of a cell while they are being filled. Fractions are those of the cell vector that is cut.
template <int D>
struct Layers {
  const Snapshot<D>& snapshot;
  const Cell<D>& cell;
  int direction;
  bool periodic;
  Mat<D> inverse;
  double height, thickness;
  std::vector<ProfileRow> rows;
  std::vector<int> layer_of = {};          ///< of each grain
  std::vector<double> fraction = {};       ///< of each grain's centre
  std::vector<double> mean_fraction = {};  ///< of a layer's grains
  std::vector<Vec<D>> mean_fluctuation = {};
  std::vector<Vec<D>> mean_velocity = {};

  int count() const { return static_cast<int>(rows.size()); }

  /// Index of a layer below or above the cell: of its image, or -1 where there is none.
  int inside(int layer) const {
    if (layer >= 0 && layer < count()) return layer;
    return periodic ? ((layer % count()) + count()) % count() : -1;
  }
};

/// Adds the volume of a grain whose centre is at `height` to the layers that it crosses.
template <int D>
void add_matter(Layers<D>& layers, double height, double radius) {
  const int lowest = static_cast<int>(std::floor((height - radius) / layers.thickness));
  const int highest = static_cast<int>(std::floor((height + radius) / layers.thickness));
  for (int layer = lowest; layer <= highest; ++layer) {
    const int target = layers.inside(layer);
    if (target < 0) continue;
    const double below = volume_below<D>(layer * layers.thickness - height, radius);
    const double above = volume_below<D>((layer + 1) * layers.thickness - height, radius);
    layers.rows[target].solid_fraction += above - below;
  }
}

template <int D>
void add_grains(Layers<D>& layers) {
  const Snapshot<D>& snapshot = layers.snapshot;
  const int count = layers.count();
  layers.layer_of.resize(snapshot.grains());
  layers.fraction.resize(snapshot.grains());
  layers.mean_fraction.assign(count, 0);
  layers.mean_fluctuation.assign(count, Vec<D>::Zero());
  layers.mean_velocity.assign(count, Vec<D>::Zero());
  for (int i = 0; i < snapshot.grains(); ++i) {
    const Vec<D> s = wrapped_fraction<D>(layers.cell, layers.inverse, snapshot.position[i]);
    const double fraction = s[layers.direction];
    const int layer = std::clamp(static_cast<int>(std::floor(fraction * count)), 0, count - 1);
    layers.layer_of[i] = layer;
    layers.fraction[i] = fraction;
    ++layers.rows[layer].grains;
    layers.mean_fraction[layer] += fraction;
    layers.mean_fluctuation[layer] += snapshot.velocity[i];
    layers.mean_velocity[layer] += snapshot.velocity[i] + layers.cell.rate * (layers.cell.box * s);
    add_matter(layers, fraction * layers.height, snapshot.radius[i]);
  }
  for (int k = 0; k < count; ++k) {
    const int grains = layers.rows[k].grains;
    if (grains == 0) continue;
    layers.mean_fraction[k] /= grains;
    layers.mean_fluctuation[k] /= grains;
    layers.mean_velocity[k] /= grains;
    layers.rows[k].velocity.template head<D>() = layers.mean_velocity[k];
  }
}

/// Fluctuations about the layers' means: temperature and kinetic stress (still sums over the layer).
template <int D>
void add_fluctuations(Layers<D>& layers) {
  const Snapshot<D>& snapshot = layers.snapshot;
  for (int i = 0; i < snapshot.grains(); ++i) {
    ProfileRow& row = layers.rows[layers.layer_of[i]];
    const Vec<D> v = snapshot.velocity[i] - layers.mean_fluctuation[layers.layer_of[i]];
    row.fluctuation += v.squaredNorm();
    row.temperature += snapshot.mass[i] * v.squaredNorm();
    row.stress.template topLeftCorner<D, D>() += snapshot.mass[i] * v * v.transpose();
  }
}

/// Shares F (x) b among the layers that the branch crosses.
template <int D>
void add_contacts(Layers<D>& layers) {
  const ContactColumns<D>& contacts = *layers.snapshot.contacts;
  const int count = layers.count();
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const Mat<D> virial = contacts.force[c] * contacts.branch[c].transpose();
    const double length = layers.inverse.row(layers.direction).dot(contacts.branch[c]) * count;
    const double start = layers.fraction[contacts.i[c]] * count;
    const double low = std::min(start, start + length), high = std::max(start, start + length);
    const int first = static_cast<int>(std::floor(low)), last = static_cast<int>(std::floor(high));
    for (int layer = first; layer <= last; ++layer) {
      int target = layers.inside(layer);
      if (target < 0) target = std::clamp(layer, 0, count - 1);
      // A branch along the layer lies in it whole.
      const double share =
          first == last ? 1 : (std::min(high, layer + 1.0) - std::max(low, static_cast<double>(layer))) / (high - low);
      layers.rows[target].stress.template topLeftCorner<D, D>() += share * virial;
    }
  }
}

template <int D>
void add_shear_rate(Layers<D>& layers) {
  const int count = layers.count();
  const Vec<D> jump = layers.cell.rate * layers.cell.box.col(layers.direction);  // between images
  for (int k = 0; k < count; ++k) {
    if (layers.rows[k].grains == 0) continue;
    // The layer itself stands in for a neighbour that is not there.
    double from = layers.mean_fraction[k], to = from;
    Vec<D> low = layers.mean_velocity[k], high = low;
    const auto reach = [&](int layer, double& fraction, Vec<D>& velocity) {
      const int other = layers.inside(layer);
      if (other < 0 || layers.rows[other].grains == 0) return;
      const double images = (layer - other) / static_cast<double>(count);
      fraction = layers.mean_fraction[other] + images;
      velocity = layers.mean_velocity[other] + images * jump;
    };
    reach(k - 1, from, low);
    reach(k + 1, to, high);
    if (to > from) layers.rows[k].shear_rate.template head<D>() = (high - low) / ((to - from) * layers.height);
  }
}

}  // namespace

template <int D>
std::vector<ProfileRow> layer_profile(const Snapshot<D>& snapshot, int layers, int direction) {
  require(layers > 0, "a profile needs at least one layer");
  require(direction >= 0 && direction < D, "the direction of a profile is one of the cell vectors");
  const Cell<D>& cell = *snapshot.cell;
  const double height = face_distances<D>(cell.box)[direction];
  Layers<D> cut{snapshot,           cell,   direction,       cell.periodic[direction],
                cell.box.inverse(), height, height / layers, std::vector<ProfileRow>(layers)};
  add_grains(cut);
  add_fluctuations(cut);
  add_contacts(cut);
  add_shear_rate(cut);
  const double volume = cell.volume() / layers;
  for (int k = 0; k < layers; ++k) {
    ProfileRow& row = cut.rows[k];
    row.position = (k + 0.5) * cut.thickness;
    row.solid_fraction /= volume;
    row.stress /= volume;
    if (row.grains == 0) continue;
    row.fluctuation = std::sqrt(row.fluctuation / (D * row.grains));
    row.temperature /= D * row.grains;
  }
  return std::move(cut.rows);
}

template std::vector<ProfileRow> layer_profile<2>(const Snapshot<2>&, int, int);
template std::vector<ProfileRow> layer_profile<3>(const Snapshot<3>&, int, int);

}  // namespace galet
