// Mistakes between the fields of a scene: every rule of common/scene/check.cpp, and those of the reader on which
// fields are written.
#include <gtest/gtest.h>

#include "common/scene/check.hpp"
#include "tests/unit/scene_mistakes.hpp"

namespace galet::test::scene_rules_test {
namespace {

/// Scenes of [[grain]] entries: the text that follows starts in line 4 (spheres: 5).
const std::string listed = R"(material = {friction = 0.5, restitution = 0.5, normal_stiffness = 1e4}
run.duration = 1
cell.size = [5, 5]
)";
const std::string spheres = R"(dimension = 3
material = {friction = 0.5, restitution = 0.5, normal_stiffness = 1e4}
run.duration = 1
cell.size = [5, 5, 5]
)";
const std::string frictionless = R"(material = {restitution = 0.5, normal_stiffness = 1e4}
run.duration = 1
cell.size = [5, 5]
)";
const std::string unbounded = R"(material = {friction = 0.5, restitution = 0.5, normal_stiffness = 1e4}
run.duration = 1
)";

class SceneRules : public testing::TestWithParam<BadScene> {};

TEST_P(SceneRules, FindTheBrokenOne) { EXPECT_EQ(mistakes_of(GetParam().text), GetParam().expected); }

std::vector<BadScene> bad_grains() {
  return {{"count_missing",
           R"([grains]
diameter = 1
[material]
restitution = 0.5
normal_stiffness = 1e4
[run]
duration = 1
)",
           {"1:1: grains.count is needed: the number of grains"}},
          {"density_and_mass",
           sound + R"(grains.density = 1
grains.mass = 1
)",
           {"6:15: grains.density and grains.mass exclude each other"}},
          {"distribution_missing",
           sound + R"(grains.diameter = {mean = 1, spread = 0.2}
)",
           {R"(5:19: grains.diameter.distribution is needed: "monodisperse", "uniform" or "discrete")"}},
          {"spread_of_equal_grains",
           sound + R"(grains.diameter = {distribution = "monodisperse", spread = 0.2}
)",
           {R"(5:60: grains.diameter.spread needs distribution = "uniform")"}},
          {"values_of_uniform",
           sound + R"(grains.diameter = {distribution = "uniform", values = [1], fractions = [1]}
)",
           {R"(5:55: grains.diameter.values needs distribution = "discrete")",
            R"(5:72: grains.diameter.fractions needs distribution = "discrete")"}},
          {"fractions_sum",
           sound + R"(grains.diameter = {distribution = "discrete", values = [1, 1.4], fractions = [0.5, 0.4]}
)",
           {"5:78: grains.diameter.fractions: their sum must be 1, it is 0.9"}},
          {"fractions_missing",
           sound + R"(grains.diameter = {distribution = "discrete", values = [1, 1.4]}
)",
           {"5:19: grains.diameter.fractions: one per value needed: 2 values, 0 fractions"}},
          {"values_missing",
           sound + R"(grains.diameter = {distribution = "discrete", fractions = [1]}
)",
           {R"(5:19: grains.diameter.values is needed with distribution = "discrete")"}},
          {"mean_of_discrete",
           sound + R"(grains.diameter = {distribution = "discrete", mean = 1, values = [1], fractions = [1]}
)",
           {R"(5:54: grains.diameter.mean has no effect with distribution = "discrete")"}},
          {"listed_without_grains",
           sound + R"(initial.kind = "listed"
cell.size = [5, 5]
)",
           {R"(5:16: initial.kind = "listed" needs [[grain]] entries)"}},
          {"grains_of_another_kind",
           sound + R"(initial.kind = "gas"
[[grain]]
position = [1, 1]
)",
           {R"(5:16: [[grain]] entries need initial.kind = "listed": other kinds make their own grains)"}},
          {"count_disagrees",
           sound + R"(cell.size = [5, 5]
[[grain]]
position = [1, 1]
)",
           {"1:16: grains.count is 10, but the number of [[grain]] entries is 1: leave it out"}},
          {"grain_without_position",
           listed + R"([[grain]]
velocity = [1, 1]
)",
           {"4:1: grain[0].position is needed: an array of lengths"}},
          {"wrong_components",
           listed + R"([[grain]]
position = [1, 1, 1]
velocity = [1]
spin = [0, 0, 1]
)",
           {"5:12: grain[0].position: 2D needs 2 components, got 3",
            "6:12: grain[0].velocity: 2D needs 2 components, got 1",
            "7:8: grain[0].spin: 2D needs a number, got 3 components"}},
          {"spin_in_3d",
           spheres + R"([[grain]]
position = [1, 1, 1]
spin = 2
)",
           {"7:8: grain[0].spin: 3D needs 3 components, got 1 component"}},
          {"spin_without_friction",
           frictionless + R"([[grain]]
position = [1, 1]
spin = 2
)",
           {"6:8: grain[0].spin needs material.friction > 0: rotations of frictionless grains are not computed"}},
          {"cell_size_missing",
           unbounded + R"([[grain]]
position = [1, 1]
)",
           {"1:1: cell.size is needed with [[grain]] entries where a direction is periodic"}},
          {"idle_fields_with_listed_grains",
           listed + R"(grains.diameter = 1
initial.solid_fraction = 0.3
[[grain]]
position = [1, 1]
)",
           {"4:19: grains.diameter has no effect on listed grains and packings, which have their own",
            "5:26: initial.solid_fraction has no effect on listed grains and packings"}},
          {"speed_and_aspect_with_listed_grains",
           unbounded + R"(cell.periodic = [false, false]
cell.aspect = [1, 2]
initial.speed = 1
[[grain]]
position = [1, 1]
)",
           {"4:15: cell.aspect has no effect on listed grains and packings",
            "5:17: initial.speed has no effect on listed grains: give each [[grain]] its velocity"}}};
}

