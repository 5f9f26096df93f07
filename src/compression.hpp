// The stage before a run that starts from a compressed gas: the gas is compressed isotropically to the loading's
// pressure, by the engine that runs the scene, until it is in equilibrium.
#pragma once

#include "common/scene/derive.hpp"
#include "common/scene/scene.hpp"

namespace galet {

/// Equilibrium: kinetic energy per grain of the backbone below this times P d^D, and more (see equilibrium.hpp).
inline constexpr double compression_equilibrium = 1e-6;
/// The stage takes this many inertial times sqrt(m / (P d^(D-2))) at most.
inline constexpr double compression_limit = 1000;
/// A sample that reached the limit is still used when its mean stress is this close to the pressure.
inline constexpr double compression_stress_limit = 0.1;

/// How the stage went.
struct CompressionReport {
  double time = 0;
  long steps = 0;
  double kinetic_per_grain = 0;  ///< at its end, rattlers included
  double pressure = 0;           ///< mean normal stress at its end
  double solid_fraction = 0;
  double z = 0;
  bool equilibrium = false;  ///< reached before the limit
  double cpu_seconds = 0;
};

/// The scene of the stage: gas, isotropic loading, initial.friction. `derived` is that of the scene itself.
/// Throws InputError when the scene has no pressure.
Scene compression_scene(const Scene& scene, const Derived& derived);

}  // namespace galet
