// Which grain and which plane is of which material.
#pragma once

#include <string>

#include "common/scene/sample.hpp"
#include "common/scene/scene.hpp"

namespace galet {

/// 0 for [material] (also for an empty name), k + 1 for other_material[k]. Throws InputError for a name that no
/// material has.
int material_index(const Scene& scene, const std::string& name);

/// Fills `sample.material` (groups are drawn from the seed, listed grains say it; a packing file's column stays) and
/// `sample.plane_material`. Throws InputError when a grain of a file is of a material that the scene has not.
template <int D>
void assign_materials(const Scene& scene, Sample<D>& sample);

extern template void assign_materials<2>(const Scene&, Sample<2>&);
extern template void assign_materials<3>(const Scene&, Sample<3>&);

}  // namespace galet