std::vector<BadScene> bad_samples() {
  return {
      {"damping_missing",
       R"([grains]
count = 10
[material]
normal_stiffness = 1e4
[run]
duration = 1
)",
       {"3:1: material.restitution or material.damping_ratio is needed"}},
      {"restitution_and_damping",
       sound + R"(material.damping_ratio = 0.5
)",
       {"5:26: material.restitution and material.damping_ratio exclude each other"}},
      {"restitution_zero_for_md",
       R"(grains.count = 10
material.restitution = 0
material.normal_stiffness = 1e4
run.duration = 1
)",
       {"2:24: material.restitution: md needs a restitution > 0 (give a damping_ratio for stronger damping)"}},
      {"stiffness_missing_for_md",
       R"(grains.count = 10
material.restitution = 0.5
run.duration = 1
)",
       {"2:1: material.stiffness_level or material.normal_stiffness is needed by engine md"}},
      {"both_stiffnesses",
       sound + R"(material.stiffness_level = 1e4
loading.pressure = 1
)",
       {"3:29: material.stiffness_level and material.normal_stiffness exclude each other"}},
      {"stiffness_level_without_pressure",
       R"(grains.count = 10
material.restitution = 0.5
material.stiffness_level = 1e4
run.duration = 1
)",
       {"3:28: material.stiffness_level needs loading.pressure: it is K_N / (P d^(D-2))"}},
      {"gas_too_dense",
       sound + R"(initial.solid_fraction = 0.55
)",
       {"5:26: initial.solid_fraction is 0.55: random insertion of grains in 2D reaches 0.5"}},
      {"gas_of_spheres_too_dense",
       sound + R"(dimension = 3
initial.solid_fraction = 0.4
)",
       {"6:26: initial.solid_fraction is 0.4: random insertion of grains in 3D reaches 0.33"}},
      {"lattice_too_dense",
       sound + R"(initial.kind = "lattice"
initial.solid_fraction = 0.8
)",
       {"6:26: initial.solid_fraction is 0.8: a lattice of these grains in 2D reaches 0.78"}},
      {"lattice_of_unequal_grains_too_dense",
       sound + R"(initial.kind = "lattice"
initial.solid_fraction = 0.6
grains.diameter = {distribution = "uniform", spread = 0.2}
)",
       {"6:26: initial.solid_fraction is 0.6: a lattice of these grains in 2D reaches 0.5489"}},
      {"cell_too_small_for_a_gas",
       sound + R"(cell.size = [3, 3]
)",
       {"5:13: cell.size: 10 grains make a solid fraction of 0.8727; random insertion of grains in 2D reaches 0.5"}},
      {"packing_without_file",
       R"(material.restitution = 0.5
material.normal_stiffness = 1e4
run.duration = 1
initial.kind = "packing"
)",
       {R"(4:1: initial.file is needed with kind = "packing")"}},
      {"packing_of_unknown_format",
       R"(material.restitution = 0.5
material.normal_stiffness = 1e4
run.duration = 1
initial.kind = "packing"
initial.file = "a.xyz"
)",
       {R"(5:16: initial.file: expected a name that ends in .csv (a table) or .data (LAMMPS), got "a.xyz")"}},
      {"count_with_packing",
       sound + R"(initial.kind = "packing"
initial.file = "a.csv"
)",
       {"1:16: grains.count follows from the packing file: leave it out"}},
      {"file_without_packing",
       sound + R"(initial.file = "a.csv"
)",
       {R"(5:16: initial.file needs initial.kind = "packing" or "checkpoint")"}},
      {"compressed_gas_without_pressure",
       sound + R"(initial.kind = "compressed_gas"
)",
       {R"(5:16: initial.kind = "compressed_gas" needs loading.pressure)"}},
      {"compressed_gas_between_walls",
       sound + R"(initial.kind = "compressed_gas"
loading.pressure = 1
cell.periodic = [true, false]
)",
       {R"(5:16: initial.kind = "compressed_gas" needs a cell periodic in each direction)"}},
      {"friction_of_a_plain_gas",
       sound + R"(initial.friction = 0
)",
       {R"(5:20: initial.friction needs initial.kind = "compressed_gas")"}},
      {"cell_components",
       sound + R"(cell.periodic = [true]
cell.aspect = [1, 1, 1]
)",
       {"5:17: cell.periodic: 2D needs 2 components, got 1", "6:15: cell.aspect: 2D needs 2 components, got 3"}},
      {"size_components",
       sound + R"(cell.size = [9, 9, 9]
)",
       {"5:13: cell.size: 2D needs 2 components, got 3"}},
      {"size_and_aspect",
       sound + R"(cell.size = [9, 9]
cell.aspect = [1, 1]
)",
       {"6:15: cell.size and cell.aspect exclude each other"}},
      {"size_and_solid_fraction",
       sound + R"(cell.size = [9, 9]
initial.solid_fraction = 0.1
)",
       {"6:26: cell.size and initial.solid_fraction exclude each other"}},
      {"cell_narrower_than_a_grain",
       sound + R"(cell.size = [0.9, 90]
)",
       {"5:13: cell.size: 0.9 in the periodic direction x is less than the largest diameter, 1"}},
      {"plane_components",
       sound + R"(cell.periodic = [true, false]
[[plane]]
point = [0]
normal = [0, 1, 0]
velocity = [1]
)",
       {"7:9: plane[0].point: 2D needs 2 components, got 1", "8:10: plane[0].normal: 2D needs 2 components, got 3",
        "9:12: plane[0].velocity: 2D needs 2 components, got 1"}},
      {"plane_normal_zero",
       sound + R"(cell.periodic = [true, false]
[[plane]]
point = [0, 0]
normal = [0, 0]
)",
       {"8:10: plane[0].normal is zero: it must point to the grains' side"}},
      {"plane_across_periodic_direction",
       sound + R"([[plane]]
point = [0, 0]
normal = [0, 1]
)",
       {"7:10: plane[0].normal: the plane crosses the periodic direction y; set cell.periodic to false there"}},
      {"plane_incomplete",
       sound + R"([[plane]]
velocity = [0, 0]
)",
       {"5:1: plane[0].point is needed: an array of lengths", "5:1: plane[0].normal is needed: an array of numbers"}}};
}

