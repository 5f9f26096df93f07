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

/// Distribution of the diameters (size_distribution.hpp).
struct SizeDistribution {
  SizeKind kind = SizeKind::monodisperse;
  double mean = 1;                ///< monodisperse, uniform: mean diameter d (by volume: the middle of the range)
  double spread = 0;              ///< uniform on [mean (1 - spread), mean (1 + spread)], 0 <= spread < 1
  std::vector<double> diameters;  ///< discrete: the values
  std::vector<double> fractions;  ///< discrete: the share of each, sum 1
  bool by_volume = false;         ///< uniform, discrete: shares are of the grains' volume, not of their number
};

/// One grain placed by hand ([[grain]] entries).
struct ListedGrain {
  std::vector<double> position;       ///< D components
  std::vector<double> velocity = {};  ///< D components, or empty for rest
  std::vector<double> spin = {};      ///< angular velocity: 1 component in 2D, 3 in 3D, or empty for none
  double diameter = 1;
  std::string material = {};  ///< name; empty: [material]
  std::string body = {};      ///< name of the rigid body that it is glued to; empty: none
};

/// Grains (by number) that are of a further material: [[group]] entries. Who belongs to a group is drawn from the seed.
struct GroupSpec {
  std::string material;
  double fraction = 0;  ///< share of the grains by number, in (0, 1]
};

struct GrainSpec {
  int count = 0;  ///< number of grains; with listed grains or a packing file, taken from them
  SizeDistribution diameter;
  std::optional<double> density;  ///< mass per volume (area in 2D) of the grains' matter
  std::optional<double> mass;     ///< mass of a grain of mean diameter (excludes density); default 1
  std::vector<ListedGrain> listed;
  std::vector<GroupSpec> groups;  ///< drawn grains only
};

enum class NormalLaw {
  linear,  ///< F_N = K_N h
  hertz    ///< F_N = (4/3) E* sqrt(R*) h^(3/2)
};

enum class DampingConvention {
  elastic,  ///< only the elastic parts enter Coulomb's inequality; the total normal force may be attractive
  total     ///< viscous parts are added before; the repulsive part is clipped at 0
};

enum class CohesionLaw {
  constant,    ///< -F0 in contact, -F0 (1 - g / D0) across a gap g < D0
  square_root  ///< -sqrt(4 K_N F0 h) in contact (linear law only)
};

/// The material of every grain and plane that names no other.
struct MaterialSpec {
  std::string name = "default";                      ///< how pairs, groups, grains and planes refer to it
  double friction = 0;                               ///< Coulomb coefficient mu >= 0
  std::optional<double> restitution;                 ///< e in [0, 1] (md: (0, 1])
  std::optional<double> damping_ratio;               ///< zeta >= 0 (excludes restitution)
  double tangential_damping_ratio = 0;               ///< zeta_T >= 0: tangential viscosity / its own critical value
  double tangential_restitution = 0;                 ///< cd: e_T in [0, 1]
  NormalLaw normal_law = NormalLaw::linear;          ///< of all materials
  std::optional<double> stiffness_level;             ///< kappa; needs a pressure (linear: K_N / (P d^(D-2)))
  std::optional<double> normal_stiffness;            ///< linear: K_N > 0 (excludes stiffness_level)
  std::optional<double> young_modulus;               ///< hertz: E > 0 (excludes stiffness_level)
  std::optional<double> poisson_ratio;               ///< hertz: nu in (-1, 1/2]
  std::optional<double> tangential_stiffness_ratio;  ///< K_T / K_N; linear: default 1/2; hertz: from nu
  DampingConvention convention = DampingConvention::elastic;  ///< of all materials
  double rolling_friction = 0;                                ///< mu_R >= 0, a length
  double pivoting_friction = 0;                               ///< 3D: the same for rotation about the normal, a length
  double rolling_stiffness_ratio = 1;                         ///< K_R / (K_N mu_R^2); the same for pivoting
  CohesionLaw cohesion_law = CohesionLaw::constant;           ///< of all materials
  std::optional<double> cohesion_force;                       ///< F0 > 0
  std::optional<double> cohesion_number;                      ///< eta = F0 / (P d^(D-1)) (excludes cohesion_force)
  double cohesion_range = 0;                                  ///< D0 >= 0, constant law; of all materials
};

