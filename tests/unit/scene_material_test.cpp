// Materials of a scene: what a file may say, what it may not, and which grains and contacts get what.
#include <algorithm>

#include <gtest/gtest.h>

#include "common/core/error.hpp"
#include "common/io/lammps.hpp"
#include "common/io/packing_csv.hpp"
#include "common/io/scene_file.hpp"
#include "common/scene/derive.hpp"
#include "common/scene/packing.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/unit/scene_mistakes.hpp"

namespace galet::test::scene_material_test {
namespace {

TEST(SceneMaterial, ReadsEveryField) {
  const Scene scene = parse_scene(R"(dimension = 3
units = "SI"
grains = {count = 10, diameter = "1 mm", density = "2500 kg/m3"}
run.duration = 1
loading.pressure = "10 kPa"
cell.periodic = [false, false, false]

[material]
name = "glass"
friction = 0.3
restitution = 0.9
tangential_damping_ratio = 0.1
normal_law = "hertz"
young_modulus = "70 GPa"
poisson_ratio = 0.3
viscous_convention = "total"
rolling_friction = "10 um"
pivoting_friction = "5 um"
rolling_stiffness_ratio = 0.25
cohesion_law = "constant"
cohesion_force = "2 mN"
cohesion_range = "3 um"

[[other_material]]
name = "steel"
density = "7.8 g/cm3"
friction = 0.1
restitution = 0.6
young_modulus = "210 GPa"
poisson_ratio = 0.28
rolling_friction = "0 m"
pivoting_friction = "1 um"
cohesion_force = 0

[[material_pair]]
between = ["glass", "steel"]
friction = 0.2
restitution = 0.7
rolling_friction = "2 um"
pivoting_friction = "3 um"
cohesion_force = "1 uN"

[[group]]
material = "steel"
fraction = 0.25

[[plane]]
point = [0, 0, 0]
normal = [0, 0, 1]
material = "steel"

[md]
energy_budget = true
drag = "2 1/s"
acceleration_damping = 0.3
)",
                                  "test.toml");
  const MaterialSpec& glass = scene.material;
  EXPECT_EQ(glass.name, "glass");
  EXPECT_EQ(glass.tangential_damping_ratio, 0.1);
  EXPECT_EQ(glass.normal_law, NormalLaw::hertz);
  EXPECT_EQ(glass.young_modulus, 70e9);
  EXPECT_EQ(glass.poisson_ratio, 0.3);
  EXPECT_EQ(glass.convention, DampingConvention::total);
  EXPECT_EQ(glass.rolling_friction, 10e-6);
  EXPECT_EQ(glass.pivoting_friction, 5e-6);
  EXPECT_EQ(glass.rolling_stiffness_ratio, 0.25);
  EXPECT_EQ(glass.cohesion_law, CohesionLaw::constant);
  EXPECT_EQ(glass.cohesion_force, 2e-3);
  EXPECT_EQ(glass.cohesion_range, 3e-6);
  ASSERT_EQ(scene.other_materials.size(), 1u);
  const OtherMaterial& steel = scene.other_materials[0];
  EXPECT_EQ(steel.name, "steel");
  EXPECT_EQ(steel.density, 7800);
  EXPECT_EQ(steel.friction, 0.1);
  EXPECT_EQ(steel.restitution, 0.6);
  EXPECT_EQ(steel.young_modulus, 210e9);
  EXPECT_EQ(steel.poisson_ratio, 0.28);
  EXPECT_EQ(steel.rolling_friction, 0);
  EXPECT_EQ(steel.pivoting_friction, 1e-6);
  EXPECT_EQ(steel.cohesion_force, 0);
  ASSERT_EQ(scene.pairs.size(), 1u);
  EXPECT_EQ(scene.pairs[0].between, (std::vector<std::string>{"glass", "steel"}));
  EXPECT_EQ(scene.pairs[0].friction, 0.2);
  EXPECT_EQ(scene.pairs[0].restitution, 0.7);
  EXPECT_EQ(scene.pairs[0].rolling_friction, 2e-6);
  EXPECT_EQ(scene.pairs[0].pivoting_friction, 3e-6);
  EXPECT_EQ(scene.pairs[0].cohesion_force, 1e-6);
  ASSERT_EQ(scene.grains.groups.size(), 1u);
  EXPECT_EQ(scene.grains.groups[0].material, "steel");
  EXPECT_EQ(scene.grains.groups[0].fraction, 0.25);
  EXPECT_EQ(scene.planes.at(0).material, "steel");
  EXPECT_TRUE(scene.md.energy_budget);
  EXPECT_EQ(scene.md.drag, 2);
  EXPECT_EQ(scene.md.acceleration_damping, 0.3);
}

const std::string hertz = R"(grains.count = 10
run.duration = 1
material.restitution = 0.5
material.normal_law = "hertz"
material.young_modulus = 1e5
material.poisson_ratio = 0.3
)";

