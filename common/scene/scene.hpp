// A scene: everything that a user says about a run, as plain data, before anything is derived from it.
// Scenes are read from TOML (common/io/scene_file.hpp) or built in code; both engines run the same scene.
// Every quantity is in the scene's own consistent units.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace galet {

enum class SizeKind { monodisperse, uniform, discrete };

/// Distribution of the diameters, by number.
struct SizeDistribution {
  SizeKind kind = SizeKind::monodisperse;
  double mean = 1;                ///< monodisperse, uniform: mean diameter d
  double spread = 0;              ///< uniform on [mean (1 - spread), mean (1 + spread)], 0 <= spread < 1
  std::vector<double> diameters;  ///< discrete: the values
  std::vector<double> fractions;  ///< discrete: the share of each by number, sum 1
};

/// One grain placed by hand ([[grain]] entries).
struct ListedGrain {
  std::vector<double> position;  ///< D components
  std::vector<double> velocity;  ///< D components, or empty for rest
  std::vector<double> spin;      ///< angular velocity: 1 component in 2D, 3 in 3D, or empty for none
  double diameter = 1;
};

struct GrainSpec {
  int count = 0;  ///< number of grains; with listed grains or a packing file, taken from them
  SizeDistribution diameter;
  std::optional<double> density;  ///< mass per volume (area in 2D) of the grains' matter
  std::optional<double> mass;     ///< mass of a grain of mean diameter (excludes density); default 1
  std::vector<ListedGrain> listed;
};

enum class DampingConvention {
  elastic,  ///< only the elastic parts enter Coulomb's inequality; the total normal force may be attractive
  total     ///< viscous parts are added before; the total normal force is clipped at 0
};

struct MaterialSpec {
  double friction = 0;                      ///< Coulomb coefficient mu >= 0
  std::optional<double> restitution;        ///< e in [0, 1] (md: (0, 1])
  std::optional<double> damping_ratio;      ///< zeta >= 0 (excludes restitution)
  std::optional<double> stiffness_level;    ///< kappa = K_N / (P d^(D-2)); needs a pressure
  std::optional<double> normal_stiffness;   ///< K_N > 0 (excludes stiffness_level)
  double tangential_stiffness_ratio = 0.5;  ///< K_T / K_N
  DampingConvention convention = DampingConvention::elastic;
};

enum class InitialKind {
  lattice,         ///< square or cubic lattice, slightly shaken
  gas,             ///< random, no two grains touching
  compressed_gas,  ///< a gas compressed isotropically to `pressure` before the run starts
  packing,         ///< positions read from a CSV file or a LAMMPS data file
  listed           ///< the scene's [[grain]] entries
};

struct InitialSpec {
  InitialKind kind = InitialKind::gas;
  double solid_fraction = 0.5;     ///< lattice, gas, compressed_gas: where the grains are first placed
  double speed = 0;                ///< root mean square of each velocity component at the start
  std::string file;                ///< packing: path, relative to the scene file
  std::optional<double> friction;  ///< compressed_gas: friction while compressing (default: the material's)
};

struct CellSpec {
  std::vector<bool> periodic;  ///< per direction; default all true
  std::vector<double> size;    ///< edge lengths; default: from count, solid fraction and aspect
  std::vector<double> aspect;  ///< edge lengths in proportion to each other; default all 1
  double inertia_factor = 1;   ///< multiplies the default inertia of the stress-driven components
};

/// A plane boundary. Grains stay on the side its normal points to.
struct PlaneSpec {
  std::vector<double> point;
  std::vector<double> normal;
  std::vector<double> velocity;  ///< imposed; empty: at rest
};

/// One degree of freedom of the cell, driven in rate or in stress. component: "xx", "xy", ... (L_xx, L_xy) or
/// "isotropic" (one rate for all diagonal components; its stress is the mean normal stress).
struct CellDrive {
  std::string component;
  std::optional<double> rate;
  std::optional<double> stress;  ///< positive in compression
};

enum class LoadingKind {
  none,         ///< the cell does not move
  plane_shear,  ///< L_xy given; sigma_yy held at `pressure`, or volume held when no pressure is given
  isotropic,    ///< mean stress held at `pressure`
  drives        ///< the [[drive]] entries
};

struct LoadingSpec {
  LoadingKind kind = LoadingKind::none;
  std::optional<double> pressure;
  std::optional<double> shear_rate;       ///< plane_shear
  std::optional<double> inertial_number;  ///< plane_shear, instead of shear_rate; needs a pressure
  std::vector<CellDrive> drives;
  std::vector<double> gravity;  ///< acceleration, D components; empty: none
};

enum class EngineKind { md, cd };

struct MdSpec {
  std::optional<double> dt;       ///< default: derived (see derive.hpp)
  double steps_per_contact = 50;  ///< default dt = duration of the stiffest collision / this
  bool allow_unsafe_dt = false;   ///< run although dt is above the stability bound
};

struct CdSpec {
  std::optional<double> dt;   ///< default: derived
  double dt_factor = 0.01;    ///< default dt = this * min(inertial time, d / typical speed)
  double tolerance = 1e-4;    ///< relative error on the contact impulses (see cd/residual.hpp)
  int max_sweeps = 2000;      ///< Gauss-Seidel sweeps per step at most
  double penetration = 1e-4;  ///< largest penetration that drift may reach, in units of d
};

struct RunSpec {
  std::optional<double> duration;     ///< time simulated
  std::optional<double> strain;       ///< shear strain simulated (plane_shear), instead of duration
  double average_from = 0.5;          ///< measures are averaged from this fraction of the run on
  int samples = 200;                  ///< number of measures over the run
  std::optional<double> equilibrium;  ///< isotropic: stop once, for one inertial time, stress is within 1 % and the
                                      ///< kinetic energy per grain (rattlers apart) is below this times P d^D
};

/// What `galet compare` sweeps. Empty lists take the scene's own single value.
struct CompareSpec {
  std::vector<double> inertial_numbers;
  std::vector<double> stiffness_levels;
  std::vector<double> cd_dt_factors;
  std::vector<double> cd_tolerances;
};

struct Scene {
  std::string title;
  std::string source;     ///< text of the file it was read from (echoed into checkpoints), or empty
  std::string directory;  ///< folder of that file: where relative paths start
  int dimension = 2;
  std::uint64_t seed = 1;
  bool reduced_units = true;  ///< false: SI, values may carry unit strings
  EngineKind engine = EngineKind::md;
  GrainSpec grains;
  MaterialSpec material;
  InitialSpec initial;
  CellSpec cell;
  std::vector<PlaneSpec> planes;
  LoadingSpec loading;
  MdSpec md;
  CdSpec cd;
  RunSpec run;
  CompareSpec compare;
};

}  // namespace galet
