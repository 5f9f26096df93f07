// Scenes with stages for tests: small, and through every kind of change that a stage may bring.
#pragma once

#include "common/scene/scene.hpp"

namespace galet::test {

/// 60 disks: assembled without friction, sheared at their pressure, held, cycled, unloaded; one stage ends at a strain
/// that is reached, one at equilibrium. Long enough for neighbour lists to be made anew in every stage.
inline Scene staged_scene() {
  Scene scene;
  scene.grains.count = 60;
  scene.grains.diameter = {SizeKind::uniform, 1, 0.2, {}, {}};
  scene.material.friction = 0.4;
  scene.material.restitution = 0.2;
  scene.material.stiffness_level = 1e3;
  scene.initial.kind = InitialKind::gas;
  scene.initial.solid_fraction = 0.5;
  scene.loading.pressure = 1;
  scene.cd.dt_factor = 0.02;
  scene.cd.tolerance = 1e-3;
  scene.run.samples = 10;
  const auto stage = [&scene](const char* name, LoadingKind kind, double duration) -> StageSpec& {
    StageSpec& added = scene.stages.emplace_back();
    added.name = name;
    added.duration = duration;
    added.loading.kind = kind;
    return added;
  };
  StageSpec& assembly = stage("assembly", LoadingKind::isotropic, 60);
  assembly.friction = 0;
  assembly.equilibrium = 1e-3;
  assembly.stress_tolerance = 0.1;
  stage("shear", LoadingKind::plane_shear, 3).loading.inertial_number = 0.05;
  StageSpec& squeeze = stage("squeeze", LoadingKind::biaxial, 5);
  squeeze.loading.compression_rate = 0.02;
  squeeze.until = "yy";
  squeeze.until_strain = 0.04;
  stage("creep", LoadingKind::biaxial, 2).loading.hold_axial = true;
  StageSpec& cycles = stage("cycles", LoadingKind::oedometric, 3);
  cycles.loading.compression_rate = 0.02;
  cycles.cycles = 2;
  stage("unloading", LoadingKind::isotropic, 3).loading.pressure_to = 0.5;
  return scene;
}

}  // namespace galet::test
