// Loadings and stages in scene files: what they mean, and every contradiction with the text of its error.
#include <gtest/gtest.h>

#include "common/scene/loading.hpp"
#include "common/scene/stages.hpp"
#include "tests/unit/scene_mistakes.hpp"

namespace galet::test::scene_stages_test {
namespace {

using Texts = std::vector<std::string>;

/// A scene without loading and length: what follows starts in line 6.
const std::string base = R"(grains.count = 10
material.restitution = 0.5
material.normal_stiffness = 1e4
loading.pressure = 2
run.samples = 5
)";

std::string space(std::string text) {
  text.replace(text.find("run.samples = 5"), 15, "dimension = 3  ");
  return text;
}

GrainFacts ten_grains() {
  GrainFacts facts;
  facts.count = 10;
  return facts;
}

// ---- presets -----------------------------------------------------------------------------------------------

std::vector<CellDrive> drives_of(const std::string& text) {
  const Scene scene = parse_scene(text, "test.toml");
  return loading_drives(scene, derive(scene, ten_grains()));
}

std::string shown(const std::vector<CellDrive>& drives) {
  std::string text;
  for (const CellDrive& drive : drives) {
    text += drive.component;
    if (drive.rate) text += fmt::format(" rate {:g}", *drive.rate);
    if (drive.stress) text += fmt::format(" stress {:g}", *drive.stress);
    if (drive.stress_to) text += fmt::format(" to {:g}", *drive.stress_to);
    if (drive.hold) text += " held";
    text += "; ";
  }
  return text;
}

TEST(LoadingPresets, AreListsOfDrives) {
  const auto flat = [](const std::string& loading) { return shown(drives_of(base + "run.duration = 1\n" + loading)); };
  const auto solid = [](const std::string& loading) {
    return shown(drives_of(space(base) + "run.duration = 1\n" + loading));
  };
  EXPECT_EQ(flat("loading.kind = \"isotropic\""), "isotropic stress 2; ");
  EXPECT_EQ(flat("loading.kind = \"isotropic\"\nloading.pressure_to = 3"), "isotropic stress 2 to 3; ");
  EXPECT_EQ(flat("loading.kind = \"plane_shear\"\nloading.shear_rate = 0.1"), "xy rate 0.1; yy stress 2; ");
  EXPECT_EQ(flat("loading.kind = \"plane_shear\"\nloading.shear_rate = 0.1\nloading.fixed_volume = true"),
            "xy rate 0.1; ");
  EXPECT_EQ(flat("loading.kind = \"oedometric\"\nloading.compression_rate = 0.1"), "yy rate -0.1; ");
  EXPECT_EQ(flat("loading.kind = \"biaxial\"\nloading.compression_rate = -0.1"), "yy rate 0.1; xx stress 2; ");
  EXPECT_EQ(flat("loading.kind = \"biaxial\"\nloading.hold_axial = true"), "yy held; xx stress 2; ");
  EXPECT_EQ(solid("loading.kind = \"oedometric\"\nloading.axial_stress = 4\nloading.axial_stress_to = 6"),
            "zz stress 4 to 6; ");
  // d = m = 1 and P = 2: tau_i = sqrt(1/2).
  EXPECT_EQ(solid("loading.kind = \"triaxial\"\nloading.inertial_number = 0.1"),
            fmt::format("zz rate {:g}; xx stress 2; yy stress 2; ", -0.1 * std::sqrt(2.0)));
}

TEST(LoadingPresets, StrainIsOfTheImposedRate) {
  const auto duration = [](const std::string& text) {
    const Scene scene = parse_scene(base + text, "test.toml");
    return derive(scene, ten_grains()).duration;
  };
  EXPECT_DOUBLE_EQ(duration("run.strain = 0.3\nloading.kind = \"oedometric\"\nloading.compression_rate = -0.1"), 3);
  EXPECT_DOUBLE_EQ(duration("run.strain = 0.3\nloading.kind = \"plane_shear\"\nloading.shear_rate = 0.1"), 3);
  EXPECT_DOUBLE_EQ(duration("run.strain = 0.3\nloading.kind = \"drives\"\ndrive = [{component = \"xx\", stress = 1}, "
                            "{component = \"yy\", rate = -0.2}]"),
                   1.5);
}

TEST(LoadingPresets, ChangingStressIsALoadThatMoves) {
  const Scene scene =
      parse_scene(base + "run.duration = 4\nloading.kind = \"isotropic\"\nloading.pressure_to = 3", "test.toml");
  const auto modes = cell_modes<2>(scene, derive(scene, ten_grains()), 10, 20);
  ASSERT_EQ(modes.size(), 1u);
  EXPECT_DOUBLE_EQ(modes[0].load, 4);  // summed over the two diagonal components
  EXPECT_DOUBLE_EQ(modes[0].load_rate, 2.0 / 4);
}

// ---- stages ------------------------------------------------------------------------------------------------

const std::string two_stages = base + R"([[stage]]
name = "assembly"
friction = 0
restitution = 0.9
duration = 100
unbalanced = 1e-3
[stage.loading]
kind = "isotropic"
[[stage]]
strain = 0.02
cycles = 2
[stage.loading]
kind = "drives"
pressure = 3
[[stage.drive]]
component = "yy"
rate = -1e-3
[[stage.drive]]
component = "xx"
hold = true
)";

