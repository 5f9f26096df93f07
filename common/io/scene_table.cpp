// The rows of the table. A default is not repeated here: it is read from a default Scene.
#include "common/io/scene_table.hpp"

#include "common/io/scene_fields.hpp"

namespace galet {

using namespace scene_table;

namespace {

void add_top(Rows& rows) {
  rows.push_back({.path = "title",
                  .target = [](Scene& s) -> FieldTarget { return &s.title; },
                  .doc = "one line for tables and figures"});
  rows.push_back({.path = "dimension",
                  .target = [](Scene& s) -> FieldTarget { return &s.dimension; },
                  .symbol = "D",
                  .range = between(2, 3),
                  .doc = "2: disks, 3: spheres"});
  rows.push_back({.path = "seed",
                  .target = [](Scene& s) -> FieldTarget { return &s.seed; },
                  .range = at_least(0),
                  .doc = "of all random numbers: same scene and seed, same bits"});
  rows.push_back({.path = "units",
                  .target = [](Scene& s) -> FieldTarget { return &s.reduced_units; },
                  .choices = {"SI", "reduced"},
                  .doc = "`reduced`: plain numbers in any consistent system; `SI`: plain numbers are in SI and "
                         "values may be strings with a unit"});
  rows.push_back({.path = "engine",
                  .target = [](Scene& s) -> FieldTarget { return &s.engine; },
                  .choices = {"md", "cd"},
                  .doc = "`md`: molecular dynamics with finite stiffness; `cd`: contact dynamics with rigid grains"});
}

void add_grains(Rows& rows) {
  rows.push_back({.path = "grains.count",
                  .target = [](Scene& s) -> FieldTarget { return &s.grains.count; },
                  .symbol = "N",
                  .range = at_least(1),
                  .fallback = "needed, unless grains are listed or read from a file",
                  .doc = "number of grains"});
  rows.push_back({.path = "grains.diameter",
                  .target = [](Scene& s) -> FieldTarget { return &s.grains.diameter.mean; },
                  .symbol = "d",
                  .quantity = Quantity::length,
                  .range = above(0),
                  .doc = "a number: all grains have this diameter; an inline table: a distribution, see "
                         "[grains.diameter]"});
  rows.push_back({.path = "grains.density",
                  .target = [](Scene& s) -> FieldTarget { return &s.grains.density; },
                  .symbol = "rho",
                  .quantity = Quantity::density,
                  .range = above(0),
                  .doc = "mass per volume (2D: per area) of the grains' matter; excludes `mass`"});
  rows.push_back({.path = "grains.mass",
                  .target = [](Scene& s) -> FieldTarget { return &s.grains.mass; },
                  .symbol = "m",
                  .quantity = Quantity::mass,
                  .range = above(0),
                  .fallback = "1 (SI: one of density and mass is needed)",
                  .doc = "mass of a grain of mean diameter; excludes `density`"});
}

void add_diameter(Rows& rows) {
  rows.push_back({.path = "grains.diameter.distribution",
                  .target = [](Scene& s) -> FieldTarget { return &s.grains.diameter.kind; },
                  .choices = {"monodisperse", "uniform", "discrete"},
                  .required = true,
                  .doc = "of the diameters"});
  rows.push_back({.path = "grains.diameter.by",
                  .target = [](Scene& s) -> FieldTarget { return &s.grains.diameter.by_volume; },
                  .choices = {"number", "volume"},
                  .doc = "uniform, discrete: shares are of the number of grains, or of their volume (number ~ volume "
                         "/ diameter^D; d is the mean by number all the same)"});
  rows.push_back({.path = "grains.diameter.mean",
                  .target = [](Scene& s) -> FieldTarget { return &s.grains.diameter.mean; },
                  .quantity = Quantity::length,
                  .range = above(0),
                  .doc = "monodisperse, uniform: the mean diameter d (by volume: the middle of the range)"});
  rows.push_back({.path = "grains.diameter.spread",
                  .target = [](Scene& s) -> FieldTarget { return &s.grains.diameter.spread; },
                  .range = {.low = 0, .high = 1, .high_open = true},
                  .doc = "uniform: diameters lie within mean (1 - spread) and mean (1 + spread)"});
  rows.push_back({.path = "grains.diameter.values",
                  .target = [](Scene& s) -> FieldTarget { return &s.grains.diameter.diameters; },
                  .quantity = Quantity::length,
                  .range = above(0),
                  .doc = "discrete: the diameters"});
  rows.push_back({.path = "grains.diameter.fractions",
                  .target = [](Scene& s) -> FieldTarget { return &s.grains.diameter.fractions; },
                  .range = {.low = 0, .high = 1, .low_open = true},
                  .doc = "discrete: the share of each; their sum is 1"});
}

void add_listed_grains(Rows& rows) {
  rows.push_back({.path = "grain.position",
                  .target = [](Scene& s) -> FieldTarget { return &s.grains.listed.back().position; },
                  .symbol = "x",
                  .quantity = Quantity::length,
                  .required = true,
                  .doc = "of the centre"});
  rows.push_back({.path = "grain.velocity",
                  .target = [](Scene& s) -> FieldTarget { return &s.grains.listed.back().velocity; },
                  .symbol = "v",
                  .quantity = Quantity::velocity,
                  .fallback = "at rest",
                  .doc = "of the centre, with respect to the cell's own motion"});
  rows.push_back({.path = "grain.spin",
                  .target = [](Scene& s) -> FieldTarget { return &s.grains.listed.back().spin; },
                  .symbol = "w",
                  .quantity = Quantity::angular_velocity,
                  .number_too = true,
                  .fallback = "none",
                  .doc = "angular velocity: a number in 2D, three components in 3D; needs friction or rolling "
                         "resistance"});
  rows.push_back({.path = "grain.diameter",
                  .target = [](Scene& s) -> FieldTarget { return &s.grains.listed.back().diameter; },
                  .symbol = "d",
                  .quantity = Quantity::length,
                  .range = above(0),
                  .doc = "of this grain"});
  rows.push_back({.path = "grain.material",
                  .target = [](Scene& s) -> FieldTarget { return &s.grains.listed.back().material; },
                  .fallback = "[material]",
                  .doc = "name of its material"});
  rows.push_back({.path = "grain.body",
                  .target = [](Scene& s) -> FieldTarget { return &s.grains.listed.back().body; },
                  .fallback = "none",
                  .doc = "name of the rigid body that it is glued to"});
}

void add_initial(Rows& rows) {
  rows.push_back(
      {.path = "initial.kind",
       .target = [](Scene& s) -> FieldTarget { return &s.initial.kind; },
       .choices = {"lattice", "gas", "compressed_gas", "packing", "listed", "checkpoint", "dense"},
       .fallback = "`\"listed\"` if there are [[grain]] entries, else `\"gas\"`",
       .doc = "`lattice`: square or cubic, slightly shaken; `gas`: random, no two grains touching; "
              "`compressed_gas`: a gas compressed isotropically to `loading.pressure` before the run; "
              "`packing`: read from a file; `listed`: the [[grain]] entries; `checkpoint`: the state that another "
              "run has left, with its cell, its velocities and what its contacts remember; `dense`: dense and "
              "disordered by geometry alone, no two grains touching. [[body]] entries with a shape, or with [[grain]] "
              "entries of their own, may stand beside `gas` and `dense`, between and around whose bodies grains are "
              "placed"});
  rows.push_back({.path = "initial.solid_fraction",
                  .target = [](Scene& s) -> FieldTarget { return &s.initial.solid_fraction; },
                  .symbol = "Phi",
                  .range = {.low = 0, .high = 1, .low_open = true, .high_open = true},
                  .fallback = "0.5; 0.3 for a gas of spheres",
                  .doc = "lattice, gas, compressed_gas, dense: where the grains are first placed; a gas reaches 0.5 in "
                         "2D and 0.33 in 3D, a lattice of equal grains 0.78 and 0.52, a dense packing 0.83 (with a "
                         "spread of sizes) and 0.62"});
  rows.push_back({.path = "initial.speed",
                  .target = [](Scene& s) -> FieldTarget { return &s.initial.speed; },
                  .quantity = Quantity::velocity,
                  .range = at_least(0),
                  .doc = "root mean square of each velocity component at the start"});
  rows.push_back({.path = "initial.file",
                  .target = [](Scene& s) -> FieldTarget { return &s.initial.file; },
                  .fallback = "packing, checkpoint: needed",
                  .doc = "packing: a table (.csv) or a LAMMPS data file (.data); checkpoint: a checkpoint (.h5); its "
                         "path relative to the scene file"});
  rows.push_back({.path = "initial.contacts",
                  .target = [](Scene& s) -> FieldTarget { return &s.initial.fresh_contacts; },
                  .choices = {"kept", "fresh"},
                  .doc = "checkpoint: `kept`: contacts go on with what they remember (springs, impulses), which needs "
                         "the same engine and kind of laws; `fresh`: only grains and cell are taken over"});
  rows.push_back({.path = "initial.friction",
                  .target = [](Scene& s) -> FieldTarget { return &s.initial.friction; },
                  .range = at_least(0),
                  .fallback = "the material's",
                  .doc = "compressed_gas: friction while compressing; 0 gives the densest packings"});
}

void add_cell(Rows& rows) {
  rows.push_back({.path = "cell.periodic",
                  .target = [](Scene& s) -> FieldTarget { return &s.cell.periodic; },
                  .fallback = "true in each direction",
                  .doc = "per direction"});
  rows.push_back(
      {.path = "cell.size",
       .target = [](Scene& s) -> FieldTarget { return &s.cell.size; },
       .quantity = Quantity::length,
       .range = above(0),
       .fallback = "from count, solid fraction and aspect",
       .doc = "edge lengths; excludes `aspect` and `initial.solid_fraction`; needed with [[grain]] entries if a "
              "direction is periodic"});
  rows.push_back({.path = "cell.aspect",
                  .target = [](Scene& s) -> FieldTarget { return &s.cell.aspect; },
                  .range = above(0),
                  .fallback = "1 in each direction",
                  .doc = "edge lengths in proportion to each other"});
  rows.push_back({.path = "cell.inertia_factor",
                  .target = [](Scene& s) -> FieldTarget { return &s.cell.inertia_factor; },
                  .range = above(0),
                  .doc = "multiplies the inertia of the stress-driven components; results must not depend on it"});
}

void add_engines(Rows& rows) {
  rows.push_back({.path = "md.dt",
                  .target = [](Scene& s) -> FieldTarget { return &s.md.dt; },
                  .quantity = Quantity::time,
                  .range = above(0),
                  .fallback = "from `steps_per_contact`",
                  .doc = "time step"});
  rows.push_back({.path = "md.steps_per_contact",
                  .target = [](Scene& s) -> FieldTarget { return &s.md.steps_per_contact; },
                  .range = above(0),
                  .doc = "time steps in the shortest collision of two grains; excludes `dt`"});
  rows.push_back({.path = "md.allow_unsafe_dt",
                  .target = [](Scene& s) -> FieldTarget { return &s.md.allow_unsafe_dt; },
                  .doc = "run although the time step is above its stability bound"});
  rows.push_back({.path = "md.energy_budget",
                  .target = [](Scene& s) -> FieldTarget { return &s.md.energy_budget; },
                  .doc = "account for the work of drives and planes and for dissipation by channel; adds a quarter "
                         "to two fifths to the cost of a step"});
  rows.push_back({.path = "md.drag",
                  .target = [](Scene& s) -> FieldTarget { return &s.md.drag; },
                  .quantity = Quantity::rate,
                  .range = at_least(0),
                  .doc =
                      "relaxer: a force -drag m v on each grain, and likewise on its rotation. Breaks the balance of "
                      "momentum: only to reach an equilibrium, refused under gravity and imposed motion"});
  rows.push_back({.path = "md.acceleration_damping",
                  .target = [](Scene& s) -> FieldTarget { return &s.md.acceleration_damping; },
                  .range = {.low = 0, .high = 1, .high_open = true},
                  .doc = "relaxer: forces count 1 - this where they speed a grain up, 1 + this where they slow it "
                         "down; refused like `drag`"});
  rows.push_back({.path = "cd.dt",
                  .target = [](Scene& s) -> FieldTarget { return &s.cd.dt; },
                  .quantity = Quantity::time,
                  .range = above(0),
                  .fallback = "from `dt_factor`",
                  .doc = "time step"});
  rows.push_back({.path = "cd.dt_factor",
                  .target = [](Scene& s) -> FieldTarget { return &s.cd.dt_factor; },
                  .range = above(0),
                  .doc = "time step / the shortest of inertial time, 1 / rate, d / speed, sqrt(d / g) and 10 sqrt(D0 m "
                         "/ F0); excludes `dt`"});
  rows.push_back({.path = "cd.tolerance",
                  .target = [](Scene& s) -> FieldTarget { return &s.cd.tolerance; },
                  .range = {.low = 0, .high = 1, .low_open = true, .high_open = true},
                  .doc = "relative error on the contact impulses at which the solver stops"});
  rows.push_back({.path = "cd.max_sweeps",
                  .target = [](Scene& s) -> FieldTarget { return &s.cd.max_sweeps; },
                  .range = at_least(1),
                  .doc = "Gauss-Seidel sweeps per step at most"});
  rows.push_back({.path = "cd.penetration",
                  .target = [](Scene& s) -> FieldTarget { return &s.cd.penetration; },
                  .range = above(0),
                  .doc = "largest penetration that drift may reach, in units of d"});
  rows.push_back({.path = "cd.theta",
                  .target = [](Scene& s) -> FieldTarget { return &s.cd.theta; },
                  .range = between(0.5, 1),
                  .doc = "positions advance with theta v+ + (1 - theta) v-. 1: what ends a step is what contacts saw, "
                         "so that no impact penetrates; 0.5: free flight of second order, but an impact may penetrate "
                         "by (1 - e) u dt / 2"});
  rows.push_back({.path = "cd.compliance",
                  .target = [](Scene& s) -> FieldTarget { return &s.cd.compliance; },
                  .doc = "contacts have the stiffness of the material (normal, tangential, rolling), implicit in the "
                         "step, which may be far above tau_c; false: rigid"});
}

void add_compare(Rows& rows) {
  rows.push_back({.path = "compare.inertial_numbers",
                  .target = [](Scene& s) -> FieldTarget { return &s.compare.inertial_numbers; },
                  .range = above(0),
                  .fallback = "the scene's own",
                  .doc = "values of I; needs `loading.inertial_number`"});
  rows.push_back({.path = "compare.stiffness_levels",
                  .target = [](Scene& s) -> FieldTarget { return &s.compare.stiffness_levels; },
                  .range = above(0),
                  .fallback = "the scene's own",
                  .doc = "md: values of kappa, in place of the material's stiffness; needs `loading.pressure`"});
  rows.push_back({.path = "compare.cd_dt_factors",
                  .target = [](Scene& s) -> FieldTarget { return &s.compare.cd_dt_factors; },
                  .range = above(0),
                  .fallback = "the scene's own",
                  .doc = "cd: values of `cd.dt_factor`, in place of `cd.dt`"});
  rows.push_back({.path = "compare.cd_tolerances",
                  .target = [](Scene& s) -> FieldTarget { return &s.compare.cd_tolerances; },
                  .range = {.low = 0, .high = 1, .low_open = true, .high_open = true},
                  .fallback = "the scene's own",
                  .doc = "cd: values of `cd.tolerance`"});
}

}  // namespace

const std::vector<SceneField>& scene_fields() {
  static const Rows table = [] {
    Rows rows;
    for (const auto add :
         {add_top,    add_grains,  add_diameter, add_listed_grains, add_groups, add_material, add_other_materials,
          add_pairs,  add_initial, add_cell,     add_boundaries,    add_bodies, add_loading,  add_drives,
          add_stages, add_engines, add_run,      add_output,        add_guard,  add_compare})
      add(rows);
    return rows;
  }();
  return table;
}

const std::vector<SceneSection>& scene_sections() {
  static const std::vector<SceneSection> sections = {
      {.name = "", .doc = "Keys before the first table."},
      {.name = "grains", .doc = "The grains: how many, how large, how heavy."},
      {.name = "grains.diameter",
       .doc = "Distribution of the diameters, written as an inline table: "
              "`diameter = {distribution = \"uniform\", mean = 1.0, spread = 0.2}` or "
              "`diameter = {distribution = \"discrete\", values = [1.0, 1.4], fractions = [0.5, 0.5]}`."},
      {.name = "grain",
       .list = true,
       .doc = "A grain placed by hand, one table per grain.",
       .append = [](Scene& s) { s.grains.listed.emplace_back(); }},
      {.name = "group",
       .list = true,
       .doc = "A share of the grains that is of a further material; who belongs to it is drawn from the seed.",
       .append = [](Scene& s) { s.grains.groups.emplace_back(); }},
      {.name = "material",
       .doc = "Contacts of grains with each other and with planes: the material of all that name no other one."},
      {.name = "other_material",
       .list = true,
       .doc = "A further material, one table per material; what it leaves out is as in [material]. Between two "
              "materials: E* and G* from both sides (hertz) or half springs in series (linear), the smaller friction, "
              "rolling and pivoting coefficient, the mean damping ratio, the geometric mean of the cohesion forces.",
       .append = [](Scene& s) { s.other_materials.emplace_back(); }},
      {.name = "material_pair",
       .list = true,
       .doc = "What holds between two materials in place of these rules.",
       .append = [](Scene& s) { s.pairs.emplace_back(); }},
      {.name = "initial", .doc = "The state in which the run starts."},
      {.name = "cell", .doc = "The cell that holds the grains."},
      {.name = "plane",
       .list = true,
       .doc = "A plane boundary, one table per plane; parallel to the periodic directions.",
       .append = [](Scene& s) { s.planes.emplace_back(); }},
      {.name = "cylinder",
       .list = true,
       .doc =
           "A smooth cylinder as a boundary (a circle in 2D), one table per cylinder, with grains inside or outside.",
       .append = [](Scene& s) { s.cylinders.emplace_back(); }},
      {.name = "body",
       .list = true,
       .doc =
           "A rigid body, one table per body: the [[grain]] entries that name it, glued together (a clump, a rough "
           "wall, a rough cylinder), or the grains of its `shape`, whose diameters are drawn as those of the others. "
           "In each direction it moves, and about each axis it turns, as imposed or as "
           "forces make it. Rotations have one component in 2D and three in 3D. Gravity acts on it where it is "
           "free. Its grains don't act on each other, and may overlap.",
       .append = [](Scene& s) { s.bodies.emplace_back(); }},
      {.name = "loading", .doc = "What is imposed on the sample."},
      {.name = "drive",
       .list = true,
       .doc = "One component of the cell's motion, driven in rate or in stress; for `loading.kind = \"drives\"`.",
       .append = [](Scene& s) { s.loading.drives.emplace_back(); }},
      {.name = "stage",
       .list = true,
       .doc = "A stage of the run, one table per stage, in their order: its own loading and end, on the state that the "
              "stage before has left. With stages, [loading] gives only the pressure that kappa, I and stresses refer "
              "to (and gravity), and [run] neither length nor conditions. Each stage leaves a checkpoint.",
       .append = [](Scene& s) { s.stages.emplace_back(); }},
      {.name = "stage.loading", .doc = "What the stage imposes on the sample, as in [loading]."},
      {.name = "stage.drive",
       .list = true,
       .doc = "As [[drive]], for `stage.loading.kind = \"drives\"`.",
       .append = [](Scene& s) { s.stages.back().loading.drives.emplace_back(); }},
      {.name = "md", .doc = "Numerical parameters of the soft engine; a scene for cd may have them too."},
      {.name = "cd", .doc = "Numerical parameters of the rigid engine; a scene for md may have them too."},
      {.name = "run",
       .doc = "How long, and what is averaged. One of `duration` and `strain` is needed, unless there are stages."},
      {.name = "output",
       .doc = "What a run measures and writes beyond the series of every run; nothing else is computed."},
      {.name = "guard",
       .doc = "When a run is stopped because its state is no longer sound. The latest sound state is kept."},
      {.name = "compare", .doc = "What `galet compare` sweeps."}};
  return sections;
}

}  // namespace galet