/// A further material; what it leaves out is as in [material].
struct OtherMaterial {
  std::string name = {};
  std::optional<double> density = {};  ///< of its grains (default: as the other grains)
  std::optional<double> friction = {};
  std::optional<double> restitution = {}, damping_ratio = {}, tangential_restitution = {};
  std::optional<double> stiffness_level = {}, normal_stiffness = {}, young_modulus = {}, poisson_ratio = {};
  std::optional<double> tangential_stiffness_ratio = {};
  std::optional<double> rolling_friction = {}, pivoting_friction = {};
  std::optional<double> cohesion_force = {};
};

/// What holds between two materials in place of the mixing rules (pair_law.hpp).
struct MaterialPair {
  std::vector<std::string> between = {};  ///< two names; may be the same
  std::optional<double> friction = {}, restitution = {}, tangential_restitution = {}, normal_stiffness = {};
  std::optional<double> rolling_friction = {}, pivoting_friction = {}, cohesion_force = {};
};

enum class InitialKind {
  lattice,         ///< square or cubic lattice, slightly shaken
  gas,             ///< random, no two grains touching
  compressed_gas,  ///< a gas compressed isotropically to `pressure` before the run starts
  packing,         ///< positions read from a CSV file or a LAMMPS data file
  listed,          ///< the scene's [[grain]] entries
  checkpoint,      ///< the state that another run of this engine has left in a checkpoint
  dense            ///< disordered and dense by geometry alone, no two grains touching (dense_packing.hpp)
};

struct InitialSpec {
  InitialKind kind = InitialKind::gas;
  double solid_fraction = 0.5;     ///< lattice, gas, compressed_gas: where the grains are first placed
  double speed = 0;                ///< root mean square of each velocity component at the start
  std::string file;                ///< packing, checkpoint: path, relative to the scene file
  std::optional<double> friction;  ///< compressed_gas: friction while compressing (default: the material's)
  bool fresh_contacts = false;     ///< checkpoint: forget what its contacts remember
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
  std::vector<double> velocity = {};  ///< imposed; empty: at rest
  std::string material = {};          ///< name; empty: [material]
  std::optional<double> mass = {};    ///< cd: the plane is free along its normal, with this inertia; other directions
                                      ///< keep their imposed velocity
  double force = 0;                   ///< on a free plane, along its normal: > 0 presses it against the grains
};

enum class Axis { x, y, z };

/// A smooth cylinder as a boundary (a circle in 2D). Grains are inside or outside.
struct CylinderSpec {
  std::vector<double> point;          ///< of its axis
  double radius = 0;                  ///< R_c
  bool outside = false;               ///< grains are around it, not in it
  Axis axis = Axis::z;                ///< direction of the axis, 3D
  std::vector<double> velocity = {};  ///< imposed; empty: at rest
  double spin = 0;                    ///< imposed angular velocity about the axis
  std::string material = {};          ///< name; empty: [material]
};

enum class BodyShape {
  listed,  ///< the [[grain]] entries that name it
  wall,    ///< a row or layer across the cell
  ring,    ///< a circle, or a stack of circles along z
  chain,   ///< a few grains in line
  polygon  ///< a few grains at the corners of a regular polygon
};