class BadMaterial : public testing::TestWithParam<BadScene> {};

TEST_P(BadMaterial, SaysWhatIsWrong) { EXPECT_EQ(mistakes_of(GetParam().text), GetParam().expected); }

INSTANTIATE_TEST_SUITE_P(
    Rules, BadMaterial,
    testing::Values(
        BadScene{"poisson_without_hertz",
                 sound + R"(material.poisson_ratio = 0.3
)",
                 {R"(5:26: material.poisson_ratio needs material.normal_law = "hertz")"}},
        BadScene{"modulus_without_hertz",
                 sound + R"(material.young_modulus = 1e3
)",
                 {R"(5:26: material.young_modulus needs material.normal_law = "hertz")"}},
        BadScene{"hertz_without_its_constants",
                 sound + R"(material.normal_law = "hertz"
)",
                 {R"(2:1: material.stiffness_level or material.young_modulus is needed by engine md)",
                  R"(2:1: material.poisson_ratio is needed with normal_law = "hertz")",
                  R"(3:29: material.normal_stiffness needs material.normal_law = "linear")"}},
        BadScene{"hertz_with_linear_constants",
                 hertz + R"(material.normal_stiffness = 1e3
material.tangential_stiffness_ratio = 0.5
)",
                 {R"(7:29: material.normal_stiffness needs material.normal_law = "linear")",
                  R"(8:39: material.tangential_stiffness_ratio needs material.normal_law = "linear")"}},
        BadScene{"hertz_with_modulus_and_level",
                 hertz + R"(material.stiffness_level = 1e4
loading.pressure = 1
)",
                 {R"(5:26: material.stiffness_level and material.young_modulus exclude each other)"}},
        BadScene{
            "hertz_level_without_pressure",
            R"(grains.count = 10
run.duration = 1
material.restitution = 0.5
material.normal_law = "hertz"
material.poisson_ratio = 0.3
material.stiffness_level = 1e4
)",
            {R"(6:28: material.stiffness_level needs loading.pressure: it is (E / ((1 - nu^2) P d^(D-3)))^(2/3))"}},
        BadScene{"hertz_without_poisson_ratio",
                 R"(grains.count = 10
run.duration = 1
material.restitution = 0.5
material.normal_law = "hertz"
material.young_modulus = 1e5
)",
                 {R"(3:1: material.poisson_ratio is needed with normal_law = "hertz")"}},
        BadScene{"impossible_elasticity",
                 R"(grains.count = 10
run.duration = 1
material.restitution = 0.5
material.normal_law = "hertz"
material.poisson_ratio = 0.6
material.young_modulus = -1
)",
                 {R"(5:26: material.poisson_ratio: expected a number in (-1, 0.5], got 0.6)",
                  R"(6:26: material.young_modulus: expected a modulus > 0, got -1)"}},
        BadScene{"least_poisson_ratio",
                 R"(grains.count = 10
run.duration = 1
material.restitution = 0.5
material.normal_law = "hertz"
material.poisson_ratio = -1
material.young_modulus = 1
)",
                 {R"(5:26: material.poisson_ratio: expected a number in (-1, 0.5], got -1)"}},
        BadScene{"negative_stiffness",
                 R"(grains.count = 10
run.duration = 1
material.restitution = 1.5
material.normal_stiffness = -1
)",
                 {R"(3:24: material.restitution: expected a number in [0, 1], got 1.5)",
                  R"(4:29: material.normal_stiffness: expected a stiffness > 0, got -1)"}},
        BadScene{"misspelt_law",
                 sound + R"(material.normal_law = "herz"
)",
                 {R"(5:23: material.normal_law: expected "linear" or "hertz", got "herz"; did you mean "hertz"?)"}},
        BadScene{"pivoting_disks",
                 sound + R"(material.pivoting_friction = 0.1
)",
                 {R"(5:30: material.pivoting_friction needs dimension = 3: disks turn about one axis only)"}},
        BadScene{"negative_rolling_friction",
                 sound + R"(material.rolling_friction = -0.1
)",
                 {R"(5:29: material.rolling_friction: expected a length >= 0, got -0.1)"}},
        BadScene{"two_cohesions",
                 sound + R"(material.cohesion_force = 1
material.cohesion_number = 1
)",
                 {R"(6:28: material.cohesion_force and material.cohesion_number exclude each other)",
                  R"(6:28: material.cohesion_number needs loading.pressure: it is F0 / (P d^(D-1)))"}},
        BadScene{
            "cohesion_law_without_cohesion",
            sound + R"(material.cohesion_law = "square_root"
)",
            {R"(5:25: material.cohesion_law has no effect without a cohesion: give material.cohesion_force or material.cohesion_number)"}},
        BadScene{
            "square_root_with_range",
            sound + R"(material.cohesion_law = "square_root"
material.cohesion_force = 1
material.cohesion_range = 0.1
)",
            {R"(7:27: material.cohesion_range needs cohesion_law = "constant": the square-root law ends with the contact)"}},
        BadScene{"square_root_with_hertz",
                 hertz + R"(material.cohesion_law = "square_root"
material.cohesion_force = 1
)",
                 {R"(7:25: material.cohesion_law = "square_root" needs normal_law = "linear")"}},
        BadScene{
            "range_without_cohesion",
            sound + R"(material.cohesion_range = 0.1
)",
            {R"(5:27: material.cohesion_range has no effect without a cohesion: give material.cohesion_force or material.cohesion_number)"}},
        BadScene{
            "range_beyond_the_cell",
            sound + R"(material.cohesion_force = 1
material.cohesion_range = 15
cell.size = [10, 20]
)",
            {R"(6:27: material.cohesion_range: 15 is beyond the cell, whose edge in the periodic direction x is 10)"}},
        BadScene{"symbol_for_name",
                 sound + R"(material.eta = 1
)",
                 {R"(5:10: unknown name "eta" in [material]; did you mean "cohesion_number"?)"}},
        BadScene{
            "square_root_cohesion_in_cd",
            sound + R"(engine = "cd"
material.cohesion_law = "square_root"
material.cohesion_force = 1
)",
            {R"(6:25: material.cohesion_law: engine cd has the law "constant" only: the square root is one of the )"
             R"(deflection)"}},
        BadScene{"tangential_restitution_in_md",
                 sound + R"(material.tangential_restitution = 0.5
material_pair = [{between = ["default", "default"], tangential_restitution = 0.2}]
)",
                 {R"(5:35: material.tangential_restitution needs engine = "cd": in md it follows from tangential )"
                  R"(stiffness and damping)",
                  R"(6:78: material_pair[0].tangential_restitution needs engine = "cd": in md it follows from )"
                  R"(tangential stiffness and damping)"}},
        BadScene{"compliance_of_cd",
                 sound + R"(engine = "cd"
cd = {compliance = true, theta = 0.5}
material.tangential_damping_ratio = 0.1
material.tangential_restitution = 0.3
)",
                 {R"(6:20: cd.compliance needs material.viscous_convention = "total": the implicit contact bounds the )"
                  R"(repulsive force as a whole)",
                  R"(6:20: cd.compliance and a tangential_restitution exclude each other: tangential springs rebound)",
                  R"(6:34: cd.theta below 1 and cd.compliance exclude each other)",
                  R"(7:37: material.tangential_damping_ratio: the elastic contacts of cd have no tangential dashpot; )"
                  R"(leave it out)"}},
        BadScene{"planes_with_mass_in_md",
                 sound + R"(cell.periodic = [false, false]
plane = [{point = [0, 0], normal = [0, 1], mass = 2}, {point = [0, 9], normal = [0, -1], force = 2}]
)",
                 {R"(6:51: plane[0].mass needs engine = "cd": planes of md have imposed velocities)",
                  R"(6:98: plane[1].force needs plane[1].mass: a plane without mass has an imposed velocity)"}},
        BadScene{"nameless_material",
                 sound + R"(other_material = [{friction = 1}]
)",
                 {R"(5:19: other_material[0].name is needed: a string)"}},
        BadScene{"names_used_twice",
                 sound + R"(other_material = [{name = "a"}, {name = "a"}, {name = "default"}, {name = ""}]
)",
                 {R"(5:41: other_material[1].name: "a" is the name of another material already)",
                  R"(5:55: other_material[2].name: "default" is the name of another material already)",
                  R"(5:75: other_material[3].name is empty)"}},
        BadScene{
            "wrong_constants_of_another_material",
            sound +
                R"(other_material = [{name = "a", young_modulus = 1, restitution = 0.1, damping_ratio = 1, density = 2}]
)",
            {R"(5:48: other_material[0].young_modulus needs material.normal_law = "hertz")",
             R"(5:86: other_material[0].restitution and other_material[0].damping_ratio exclude each other)",
             R"(5:99: other_material[0].density needs grains.density: the other grains' masses must be given in the same way)"}},
        BadScene{
            "misspelt_name_in_a_pair",
            sound + R"(other_material = [{name = "steel", restitution = 0}]
material_pair = [{between = ["steel", "stel"]}]
)",
            {R"(5:50: other_material[0].restitution: md needs a restitution > 0 (give a damping_ratio for stronger damping))",
             R"(6:29: material_pair[0].between: no material is called "stel"; did you mean "steel"?; there are "default" or "steel")"}},
        BadScene{
            "pairs_that_can_not_be",
            sound + R"(other_material = [{name = "a"}]
material_pair = [{between = ["a", "default"]}, {between = ["default", "a"], restitution = 0}, {between = ["a"]}]
)",
            {R"(6:59: material_pair[1].between: this pair is there already)",
             R"(6:91: material_pair[1].restitution: md needs a restitution > 0 (give a damping_ratio for stronger damping))",
             R"(6:106: material_pair[2].between: expected two names, got 1)"}},
        BadScene{"stiffness_of_a_hertz_pair",
                 hertz + R"(other_material = [{name = "a"}]
material_pair = [{between = ["a", "default"], normal_stiffness = 3}]
)",
                 {R"(8:66: material_pair[0].normal_stiffness needs material.normal_law = "linear")"}},
        BadScene{"pairs_of_the_wrong_type",
                 sound + R"(material_pair = [{between = "default"}, {between = [1, "default"]}]
)",
                 {R"(5:29: material_pair[0].between: expected an array of strings, got "default")",
                  R"(5:53: material_pair[1].between: expected a string, got 1)"}},
        BadScene{
            "groups_that_can_not_be",
            sound +
                R"(group = [{material = "a", fraction = 0.5}, {material = "default", fraction = 0.7}, {material = "default", fraction = 1.2}]
)",
            {R"(5:22: group[0].material: no material is called "a"; there is only "default")",
             R"(5:96: group[2].material: "default" has a group already)",
             R"(5:118: group[2].fraction: expected a number in (0, 1], got 1.2)"}},
        BadScene{"groups_above_one",
                 sound + R"(group = [{material = "default", fraction = 1}, {material = "a", fraction = 0.5}]
other_material = [{name = "a"}]
)",
                 {R"(5:9: group: the fractions sum to 1.5, more than 1)"}},
        BadScene{
            "relaxer_in_a_flow",
            sound + R"(md.drag = 1
loading = {kind = "plane_shear", shear_rate = 1}
)",
            {R"(5:11: md.drag is refused with an imposed flow: it breaks the balance of momentum and may only help to reach an equilibrium)"}},
        BadScene{
            "relaxer_under_gravity",
            sound + R"(md.acceleration_damping = 0.5
loading.gravity = [0, -1]
cell.periodic = [true, false]
plane = [{point = [0, 0], normal = [0, 1], velocity = [0, 1], material = "wood"}]
)",
            {R"(5:27: md.acceleration_damping is refused under gravity: it breaks the balance of momentum and may only help to reach an equilibrium)",
             R"(5:27: md.acceleration_damping is refused with moving planes: it breaks the balance of momentum and may only help to reach an equilibrium)",
             R"(8:74: plane[0].material: no material is called "wood"; there is only "default")"}},
        BadScene{"relaxers_out_of_range",
                 sound + R"(md.acceleration_damping = 1
md.drag = -1
)",
                 {R"(5:27: md.acceleration_damping: expected a number in [0, 1), got 1)",
                  R"(6:11: md.drag: expected a rate >= 0, got -1)"}}),
    [](const testing::TestParamInfo<BadScene>& which) { return which.param.name; });

