// Sound scene files: every field arrives, with units and paths; several mistakes at once; the scenes of the project.
#include "common/io/scene_file.hpp"

#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>
#include <unistd.h>

#include "common/io/files.hpp"
#include "tests/unit/scene_mistakes.hpp"

namespace galet::test::scene_file_test {
namespace {

using Reals = std::vector<double>;

const std::string shear_scene = R"(title = "A shear cell"
dimension = 2
seed = 42
units = "reduced"
engine = "cd"
[grains]
count = 500
diameter = {distribution = "uniform", mean = 2, spread = 0.25}
density = 1.5
[material]
friction = 0.4
restitution = 0.1
stiffness_level = 1e4
tangential_stiffness_ratio = 0.8
viscous_convention = "total"
[initial]
kind = "compressed_gas"
solid_fraction = 0.4
speed = 0.01
friction = 0.1
[cell]
periodic = [true, true]
aspect = [2, 1]
inertia_factor = 3
[loading]
kind = "plane_shear"
pressure = 2
inertial_number = 0.1
[md]
steps_per_contact = 80
allow_unsafe_dt = true
[cd]
dt_factor = 0.02
tolerance = 1e-5
max_sweeps = 300
penetration = 1e-3
[run]
strain = 12
average_from = 0.25
samples = 99
[compare]
inertial_numbers = [0.1, 0.01]
stiffness_levels = [1e3, 1e4]
cd_dt_factors = [0.01]
cd_tolerances = [1e-3, 1e-5]
)";

TEST(SceneFile, ReadsTheTopTheGrainsAndTheMaterial) {
  const Scene scene = parse_scene(shear_scene, "shear.toml");
  EXPECT_EQ(scene.title, "A shear cell");
  EXPECT_EQ(scene.source, shear_scene);
  EXPECT_EQ(scene.directory, "");
  EXPECT_EQ(scene.dimension, 2);
  EXPECT_EQ(scene.seed, 42u);
  EXPECT_TRUE(scene.reduced_units);
  EXPECT_EQ(scene.engine, EngineKind::cd);
  EXPECT_EQ(scene.grains.count, 500);
  EXPECT_EQ(scene.grains.diameter.kind, SizeKind::uniform);
  EXPECT_EQ(scene.grains.diameter.mean, 2);
  EXPECT_EQ(scene.grains.diameter.spread, 0.25);
  EXPECT_EQ(scene.grains.density, 1.5);
  EXPECT_EQ(scene.grains.mass, std::nullopt);
  EXPECT_EQ(scene.material.friction, 0.4);
  EXPECT_EQ(scene.material.restitution, 0.1);
  EXPECT_EQ(scene.material.damping_ratio, std::nullopt);
  EXPECT_EQ(scene.material.stiffness_level, 1e4);
  EXPECT_EQ(scene.material.normal_stiffness, std::nullopt);
  EXPECT_EQ(scene.material.tangential_stiffness_ratio, 0.8);
  EXPECT_EQ(scene.material.convention, DampingConvention::total);
}

TEST(SceneFile, ReadsTheInitialStateTheCellAndTheLoading) {
  const Scene scene = parse_scene(shear_scene, "shear.toml");
  EXPECT_EQ(scene.initial.kind, InitialKind::compressed_gas);
  EXPECT_EQ(scene.initial.solid_fraction, 0.4);
  EXPECT_EQ(scene.initial.speed, 0.01);
  EXPECT_EQ(scene.initial.friction, 0.1);
  EXPECT_EQ(scene.cell.periodic, (std::vector<bool>{true, true}));
  EXPECT_EQ(scene.cell.aspect, (Reals{2, 1}));
  EXPECT_TRUE(scene.cell.size.empty());
  EXPECT_EQ(scene.cell.inertia_factor, 3);
  EXPECT_EQ(scene.loading.kind, LoadingKind::plane_shear);
  EXPECT_EQ(scene.loading.pressure, 2);
  EXPECT_EQ(scene.loading.inertial_number, 0.1);
  EXPECT_EQ(scene.loading.shear_rate, std::nullopt);
}

TEST(SceneFile, ReadsTheEnginesTheRunAndTheComparison) {
  const Scene scene = parse_scene(shear_scene, "shear.toml");
  EXPECT_EQ(scene.md.dt, std::nullopt);
  EXPECT_EQ(scene.md.steps_per_contact, 80);
  EXPECT_TRUE(scene.md.allow_unsafe_dt);
  EXPECT_EQ(scene.cd.dt, std::nullopt);
  EXPECT_EQ(scene.cd.dt_factor, 0.02);
  EXPECT_EQ(scene.cd.tolerance, 1e-5);
  EXPECT_EQ(scene.cd.max_sweeps, 300);
  EXPECT_EQ(scene.cd.penetration, 1e-3);
  EXPECT_EQ(scene.run.duration, std::nullopt);
  EXPECT_EQ(scene.run.strain, 12);
  EXPECT_EQ(scene.run.average_from, 0.25);
  EXPECT_EQ(scene.run.samples, 99);
  EXPECT_EQ(scene.compare.inertial_numbers, (Reals{0.1, 0.01}));
  EXPECT_EQ(scene.compare.stiffness_levels, (Reals{1e3, 1e4}));
  EXPECT_EQ(scene.compare.cd_dt_factors, Reals{0.01});
  EXPECT_EQ(scene.compare.cd_tolerances, (Reals{1e-3, 1e-5}));
}

const std::string box_scene = R"(dimension = 3
[material]
damping_ratio = 0.2
normal_stiffness = 1e5
friction = 0.5
[cell]
periodic = [true, false, true]
size = [10, 20, 30]
[loading]
gravity = [0, -9.81, 0]
[md]
dt = 1e-4
[cd]
dt = 1e-3
[run]
duration = 2
[[plane]]
point = [0, 1, 0]
normal = [0, 2, 0]
velocity = [1, 0, 0]
[[plane]]
point = [0, 19, 0]
normal = [0, -1, 0]
[[grain]]
position = [1, 2, 3]
velocity = [4, 5, 6]
spin = [7, 8, 9]
diameter = 1.5
[[grain]]
position = [5, 5, 5]
)";

