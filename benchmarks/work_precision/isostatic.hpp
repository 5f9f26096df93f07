// A packing of frictionless rigid disks at rest under stresses sigma_xx and sigma_yy that are held: isostatic, so that
// its contact forces follow from statics alone (G f = load, common/measure/equilibrium_matrix.hpp).
#pragma once

#include <map>
#include <tuple>
#include <vector>

#include "common/engine/snapshot.hpp"
#include "common/scene/sample.hpp"
#include "common/scene/scene.hpp"

namespace galet::precision {

using ContactKey = std::tuple<int, int, Image<2>>;
struct ContactState {
  double force = 0;               ///< normal part
  double branch = 0;              ///< its length
  Vec<2> whole = Vec<2>::Zero();  ///< force on j
};
using ContactMap = std::map<ContactKey, ContactState>;
ContactMap contacts_of(const Snapshot<2>& state);

/// Disks +-20 % in a periodic cell under sigma_xx = sigma_yy = 1, each held by its own component.
Scene loaded_scene(int count, double friction);

/// Cell and positions times `factor`, sizes as they are.
void scale(Sample<2>& sample, double factor);

/// What an engine holds, at rest.
Sample<2> at_rest(const Snapshot<2>& state, const Sample<2>& like);

/// A packing of that scene, compressed from a gas by md at kappa = 1e4, at rest, its grains about to touch.
Sample<2> soft_packing(int count, std::uint64_t seed);

struct IsostaticPacking {
  Sample<2> start;
  std::vector<ContactKey> key;                ///< of each contact that carries force
  std::vector<double> branch;                 ///< its length
  std::vector<double> isotropic, deviatoric;  ///< force of each under (1, 1), and change per x of (1 + x, 1 - x)
  double largest_deviator = 0;                ///< x at which the first contact opens
  std::vector<double> forces(double x) const;
};

/// Throws RunError when the packing is not isostatic.
IsostaticPacking isostatic_packing();

}  // namespace galet::precision