Scene two_materials() {
  Scene scene;
  scene.grains.count = 41;
  scene.grains.density = 2;
  scene.initial.solid_fraction = 0.3;
  scene.material.friction = 0.5;
  scene.material.restitution = 0.5;
  scene.material.normal_stiffness = 1e4;
  scene.run.duration = 1;
  scene.other_materials.push_back({.name = "heavy", .density = 6, .friction = 0.2, .normal_stiffness = 3e4});
  scene.grains.groups = {{"heavy", 0.25}};
  return scene;
}

/// What `galet describe` says of a symbol; empty without it.
std::string described(const Scene& scene, const std::string& symbol) {
  for (const DerivedLine& line : explain(scene, derive(scene, grain_facts<2>(scene, initial_sample<2>(scene)))))
    if (line.symbol == symbol) return line.value;
  return "";
}

TEST(SceneMaterial, SaysWhetherBondsDependOnKappa) {
  Scene scene = parse_scene(R"(dimension = 2
grains = {count = 10, diameter = 1, mass = 1}
run.duration = 1
loading.pressure = 1
material = {friction = 0.3, restitution = 0.9, stiffness_level = 1e5, cohesion_number = 50, cohesion_range = 1e-3}
)",
                            "test.toml");
  // h0 = F0 / K_N = eta d / kappa = 5e-4 d.
  EXPECT_EQ(described(scene, "h0/D0"), "0.5");
  scene.material.stiffness_level = 1e6;
  EXPECT_EQ(described(scene, "h0/D0"), "0.05");
  scene.material.cohesion_range = 0;
  EXPECT_EQ(described(scene, "h0/D0"), "");
  EXPECT_EQ(described(scene, "D0"), "0");
}