TEST(SceneStages, AreScenesOfTheirOwn) {
  const Scene scene = parse_scene("material.friction = 0.3\n" + two_stages, "test.toml");
  const std::vector<Scene> stages = stage_scenes(scene);
  ASSERT_EQ(stages.size(), 2u);
  EXPECT_EQ(stage_name(scene, 0), "assembly");
  EXPECT_EQ(stage_name(scene, 1), "stage 2");
  EXPECT_EQ(stages[0].material.friction, 0);
  EXPECT_EQ(stages[1].material.friction, 0.3);
  EXPECT_EQ(stages[0].material.restitution, 0.9);
  EXPECT_EQ(stages[1].material.restitution, scene.material.restitution);
  EXPECT_EQ(stages[0].material.damping_ratio, std::nullopt);
  EXPECT_EQ(stages[1].material.damping_ratio, scene.material.damping_ratio);
  EXPECT_EQ(stages[0].loading.pressure, 2);
  EXPECT_EQ(stages[1].loading.pressure, 3);
  EXPECT_EQ(stages[0].run.unbalanced, 1e-3);
  EXPECT_EQ(stages[0].run.samples, 5);

  const std::vector<Derived> derived = derive_stages(scene, ten_grains());
  // What refers to a pressure refers to the scene's; layout and time step are shared.
  EXPECT_EQ(derived[1].pressure, 2);
  EXPECT_TRUE(derived[0].layout.friction);
  EXPECT_EQ(derived[0].md_dt, derived[1].md_dt);
  EXPECT_EQ(derived[0].cd_dt, derived[1].cd_dt);
  EXPECT_DOUBLE_EQ(derived[1].duration, 20);
  EXPECT_DOUBLE_EQ(derive(scene, ten_grains()).duration, 120);
}

TEST(SceneStages, CyclesGoThereAndBack) {
  const Scene scene = parse_scene(two_stages, "test.toml");
  const std::vector<Scene> stages = stage_scenes(scene);
  const std::vector<Derived> derived = derive_stages(scene, ten_grains());
  EXPECT_EQ(path_parts(stages[0]), 1);
  EXPECT_EQ(path_parts(stages[1]), 4);
  Mat<2> stress = Mat<2>::Identity();
  stress(0, 0) = 7;
  for (int part = 0; part < 4; ++part)
    EXPECT_EQ(shown(path_part<2>(stages[1], derived[1], part, stress).drives),
              part % 2 == 0 ? "yy rate -0.001; xx stress 7; " : "yy rate 0.001; xx stress 7; ");
  Scene stress_cycle = stages[0];
  stress_cycle.loading.pressure_to = 5;
  EXPECT_EQ(shown(path_part<2>(stress_cycle, derived[0], 0, stress).drives), "isotropic stress 2 to 5; ");
  EXPECT_EQ(shown(path_part<2>(stress_cycle, derived[0], 1, stress).drives), "isotropic stress 5 to 2; ");
}

// ---- mistakes ----------------------------------------------------------------------------------------------

