// Scenes of the studies, as TOML text: what a run did can be read, run again and changed without this program's code.
#pragma once

#include <string>
#include <vector>

#include "src/studies/study.hpp"

namespace galet {

/// Steady shear at constant pressure of the chapter's reference material (sec. cishom): disks of diameters uniform in
/// [0.8, 1.2] d (spheres of one size in 3D), K_T = K_N / 2, periodic cell, start from a gas that the pressure
/// compresses.
struct ShearScene {
  std::string title;
  EngineKind engine = EngineKind::md;
  int dimension = 2;
  int grains = 1000;
  double friction = 0.4;
  double restitution = 0.1;
  double stiffness_level = 1e4;  ///< ignored by rigid grains
  double inertial_number = 0.1;
  double strain = 12;        ///< of the whole run
  double settling = 2;       ///< strain before averages are taken, at least (settled_strain)
  std::string material;      ///< further lines of [material]
  double slow_start = 0;     ///< > 0: a stage before of so much time, in which the pressure rises from a twentieth
  double dense_strain = 0;   ///< > 0: a dense start; a stage before shears frictionless grains by so much
  double volume_strain = 0;  ///< > 0: a last stage of this strain at held volume, in which averages are taken
  bool compliance = false;   ///< cd: contacts have the material's stiffness
  double cd_dt_factor = 0;   ///< > 0: in place of the default
  int contact_steps = 0;     ///< of md; 0: the default
};
std::string shear_scene(const ShearScene& scene);
/// The strain after which the start is forgotten: `settling`, and the time in which the pressure of the gas that is
/// compressed comes to rest. It swings to and fro across the cell for 1.6 sqrt(m / P) per diameter of the cell's edge
/// (2000 disks: 70).
double settled_strain(const ShearScene& scene);

/// A row of homogeneous shear beside what a study called `study` is about: parameter I, title from engine and I.
StudyRun shear_row(const std::string& study, ShearScene scene);
/// The rows of one engine that have the parameter I.
std::vector<const StudyRow*> shear_rows(const std::vector<StudyRow>& rows, EngineKind engine);

/// "0.1", "1e-3", "2.5e5": for names and titles.
std::string plain_number(double value);

}  // namespace galet
