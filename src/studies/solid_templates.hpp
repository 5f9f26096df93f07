// Scenes of the studies of solid packings: glass-like spheres (Hertz and Mindlin, nu = 0.3) assembled from a gas under
// an isotropic pressure P = 1, as TOML text. States of Agnolin and Roux (2007): A, assembled without friction; C, A
// dilated slightly and compressed again with friction, as dense as A with fewer contacts; D, assembled with friction.
#pragma once

#include <string>
#include <vector>

#include "common/scene/scene.hpp"
#include "src/studies/scene_head.hpp"

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
  std::string material;               ///< further lines of [material]
  bool compliance = false;            ///< cd: contacts have the material's stiffness
  double tolerance = 1e-4;            ///< of cd's contact solver
  int samples = 150;                  ///< rows of each stage
  int contact_steps = sparing_steps;  ///< of md; 0: the default
};

/// Head and the stages that assemble the state 'A', 'C' or 'D'; the last of them is called by that letter.
std::string assembly_scene(const SolidScene& scene, char state);

/// Two stages: a gas at rest is compressed at the rate of an inertial number until the pressure is P, "approach"; P
/// holds it until the kinetic energy per grain is below `equilibrium` P d^D, "rest".
std::string approach_stages(double inertial_number, double equilibrium);

/// Head and these stages.
std::string approach_scene(const SolidScene& scene, double inertial_number);

/// Further stages: isotropic compression to each of the stiffness levels, which must fall (P grows as kappa^(-3/2)),
/// and back to P = 1; stages that end at rest are called "kappa 2000" and "back".
std::string compression_stages(const SolidScene& scene, const std::vector<double>& levels);

/// Further stages: the axial stress goes to that of a stiffness level without lateral strain, and back to P = 1;
/// stages that end at rest are called "loaded" and "unloaded".
std::string oedometric_stages(const SolidScene& scene, double level);

/// A further stage called "triaxial": axial strain at the rate of the inertial number, lateral stresses held; `more` is
/// for further lines of the stage.
std::string triaxial_stage(double strain, double inertial_number, const std::string& more = "");

/// A further stage called "triaxial": the axial stress goes from P to P + `deviator` in a time, lateral stresses held.
/// A strain of 0.02 ends it before.
std::string ramp_stage(double deviator, double duration);

/// A further stage called "creep": the axial stress is held where it is, until rest.
std::string creep_stage(double equilibrium);

}  // namespace galet
