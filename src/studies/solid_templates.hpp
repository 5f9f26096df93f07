// Scenes of the studies of solid packings: glass-like spheres (Hertz and Mindlin, nu = 0.3) assembled from a gas under
// an isotropic pressure P = 1, as TOML text. States of Agnolin and Roux (2007): A, assembled without friction; C, A
// dilated slightly and compressed again with friction, as dense as A with fewer contacts; D, assembled with friction.
#pragma once

#include <string>
#include <vector>

#include "common/scene/scene.hpp"

namespace galet {

struct SolidScene {
  std::string title;
  EngineKind engine = EngineKind::md;
  int grains = 4000;
  int seed = 1;
  double friction = 0.3;
  double stiffness_level = 39000;  ///< at P = 1; ignored by rigid grains
  double equilibrium = 1e-7;       ///< kinetic energy per grain of the assembled states, units of P d^3
  double restitution = 0.2;
  std::string material;  ///< further lines of [material]
  int samples = 150;     ///< rows of each stage
};

/// Head and the stages that assemble the state 'A', 'C' or 'D'; the last of them is called by that letter.
std::string assembly_scene(const SolidScene& scene, char state);

/// Further stages: isotropic compression to each of the stiffness levels, which must fall (P grows as kappa^(-3/2));
/// the stage that ends at rest is called "kappa 2000".
std::string compression_stages(const SolidScene& scene, const std::vector<double>& levels);

/// A further stage called "triaxial": axial strain at the rate of the inertial number, lateral stresses held.
std::string triaxial_stage(double strain, double inertial_number);

}  // namespace galet