TEST(SceneMaterial, GroupsHaveTheirShareAndTheirMasses) {
  const Scene scene = two_materials();
  const Sample<2> sample = initial_sample<2>(scene);
  EXPECT_EQ(std::count(sample.material.begin(), sample.material.end(), 1), 10);  // a quarter of 41, rounded
  for (int i = 0; i < sample.count(); ++i)
    EXPECT_NEAR(sample.mass[i], (sample.material[i] == 1 ? 6 : 2) * grain_volume<2>(1), 1e-15);
  EXPECT_EQ(initial_sample<2>(scene).material, sample.material);
  Scene other = scene;
  other.seed = 2;
  EXPECT_NE(initial_sample<2>(other).material, sample.material);
}

TEST(SceneMaterial, PairsAreMixedOrGiven) {
  Scene scene = two_materials();
  const LawTable mixed = law_table(scene, std::nullopt, 1);
  ASSERT_EQ(mixed.materials, 2);
  EXPECT_EQ(mixed.at(0, 0).friction, 0.5);
  EXPECT_EQ(mixed.at(0, 1).friction, 0.2);
  EXPECT_DOUBLE_EQ(mixed.at(0, 1).stiffness, 1.5e4);  // 2 * 1 * 3 / (1 + 3)
  EXPECT_EQ(mixed.at(1, 1).stiffness, 3e4);
  EXPECT_EQ(mixed.at(1, 0).stiffness, mixed.at(0, 1).stiffness);
  scene.pairs.push_back({.between = {"heavy", "default"}, .friction = 0.9, .restitution = 0.3, .normal_stiffness = 7});
  const LawTable given = law_table(scene, std::nullopt, 1);
  for (const PairLaw& law : {given.at(0, 1), given.at(1, 0)}) {
    EXPECT_EQ(law.friction, 0.9);
    EXPECT_EQ(law.restitution, 0.3);
    EXPECT_EQ(law.damping_ratio, damping_of_restitution(0.3, DampingConvention::elastic));
    EXPECT_EQ(law.stiffness, 7);
  }
  EXPECT_EQ(given.at(1, 1).friction, 0.2);
}

