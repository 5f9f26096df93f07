#include "common/scene/materials.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "common/core/error.hpp"
#include "common/core/random.hpp"
#include "common/scene/random_insertion.hpp"

namespace galet {

int material_index(const Scene& scene, const std::string& name) {
  if (name.empty() || name == scene.material.name) return 0;
  for (std::size_t k = 0; k < scene.other_materials.size(); ++k)
    if (scene.other_materials[k].name == name) return static_cast<int>(k) + 1;
  throw InputError(fmt::format("no material is called '{}'", name));
}

namespace {

/// The grains in an order drawn from the seed: groups are the first ones, the next ones and so on, so that each has
/// exactly its share.
std::vector<int> drawn_order(const Scene& scene, int count) {
  std::vector<double> key(count);
  for (int i = 0; i < count; ++i)
    key[i] = RandomStream(scene.seed, stream_number(StreamPurpose::material, i)).uniform();
  std::vector<int> order(count);
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return key[a] < key[b]; });
  return order;
}

void draw_groups(const Scene& scene, std::vector<int>& material) {
  const int count = static_cast<int>(material.size());
  const std::vector<int> order = drawn_order(scene, count);
  double share = 0;
  int next = 0;
  for (const GroupSpec& group : scene.grains.groups) {
    share += group.fraction;
    const int end = std::min(count, static_cast<int>(std::lround(share * count)));
    const int index = material_index(scene, group.material);
    for (; next < end; ++next) material[order[next]] = index;
  }
}

}  // namespace

template <int D>
void assign_materials(const Scene& scene, Sample<D>& sample) {
  sample.plane_material.clear();
  for (const PlaneSpec& plane : scene.planes) sample.plane_material.push_back(material_index(scene, plane.material));
  for (const CylinderSpec& cylinder : scene.cylinders)
    sample.plane_material.push_back(material_index(scene, cylinder.material));
  if (scene.initial.kind == InitialKind::packing || scene.initial.kind == InitialKind::checkpoint) {
    // Atom types of a file say nothing to a scene of one material.
    if (scene.other_materials.empty()) std::fill(sample.material.begin(), sample.material.end(), 0);
    const int materials = static_cast<int>(scene.other_materials.size()) + 1;
    for (int i = 0; i < sample.count(); ++i)
      if (sample.material[i] < 0 || sample.material[i] >= materials)
        throw InputError(
            fmt::format("initial.file: grain {} is of material {}, but the scene has only {} (0 is "
                        "[material], LAMMPS counts types from 1)",
                        i, sample.material[i], materials));
    return;
  }
  sample.material.assign(sample.count(), 0);
  if (scene.initial.kind == InitialKind::listed) {
    for (int i = 0; i < sample.count(); ++i)
      sample.material[i] = material_index(scene, scene.grains.listed[i].material);
  } else {
    draw_groups(scene, sample.material);
  }
}

template void assign_materials<2>(const Scene&, Sample<2>&);
template void assign_materials<3>(const Scene&, Sample<3>&);

}  // namespace galet