TEST(SceneFile, ReadsListedGrainsAndPlanes) {
  const Scene scene = parse_scene(box_scene, "box.toml");
  EXPECT_EQ(scene.initial.kind, InitialKind::listed);
  ASSERT_EQ(scene.grains.listed.size(), 2u);
  const ListedGrain& grain = scene.grains.listed[0];
  EXPECT_EQ(grain.position, (Reals{1, 2, 3}));
  EXPECT_EQ(grain.velocity, (Reals{4, 5, 6}));
  EXPECT_EQ(grain.spin, (Reals{7, 8, 9}));
  EXPECT_EQ(grain.diameter, 1.5);
  EXPECT_EQ(scene.grains.listed[1].position, (Reals{5, 5, 5}));
  EXPECT_TRUE(scene.grains.listed[1].velocity.empty());
  EXPECT_TRUE(scene.grains.listed[1].spin.empty());
  EXPECT_EQ(scene.grains.listed[1].diameter, 1);
  ASSERT_EQ(scene.planes.size(), 2u);
  EXPECT_EQ(scene.planes[0].point, (Reals{0, 1, 0}));
  EXPECT_EQ(scene.planes[0].normal, (Reals{0, 2, 0}));
  EXPECT_EQ(scene.planes[0].velocity, (Reals{1, 0, 0}));
  EXPECT_EQ(scene.planes[1].normal, (Reals{0, -1, 0}));
  EXPECT_TRUE(scene.planes[1].velocity.empty());
  EXPECT_EQ(scene.material.damping_ratio, 0.2);
  EXPECT_EQ(scene.material.normal_stiffness, 1e5);
  EXPECT_EQ(scene.cell.periodic, (std::vector<bool>{true, false, true}));
  EXPECT_EQ(scene.cell.size, (Reals{10, 20, 30}));
  EXPECT_EQ(scene.loading.gravity, (Reals{0, -9.81, 0}));
  EXPECT_EQ(scene.md.dt, 1e-4);
  EXPECT_EQ(scene.cd.dt, 1e-3);
  EXPECT_EQ(scene.run.duration, 2);
}

TEST(SceneFile, ReadsDrivesAndADiscreteDistribution) {
  const Scene scene = parse_scene(R"(engine = "cd"
[grains]
count = 20
mass = 3
[grains.diameter]
distribution = "discrete"
values = [1, 1.4]
fractions = [0.25, 0.75]
[material]
restitution = 0
[loading]
kind = "drives"
[[drive]]
component = "xy"
rate = -0.5
[[drive]]
component = "yy"
stress = -2
[run]
strain = 1
)",
                                  "drives.toml");
  EXPECT_EQ(scene.grains.mass, 3);
  EXPECT_EQ(scene.grains.diameter.kind, SizeKind::discrete);
  EXPECT_EQ(scene.grains.diameter.diameters, (Reals{1, 1.4}));
  EXPECT_EQ(scene.grains.diameter.fractions, (Reals{0.25, 0.75}));
  EXPECT_EQ(scene.material.restitution, 0);
  ASSERT_EQ(scene.loading.drives.size(), 2u);
  EXPECT_EQ(scene.loading.drives[0].component, "xy");
  EXPECT_EQ(scene.loading.drives[0].rate, -0.5);
  EXPECT_EQ(scene.loading.drives[0].stress, std::nullopt);
  EXPECT_EQ(scene.loading.drives[1].component, "yy");
  EXPECT_EQ(scene.loading.drives[1].rate, std::nullopt);
  EXPECT_EQ(scene.loading.drives[1].stress, -2);
}