TEST(SceneMaterial, PackingFilesKeepMaterials) {
  const Scene scene = two_materials();
  const Sample<2> sample = initial_sample<2>(scene);
  const TemporaryFolder folder;
  write_packing_csv<2>(folder.file("packing.csv"), sample);
  EXPECT_EQ(read_packing_csv<2>(folder.file("packing.csv")).sample.material, sample.material);
  write_lammps_data<2>(folder.file("packing.data"), sample);
  EXPECT_EQ(read_lammps_data<2>(folder.file("packing.data")).material, sample.material);

  Scene from_file = scene;
  from_file.grains = GrainSpec{};
  from_file.initial.kind = InitialKind::packing;
  from_file.initial.file = folder.file("packing.data");
  EXPECT_EQ(initial_sample<2>(from_file).material, sample.material);
  // A scene of one material has no use for the types of a file.
  Scene plain = from_file;
  plain.other_materials.clear();
  EXPECT_EQ(initial_sample<2>(plain).material, std::vector<int>(41, 0));
  // A material that the scene has not is refused.
  Sample<2> strange = sample;
  strange.material[7] = 2;
  write_packing_csv<2>(folder.file("strange.csv"), strange);
  from_file.initial.file = folder.file("strange.csv");
  EXPECT_THROW(initial_sample<2>(from_file), InputError);
  EXPECT_THROW(parse_packing_csv<2>("# cell: 5 0 0 5\nx,y,diameter,material\n1,1,1,0.5\n", "t"), InputError);
}

TEST(SceneMaterial, ListedGrainsAndPlanesNameTheirs) {
  Scene scene = two_materials();
  scene.grains = GrainSpec{};
  scene.initial.kind = InitialKind::listed;
  scene.cell.periodic = {false, false};
  scene.grains.listed = {{.position = {1, 1}, .material = "heavy"}, {.position = {3, 1}}};
  scene.planes = {{.point = {0, 0}, .normal = {0, 1}}, {.point = {0, 0}, .normal = {1, 0}, .material = "heavy"}};
  const Sample<2> sample = initial_sample<2>(scene);
  EXPECT_EQ(sample.material, (std::vector<int>{1, 0}));
  EXPECT_EQ(sample.plane_material, (std::vector<int>{0, 1}));
}

}  // namespace
}  // namespace galet::test::scene_material_test