std::vector<BadScene> bad_loadings() {
  return {
      {"shear_without_rate",
       sound + R"(loading.kind = "plane_shear"
)",
       {R"(5:1: loading.shear_rate or loading.inertial_number is needed with kind = "plane_shear")"}},
      {"shear_with_two_rates",
       sound + R"(loading.kind = "plane_shear"
loading.pressure = 1
loading.inertial_number = 0.1
loading.shear_rate = 0.1
)",
       {"7:27: loading.shear_rate and loading.inertial_number exclude each other"}},
      {"inertial_number_without_pressure",
       sound + R"(loading.kind = "plane_shear"
loading.inertial_number = 0.1
)",
       {"6:27: loading.inertial_number needs loading.pressure: it is the shear rate times sqrt(m / (P d^(D-2)))"}},
      {"rate_without_shear",
       sound + R"(loading.shear_rate = 0.1
)",
       {R"(5:22: loading.shear_rate needs loading.kind = "plane_shear")"}},
      {"inertial_number_without_shear",
       sound + R"(loading.inertial_number = 0.1
)",
       {R"(5:27: loading.inertial_number needs loading.kind = "plane_shear", "oedometric", "biaxial" or "triaxial")"}},
      {"isotropic_without_pressure",
       sound + R"(loading.kind = "isotropic"
)",
       {R"(5:1: loading.pressure is needed with kind = "isotropic")"}},
      {"shear_between_walls",
       sound + R"(loading.kind = "plane_shear"
loading.shear_rate = 1
cell.periodic = [true, false]
)",
       {"7:17: cell.periodic: this loading.kind moves the cell, which must be periodic in each direction"}},
      {"gravity_in_periodic_direction",
       sound + R"(cell.periodic = [false, true]
loading.gravity = [0, -9.81]
)",
       {"6:19: loading.gravity: y is a periodic direction, in which grains would fall forever; set cell.periodic to "
        "false there"}},
      {"gravity_components",
       sound + R"(loading.gravity = [0, 0, -9.81]
)",
       {"5:19: loading.gravity: 2D needs 2 components, got 3"}},
      {"drives_without_entries",
       sound + R"(loading.kind = "drives"
)",
       {R"(5:16: loading.kind = "drives" needs [[drive]] entries)"}},
      {"entries_without_drives",
       sound + R"([[drive]]
component = "xx"
rate = 0.1
)",
       {R"(5:1: [[drive]] entries need loading.kind = "drives")"}},
      {"component_of_3d",
       sound + R"(loading.kind = "drives"
[[drive]]
component = "zz"
rate = 0.1
)",
       {R"(7:13: drive[0].component: expected "xx", "xy", "yx", "yy" or "isotropic", got "zz")"}},
      {"misspelt_component",
       sound + R"(loading.kind = "drives"
[[drive]]
component = "isotrope"
rate = 0.1
)",
       {R"(7:13: drive[0].component: expected "xx", "xy", "yx", "yy" or "isotropic", got )"
        R"("isotrope"; did you mean "isotropic"?)"}},
      {"component_twice",
       sound + R"(loading.kind = "drives"
[[drive]]
component = "xy"
rate = 0.1
[[drive]]
component = "xy"
rate = 0.2
)",
       {R"(10:13: drive[1].component: "xy" is driven twice)"}},
      {"isotropic_and_diagonal",
       sound + R"(loading.kind = "drives"
[[drive]]
component = "isotropic"
stress = 1
[[drive]]
component = "yy"
rate = 0.2
)",
       {R"(10:13: drive[1].component: "yy" and "isotropic" drive the same rate)"}},
      {"drive_rate_and_stress",
       sound + R"(loading.kind = "drives"
[[drive]]
component = "xx"
rate = 0.1
stress = 1
[[drive]]
component = "yy"
)",
       {"9:10: drive[0].rate and drive[0].stress exclude each other", "10:1: drive[1]: rate or stress is needed"}},
      {"no_duration",
       R"(grains.count = 10
material.restitution = 0.5
material.normal_stiffness = 1e4
)",
       {"1:1: run.duration or run.strain is needed"}},
      {"duration_and_strain",
       sound + R"(run.strain = 1
loading.kind = "plane_shear"
loading.shear_rate = 1
)",
       {"5:14: run.duration and run.strain exclude each other"}},
      {"strain_without_shear",
       R"(grains.count = 10
material.restitution = 0.5
material.normal_stiffness = 1e4
run.strain = 1
)",
       {"4:14: run.strain needs a loading that imposes a rate"}},
      {"equilibrium_of_shear",
       sound + R"(run.equilibrium = 1e-6
loading.kind = "plane_shear"
loading.shear_rate = 1
)",
       {"5:19: run.equilibrium needs a loading that imposes no rate: with one nothing comes to rest",
        "5:19: run.equilibrium needs loading.pressure: stresses and energies are compared with it"}},
      {"unknown_measure",
       sound + R"(output.measures = ["fabrc", 3]
)",
       {R"(5:20: output.measures: expected "fabric", "friction", "temperature", "balance", "forces", "gaps", "directions", "profile", "voronoi", "indeterminacy" or "moduli", got "fabrc"; did you mean "fabric"?)",
        R"(5:29: output.measures: expected "fabric", "friction", "temperature", "balance", "forces", "gaps", "directions", "profile", "voronoi", "indeterminacy" or "moduli", got 3)"}},
      {"measures_no_array",
       sound + R"(output.formats = "xyz"
)",
       {R"(5:18: output.formats: expected an array of "paraview", "hdf5", "xyz" or "lammps", got "xyz")"}},
      {"measures_repeated",
       sound + R"(output.measures = ["gaps", "gaps"]
)",
       {R"(5:19: output.measures: "gaps" is there twice)"}},
      {"measures_without_what_they_need",
       R"(grains.count = 10
material.restitution = 0.5
engine = "cd"
cell.periodic = [true, false]
run.duration = 1
output.measures = ["friction", "voronoi", "moduli"]
)",
       {R"(6:19: output.measures: "friction" needs a material with friction)",
        R"(6:19: output.measures: "voronoi" needs a cell that is periodic in each direction, or in none)",
        R"(6:19: output.measures: "moduli" needs a cell periodic in each direction)",
        R"(6:19: output.measures: "moduli" needs the stiffness of [material], with cd too)"}},
      {"profile_not_asked_for",
       sound + R"(output.profile_layers = 5
output.profile_direction = "z"
)",
       {R"(5:25: output.profile_layers needs "profile" in output.measures)",
        R"(6:28: output.profile_direction needs "profile" in output.measures)",
        R"(6:28: output.profile_direction: "z" needs dimension = 3)"}},
      {"formats_without_frames",
       sound + R"(output.formats = ["xyz"]
)",
       {"5:18: output.formats needs output.frames"}},
      {"sweeps_without_their_parameter",
       sound + R"(compare.inertial_numbers = [0.1]
compare.stiffness_levels = [1e3]
)",
       {"5:28: compare.inertial_numbers needs loading.inertial_number",
        "6:28: compare.stiffness_levels needs loading.pressure"}},
      {"sweep_repeats",
       sound + R"(compare.cd_tolerances = [1e-3, 1e-4, 1e-3]
)",
       {"5:25: compare.cd_tolerances: 0.001 is there twice"}},
      {"dt_and_what_it_follows_from",
       sound + R"(md.dt = 1e-3
md.steps_per_contact = 50
cd.dt = 1e-3
cd.dt_factor = 0.01
)",
       {"6:24: md.dt and md.steps_per_contact exclude each other", "8:16: cd.dt and cd.dt_factor exclude each other"}}};
}

const auto name_of = [](const auto& bad) { return bad.param.name; };
INSTANTIATE_TEST_SUITE_P(Grains, SceneRules, testing::ValuesIn(bad_grains()), name_of);
INSTANTIATE_TEST_SUITE_P(Samples, SceneRules, testing::ValuesIn(bad_samples()), name_of);
INSTANTIATE_TEST_SUITE_P(Loadings, SceneRules, testing::ValuesIn(bad_loadings()), name_of);

}  // namespace
}  // namespace galet::test::scene_rules_test
