// Initial states: lattice, dilute random gas, dense packing, listed grains, packings read from files, and checkpoints
// of other runs. (A compressed gas is a gas that the run loop compresses: see src/simulation.hpp.)
//
// Cell: origin at 0, a position is box * s with s in [0, 1) along periodic directions. Its size is cell.size; without
// it the volume of the grains drawn over initial.solid_fraction, edges in proportion to cell.aspect (listed grains:
// needed when a direction is periodic, else what encloses them; a packing file brings its own).
// Mass: grains.density * volume; else grains.mass (default 1) for a grain of mean diameter, the others in proportion
// to their volumes. A packing file that gives masses keeps them unless the scene sets one of the two.
// Velocities: with initial.speed > 0, normal with that root mean square per component and no total momentum (a packing
// file's own velocities are replaced); listed grains keep the velocities that they list.
// Every random number has its own stream, by seed, purpose and grain.
#pragma once

#include <string>
#include <vector>

#include "common/scene/sample.hpp"
#include "common/scene/scene.hpp"

namespace galet {

/// Diameters drawn from the scene's distribution, one stream per grain (size_distribution.hpp).
std::vector<double> draw_diameters(const Scene& scene, int count);

/// d: the mean of the scene's distribution; of the grains themselves when they are listed or read from a file.
double mean_diameter(const Scene& scene, const std::vector<double>& radius);

/// The sample in which the scene starts. Throws InputError when it can't be made (a gas denser than random
/// sequential insertion reaches, a packing file with an error, overlapping listed grains).
template <int D>
Sample<D> initial_sample(const Scene& scene);

extern template Sample<2> initial_sample<2>(const Scene&);
extern template Sample<3> initial_sample<3>(const Scene&);

}  // namespace galet