TEST(SceneFile, ReadsAShearRateAndAnEquilibrium) {
  EXPECT_EQ(parse_scene(sound + "loading.kind = \"plane_shear\"\nloading.shear_rate = 0.5\n", "s").loading.shear_rate,
            0.5);
  EXPECT_EQ(parse_scene(sound + "loading.kind = \"isotropic\"\nloading.pressure = 1\nrun.equilibrium = 1e-6\n", "s")
                .run.equilibrium,
            1e-6);
}

TEST(SceneFile, FillsInDefaultsThatDependOnOtherFields) {
  const Scene disks = parse_scene(sound, "s");
  EXPECT_EQ(disks.initial.kind, InitialKind::gas);
  EXPECT_EQ(disks.initial.solid_fraction, 0.5);
  EXPECT_EQ(parse_scene(sound + "dimension = 3\n", "s").initial.solid_fraction, 0.3);
  EXPECT_EQ(parse_scene(sound + "dimension = 3\ninitial.kind = \"lattice\"\n", "s").initial.solid_fraction, 0.5);
}

TEST(SceneFile, TakesAPlainNumberAsTheDiameterAndASpinInTwoDimensions) {
  EXPECT_EQ(parse_scene(sound + "grains.diameter = 3\n", "s").grains.diameter.mean, 3);
  const Scene scene = parse_scene(R"(material = {friction = 0.1, restitution = 0.5, normal_stiffness = 1e4}
run.duration = 1
cell.periodic = [false, false]
[[grain]]
position = [1, 1]
spin = 2
)",
                                  "s");
  EXPECT_EQ(scene.grains.listed[0].spin, Reals{2});
}

TEST(SceneFile, ConvertsUnitsToSi) {
  const Scene scene = parse_scene(R"(units = "SI"
dimension = 3
[grains]
count = 100
diameter = "3 mm"
density = "2.6 g/cm^3"
[material]
restitution = 0.5
normal_stiffness = "70MN/m"
[initial]
speed = "1 cm/s"
[cell]
aspect = [1, 1, 2]
periodic = [true, false, true]
[loading]
gravity = [0, "-9.81 m/s²", 0]
pressure = "+10 kPa"
[md]
dt = "5 µs"
[cd]
dt = 2e-5
[run]
duration = "1.5 min"
)",
                                  "si.toml");
  EXPECT_FALSE(scene.reduced_units);
  EXPECT_EQ(scene.grains.diameter.mean, 0.003);
  EXPECT_EQ(scene.grains.density, 2600);
  EXPECT_EQ(scene.material.normal_stiffness, 7e7);
  EXPECT_EQ(scene.initial.speed, 0.01);
  EXPECT_EQ(scene.loading.gravity, (Reals{0, -9.81, 0}));
  EXPECT_EQ(scene.loading.pressure, 1e4);
  EXPECT_EQ(scene.md.dt, 5e-6);
  EXPECT_EQ(scene.cd.dt, 2e-5);
  EXPECT_EQ(scene.run.duration, 90);
}

TEST(SceneFile, ReadsUnitsWhereverTheTopComesInAlphabeticalOrder) {
  // "cell" and "drive" come before "units": the reader must still know the units by then.
  const Scene scene = parse_scene(R"(units = "SI"
engine = "cd"
grains = {count = 10, diameter = "1 mm", mass = "1 mg"}
cell = {size = ["1 cm", "2 cm"]}
material.restitution = 0.5
run.duration = "1 s"
)",
                                  "s");
  EXPECT_EQ(scene.cell.size, (Reals{0.01, 0.02}));
  EXPECT_EQ(scene.grains.mass, 1e-6);
}

TEST(SceneFile, ReportsManyMistakesAtOnce) {
  const BadScene many = {"many_at_once",
                         R"(dimension = 2
engin = "cd"
[grains]
count = -5
[material]
friction = "rough"
restitution = 0.5
damping_ratio = 0.1
[loading]
kind = "plane_shear"
gravity = [0.0, -1.0]
[run]
strain = 1
duration = nan
)",
                         {R"(2:1: unknown name "engin" at the top of the file; did you mean "engine"?)",
                          "4:9: grains.count: expected a whole number >= 1, got -5",
                          R"(6:12: material.friction: expected a number >= 0, got "rough")",
                          "8:17: material.restitution and material.damping_ratio exclude each other",
                          R"(9:1: loading.shear_rate or loading.inertial_number is needed with kind = "plane_shear")",
                          "11:11: loading.gravity: y is a periodic direction, in which grains would fall forever; set "
                          "cell.periodic to false there",
                          "14:12: run.duration: expected a time > 0, got nan, which is not finite"}};
  EXPECT_EQ(mistakes_of(many.text), many.expected);
}