/// A rigid body made of the listed grains that name it, or of grains that its shape says: a clump, a rough wall, a
/// rough cylinder. Rotations have 1 component in 2D and 3 in 3D.
struct BodySpec {
  std::string name = {};
  std::vector<double> velocity = {};     ///< of the centre, imposed where the body is not free; empty: at rest
  std::vector<bool> free = {};           ///< per direction: moved by forces; empty: in none
  std::vector<double> force = {};        ///< along its free directions; empty: none
  std::vector<double> spin = {};         ///< angular velocity, imposed where it does not turn freely; empty: none
  std::vector<bool> free_rotation = {};  ///< per axis: turned by torques; empty: about none. 3D: about one, or all
  std::vector<double> torque = {};       ///< about its free axes; empty: none
  std::optional<double> mass = {};       ///< default: its grains'
  std::vector<double> centre = {};       ///< of mass; empty: its grains'
  std::vector<double> inertia = {};      ///< about the centre: I, in 3D xx, yy, zz, xy, xz, yz; empty: its grains'
  BodyShape shape = BodyShape::listed;   ///< wall and ring: body_shapes.hpp makes its grains
  std::optional<double> at = {};         ///< wall: coordinate of its grains' centres along `across`
  Axis across = Axis::y;                 ///< wall: the direction that it stands across
  std::optional<double> radius = {};     ///< ring: of the circle of its grains' centres
  bool outside = false;                  ///< ring: free grains are placed around it, not in it
  double spacing = 1;                    ///< wall, ring: least distance of neighbours, in mean diameters; chain,
                                         ///< polygon: their distance in diameters of its grains, which are equal
  std::string material = {};             ///< of the grains of a shape
  int size = 0;                          ///< chain, polygon: number of grains
  int copies = 1;                        ///< chain, polygon: number of such bodies, placed and turned at random
  std::vector<double> guide = {};        ///< moves freely along this direction only; empty: as `free` says
  int segments = 0;                      ///< ring: > 0: so many bodies, each free along its radius
  std::optional<double> pressure = {};   ///< ring of segments: presses each on the grains
  int segment = 0;                       ///< ring of segments: which one this is, once there is a body for each
};

/// One degree of freedom of the cell, driven in rate or in stress. component: "xx", "xy", ... (L_xx, L_xy) or
/// "isotropic" (one rate for all diagonal components; its stress is the mean normal stress). One of rate, stress and
/// hold is given.
struct CellDrive {
  std::string component = {};
  std::optional<double> rate = {};
  std::optional<double> stress = {};     ///< positive in compression
  std::optional<double> stress_to = {};  ///< the stress goes there, linearly in time, until the end of the stage
  bool hold = false;                     ///< the stress is held at what it is when the stage starts
};

enum class LoadingKind {
  none,         ///< the cell does not move
  plane_shear,  ///< L_xy given; sigma_yy held at `pressure`, or volume held when no pressure is given
  isotropic,    ///< mean stress held at `pressure`
  oedometric,   ///< compressed along its axis, no lateral strain
  biaxial,      ///< 2D: compressed along y, sigma_xx held at `pressure`
  triaxial,     ///< 3D: compressed along z, sigma_xx and sigma_yy held at `pressure`
  drives        ///< the [[drive]] entries
};

/// What is imposed on the sample. The axis of oedometric, biaxial and triaxial loadings is the last direction.
struct LoadingSpec {
  LoadingKind kind = LoadingKind::none;
  std::optional<double> pressure;
  std::optional<double> pressure_to;       ///< the pressure held goes there, linearly in time, until the end
  std::optional<double> shear_rate;        ///< plane_shear
  std::optional<double> inertial_number;   ///< instead of shear_rate or compression_rate; needs a pressure
  bool fixed_volume = false;               ///< plane_shear: `pressure` is only the unit of stress, the volume is held
  std::optional<double> compression_rate;  ///< axial: -L along the axis, > 0 shortens the sample
  std::optional<double> axial_stress;      ///< axial: in place of a rate
  std::optional<double> axial_stress_to;   ///< axial: the stress goes there, linearly in time, until the end
  bool hold_axial = false;                 ///< axial: the stress is held at what it is when the stage starts
  std::optional<double> unit_pressure;     ///< of a stage (stages.hpp): P of kappa and I, where it is not `pressure`
  std::vector<CellDrive> drives;
  std::vector<double> gravity;        ///< acceleration, D components; empty: none
  std::optional<double> inclination;  ///< degrees by which gravity is turned from the last direction towards x
};

enum class EngineKind { md, cd };

struct MdSpec {
  std::optional<double> dt;       ///< default: derived (see derive.hpp)
  double steps_per_contact = 50;  ///< default dt = duration of the stiffest collision / this
  bool allow_unsafe_dt = false;   ///< run although dt is above the stability bound
  bool energy_budget = false;     ///< account for work and dissipation by channel
  // Relaxers: they break the conservation of momentum and serve only to reach an equilibrium sooner.
  double drag = 0;                  ///< -drag m v on each grain (1 / time), likewise on spins
  double acceleration_damping = 0;  ///< c in [0, 1): forces are weighted by 1 - c where they speed a grain up, 1 + c
                                    ///< where they slow it down
};

