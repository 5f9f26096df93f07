// Initial states: lattice, dilute random gas, listed grains, and packings read from files.
// (A compressed gas is a gas that the run loop compresses: see src/simulation.hpp.)
#pragma once

#include "common/scene/sample.hpp"
#include "common/scene/scene.hpp"

namespace galet {

/// Diameters drawn from the scene's distribution, one stream per grain.
std::vector<double> draw_diameters(const Scene& scene, int count);

/// The sample in which the scene starts. Throws InputError when it can't be made (a gas denser than random
/// sequential insertion reaches, a packing file with an error, overlapping listed grains).
template <int D>
Sample<D> initial_sample(const Scene& scene);

extern template Sample<2> initial_sample<2>(const Scene&);
extern template Sample<3> initial_sample<3>(const Scene&);

}  // namespace galet