TEST(SceneFile, NamesTheFileInTheMessage) {
  try {
    parse_scene(sound + "material.friction = -1\n", "dir/bad.toml");
    FAIL() << "a negative friction was accepted";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "dir/bad.toml:5:21: error: material.friction: expected a number >= 0, got -1");
  }
}

class SceneOnDisk : public testing::Test {
 protected:
  void SetUp() override {
    const std::string name = testing::UnitTest::GetInstance()->current_test_info()->name();
    folder_ = std::filesystem::temp_directory_path() / ("galet_scene_" + name + "_" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_ / "sub");
    before_ = std::filesystem::current_path();
    std::filesystem::current_path(folder_);
  }
  void TearDown() override {
    std::filesystem::current_path(before_);
    std::filesystem::remove_all(folder_);
  }
  static void write(const std::string& path, const std::string& text) { std::ofstream(path) << text; }

  std::filesystem::path folder_;
  std::filesystem::path before_;
};

const std::string packing_scene = R"(initial = {kind = "packing", file = "grains.csv"}
material = {restitution = 0.5, normal_stiffness = 1e4}
run.duration = 1
)";

TEST_F(SceneOnDisk, KnowsItsFolder) {
  write("here.toml", sound);
  write("sub/there.toml", sound);
  EXPECT_EQ(read_scene("here.toml").directory, ".");
  EXPECT_EQ(read_scene("sub/there.toml").directory, "sub");
  EXPECT_EQ(read_scene((folder_ / "sub/there.toml").string()).directory, (folder_ / "sub").string());
  EXPECT_EQ(read_scene("here.toml").source, sound);
  EXPECT_EQ(read_scene("here.toml", {{"grains.count", "7"}}).grains.count, 7);
}

TEST_F(SceneOnDisk, LooksForAPackingBesideTheScene) {
  write("sub/packing.toml", packing_scene);
  write("sub/grains.csv", "x,y,diameter\n");
  EXPECT_EQ(read_scene("sub/packing.toml").initial.file, "grains.csv");
  std::filesystem::rename("sub/grains.csv", "grains.csv");
  try {
    read_scene("sub/packing.toml");
    FAIL() << "a missing packing was accepted";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "sub/packing.toml:1:37: error: initial.file: no file \"sub/grains.csv\"");
  }
}

TEST_F(SceneOnDisk, LeavesThePackingOfATextToItsReader) {
  EXPECT_EQ(parse_scene(packing_scene, "text").initial.file, "grains.csv");
}

TEST_F(SceneOnDisk, SaysWhyAFileCannotBeRead) {
  try {
    read_scene("nowhere.toml");
    FAIL() << "a missing scene was accepted";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "nowhere.toml: error: can't read the file: No such file or directory");
  }
}

std::vector<std::filesystem::path> committed_scenes() {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(GALET_SOURCE_DIR "/scenes"))
    if (entry.path().extension() == ".toml") files.push_back(entry.path());
  return files;
}

TEST(SceneFolder, HasOnlySoundScenesThatSayWhatToExpect) {
  const auto files = committed_scenes();
  EXPECT_GE(files.size(), 3u);
  for (const std::filesystem::path& file : files) {
    SCOPED_TRACE(file.string());
    EXPECT_NO_THROW(EXPECT_FALSE(read_scene(file.string()).title.empty()));
    EXPECT_EQ(read_file(file.string()).front(), '#');
  }
}

TEST(SceneFolder, CoversTheReferenceMaterial) {
  const Scene scene = read_scene(GALET_SOURCE_DIR "/scenes/plane_shear_2d.toml");
  EXPECT_EQ(scene.material.friction, 0.4);
  EXPECT_EQ(scene.material.restitution, 0.1);
  EXPECT_EQ(scene.material.stiffness_level, 1e4);
  EXPECT_EQ(scene.compare.stiffness_levels, (Reals{1e3, 1e4, 1e5}));
  // The rigid engine must take the same scene.
  EXPECT_EQ(read_scene(GALET_SOURCE_DIR "/scenes/plane_shear_2d.toml", {{"engine", "cd"}}).engine, EngineKind::cd);
}

}  // namespace
}  // namespace galet::test::scene_file_test