TEST(LoadingMistakes, OfTheAxis) {
  EXPECT_EQ(mistakes_of(base + "run.duration = 1\nloading.kind = \"biaxial\"\n"),
            (Texts{"4:1: loading.compression_rate, loading.inertial_number, loading.axial_stress or "
                   "loading.hold_axial is needed with kind = \"biaxial\""}));
  EXPECT_EQ(mistakes_of(base + "run.duration = 1\nloading.kind = \"biaxial\"\nloading.compression_rate = 1\n"
                               "loading.axial_stress = 2\n"),
            (Texts{"9:24: loading.compression_rate and loading.axial_stress exclude each other"}));
  EXPECT_EQ(mistakes_of(base + "run.duration = 1\nloading.axial_stress = 2\n"),
            (Texts{"7:24: loading.axial_stress needs loading.kind = \"oedometric\", \"biaxial\" or \"triaxial\""}));
  EXPECT_EQ(mistakes_of(base + "run.duration = 1\nloading.kind = \"biaxial\"\nloading.compression_rate = 1\n"
                               "loading.axial_stress_to = 2\n"),
            (Texts{"9:27: loading.axial_stress_to needs loading.axial_stress or loading.hold_axial: where it starts"}));
  EXPECT_EQ(mistakes_of(base + "run.duration = 1\nloading.kind = \"triaxial\"\nloading.compression_rate = 1\n"),
            (Texts{"7:16: loading.kind = \"triaxial\" needs dimension = 3: \"biaxial\" is its counterpart in 2D"}));
  EXPECT_EQ(mistakes_of(space(base) + "run.duration = 1\nloading.kind = \"biaxial\"\nloading.compression_rate = 1\n"),
            (Texts{"7:16: loading.kind = \"biaxial\" needs dimension = 2: \"triaxial\" is its counterpart in 3D"}));
}

TEST(LoadingMistakes, OfPressures) {
  EXPECT_EQ(mistakes_of(sound + "loading.kind = \"biaxial\"\nloading.compression_rate = 1\n"),
            (Texts{"5:1: loading.pressure is needed with kind = \"biaxial\""}));
  EXPECT_EQ(mistakes_of(base + "run.duration = 1\nloading.pressure_to = 3\n"),
            (Texts{"7:23: loading.pressure_to needs a loading.kind that holds loading.pressure"}));
  EXPECT_EQ(mistakes_of(base + "run.duration = 1\nloading.kind = \"plane_shear\"\nloading.shear_rate = 1\n"
                               "loading.fixed_volume = true\nloading.pressure_to = 3\n"),
            (Texts{"10:23: loading.pressure_to needs a loading.kind that holds loading.pressure"}));
  EXPECT_EQ(mistakes_of(base + "run.duration = 1\nloading.fixed_volume = true\n"),
            (Texts{"7:24: loading.fixed_volume needs loading.kind = \"plane_shear\""}));
}

TEST(LoadingMistakes, OfDrives) {
  const std::string start = base + "run.duration = 1\nloading.kind = \"drives\"\n";
  EXPECT_EQ(mistakes_of(start + "drive = [{component = \"xx\", rate = 1, stress = 2}]\n"),
            (Texts{"8:48: drive[0].rate and drive[0].stress exclude each other"}));
  EXPECT_EQ(mistakes_of(start + "drive = [{component = \"xx\", rate = 1, hold = true}]\n"),
            (Texts{"8:46: drive[0].rate and drive[0].hold exclude each other"}));
  EXPECT_EQ(mistakes_of(start + "drive = [{component = \"xx\", rate = 1, stress_to = 2}]\n"),
            (Texts{"8:51: drive[0].stress_to needs drive[0].stress or drive[0].hold: where it starts"}));
}

TEST(LoadingMistakes, OfEnds) {
  const std::string held = base + "run.duration = 1\nloading.kind = \"isotropic\"\n";
  EXPECT_EQ(mistakes_of(held + "loading.pressure_to = 3\nrun.unbalanced = 1e-3\n"),
            (Texts{"9:18: run.unbalanced needs stresses that don't change: nothing comes to rest before they stop"}));
  EXPECT_EQ(mistakes_of(held + "run.stress_tolerance = 0.1\n"),
            (Texts{"8:24: run.stress_tolerance needs run.equilibrium or run.unbalanced"}));
  EXPECT_EQ(mistakes_of(held + "run.until = \"yz\"\nrun.until_stress = 3\n"),
            (Texts{"8:13: run.until: expected \"xx\", \"xy\", \"yx\", \"yy\" or \"isotropic\", got \"yz\"; did you "
                   "mean \"yx\"?"}));
  EXPECT_EQ(mistakes_of(held + "run.until = \"yy\"\n"),
            (Texts{"8:13: run.until needs run.until_stress or run.until_strain"}));
  EXPECT_EQ(mistakes_of(held + "run.until_strain = 0.1\n"),
            (Texts{"8:20: run.until_strain needs run.until: the component that reaches it"}));
  EXPECT_EQ(mistakes_of(held + "run.until = \"yy\"\nrun.until_stress = 3\nrun.until_strain = 0.1\n"),
            (Texts{"10:20: run.until_stress and run.until_strain exclude each other"}));
  EXPECT_EQ(mistakes_of(held + "run.cycles = 2\n"),
            (Texts{"8:14: run.cycles needs a loading that imposes a rate or a stress that changes"}));
  EXPECT_EQ(mistakes_of(base + "loading.kind = \"isotropic\"\nrun.strain = 1\n"),
            (Texts{"7:14: run.strain needs a loading that imposes a rate"}));
}