struct CdSpec {
  std::optional<double> dt;   ///< default: derived
  double dt_factor = 0.01;    ///< default dt = this * min(inertial time, d / typical speed)
  double tolerance = 1e-4;    ///< relative error on the contact impulses (see cd/residual.hpp)
  int max_sweeps = 2000;      ///< Gauss-Seidel sweeps per step at most
  double penetration = 1e-4;  ///< largest penetration that drift may reach, in units of d
  double theta = 1;           ///< in [1/2, 1]: positions advance with theta v+ + (1 - theta) v-
  bool compliance = false;    ///< contacts have the material's stiffness (implicit in the step), not none
};

/// When a run, or a stage of it, is over: at its time or strain at the latest, and sooner at one of the conditions.
struct EndSpec {
  std::optional<double> duration;     ///< time simulated
  std::optional<double> strain;       ///< strain simulated, of the rate that the loading imposes; instead of duration
  std::optional<double> equilibrium;  ///< stop once, for one inertial time, held stresses are within stress_tolerance
                                      ///< and the kinetic energy per grain (rattlers apart) is below this times P d^D
  std::optional<double> unbalanced;   ///< the same with the unbalanced force ratio (measure/balance.hpp) below this
  std::optional<double> stress_tolerance;  ///< of these two: relative error of each held stress; default 0.01
  std::string until;                       ///< stop once this component has reached ...
  std::optional<double> until_stress;      ///< ... this stress (mean over one inertial time), or
  std::optional<double> until_strain;      ///< ... this strain since the start, either way
  int cycles = 0;  ///< > 0: go there and back so often: rates change sign, changing stresses return
};

struct RunSpec : EndSpec {
  double average_from = 0.5;  ///< measures are averaged from this fraction of the run (of its last stage) on
  int samples = 200;          ///< number of measures over the run, or over each stage
};

/// A part of a run with its own loading and end.
struct StageSpec : EndSpec {
  std::string name = {};  ///< default: its number
  LoadingSpec loading = {};
  std::optional<double> friction = {};     ///< of [material] in this stage
  std::optional<double> restitution = {};  ///< likewise
};

/// What a run measures and writes beyond the series of every run. Nothing of it changes the state that is reached.
struct OutputSpec {
  std::vector<std::string> measures;        ///< names of measure_names.hpp
  int profile_layers = 20;                  ///< of the measure "profile"
  Axis profile_direction = Axis::y;         ///< the cell vector across which it goes
  std::vector<double> profile_centre = {};  ///< of rings, in place of layers; empty: layers
  std::vector<double> profile_radii = {};   ///< the innermost and the outermost one of the rings
  int frames = 0;                           ///< states written over the run, besides the first; 0: none
  std::vector<std::string> formats = {};    ///< of frames: "paraview", "xyz", "lammps"; empty: paraview
};

/// When a run is stopped because its state is no longer sound (src/guard.hpp).
struct GuardSpec {
  int every = 500;       ///< steps between checks
  double overlap = 0.5;  ///< largest overlap, in units of the smaller radius of the two
  double speed = 1000;   ///< largest speed, in units of the scene's own speed
  double energy = 1e4;   ///< largest kinetic energy per grain, in units of m (scene's own speed)^2 / 2
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
  std::vector<OtherMaterial> other_materials;
  std::vector<MaterialPair> pairs;
  InitialSpec initial;
  CellSpec cell;
  std::vector<PlaneSpec> planes;
  std::vector<CylinderSpec> cylinders;
  std::vector<BodySpec> bodies;
  LoadingSpec loading;
  MdSpec md;
  CdSpec cd;
  RunSpec run;
  std::vector<StageSpec> stages;  ///< in their order; none: the run is one stage, of `loading` and `run`
  OutputSpec output;
  GuardSpec guard;
  CompareSpec compare;
};

}  // namespace galet