TEST(StageMistakes, NameTheStage) {
  EXPECT_EQ(mistakes_of(base + "stage = [{duration = 1}, {loading = {kind = \"isotropic\"}}]\n"),
            (Texts{"6:26: stage[1].duration or stage[1].strain is needed"}));
  EXPECT_EQ(mistakes_of(base + "stage = [{duration = 1, loading = {kind = \"drives\"}, drive = [{component = \"xx\", "
                               "rate = 1, stress = 1}, {component = \"xx\", stress = 1}]}]\n"),
            (Texts{"6:101: stage[0].drive[0].rate and stage[0].drive[0].stress exclude each other",
                   "6:118: stage[0].drive[1].component: \"xx\" is driven twice"}));
  EXPECT_EQ(mistakes_of(base + "stage = [{duration = 1, drive = [{component = \"xx\", rate = 1}]}]\n"),
            (Texts{"6:33: [[stage.drive]] entries need stage[0].loading.kind = \"drives\""}));
  EXPECT_EQ(mistakes_of(base + "stage = [{duration = 1, name = \"a\"}, {duration = 1, name = \"a\"}]\n"),
            (Texts{"6:60: stage[1].name: \"a\" is the name of another stage already"}));
  EXPECT_EQ(mistakes_of(base + "stage = [{duration = 1, loading = {gravity = [0, -1]}}]\n"),
            (Texts{"6:46: stage[0].loading.gravity: y is a periodic direction, in which grains would fall forever; set "
                   "cell.periodic to false there"}));
  EXPECT_EQ(mistakes_of(base + "stage = [{duration = 1, loading = {kind = \"isotropic\"}}]\n"
                               "cell.periodic = [true, false]\n"),
            (Texts{"7:17: cell.periodic: this stage[0].loading.kind moves the cell, which must be periodic in each "
                   "direction"}));
  EXPECT_EQ(mistakes_of(base + "stage = [{duration = 1, friction = -1}]\n"),
            (Texts{"6:36: stage[0].friction: expected a number >= 0, got -1"}));
  EXPECT_EQ(mistakes_of(base + "stage = [{durations = 1, duration = 1}]\n"),
            (Texts{"6:11: unknown name \"durations\" in [[stage]]; did you mean \"duration\"?"}));
}

TEST(StageMistakes, WholeAndStagesExcludeEachOther) {
  EXPECT_EQ(mistakes_of(base + "run.duration = 1\nloading.kind = \"isotropic\"\nstage = [{duration = 1}]\n"),
            (Texts{"6:16: run.duration and [[stage]] entries exclude each other: each stage has its own",
                   "7:16: loading.kind and [[stage]] entries exclude each other: each stage has its own"}));
  EXPECT_EQ(mistakes_of(sound + "stage = [{duration = 1, loading = {kind = \"isotropic\"}}]\n"),
            (Texts{"4:16: run.duration and [[stage]] entries exclude each other: each stage has its own",
                   "5:35: stage[0].loading.pressure is needed with kind = \"isotropic\""}));
}

TEST(CheckpointMistakes, OfTheStart) {
  const std::string start = R"(material.restitution = 0.5
material.normal_stiffness = 1e4
run.duration = 1
initial.kind = "checkpoint"
)";
  EXPECT_EQ(mistakes_of(start), (Texts{"4:1: initial.file is needed with kind = \"checkpoint\""}));
  EXPECT_EQ(mistakes_of(start + "initial.file = \"a.h5\"\ngrains.count = 7\ninitial.speed = 1\ncell.size = [9, 9]\n"),
            (Texts{"6:16: grains.count follows from the checkpoint: leave it out",
                   "7:17: initial.speed has no effect on a checkpoint, whose grains have their velocities",
                   "8:13: cell.size has no effect on a checkpoint, which brings its cell"}));
  EXPECT_EQ(mistakes_of(start + "initial.file = \"a.h5\"\ngrains.mass = 2\n"),
            (Texts{"6:1: grains.density and grains.mass have no effect on a checkpoint, whose grains have their "
                   "masses"}));
  EXPECT_EQ(mistakes_of(sound + "initial.contacts = \"fresh\"\n"),
            (Texts{"5:20: initial.contacts needs initial.kind = \"checkpoint\": other states have no contacts yet"}));
}

}  // namespace
}  // namespace galet::test::scene_stages_test
