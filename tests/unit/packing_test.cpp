// Initial states: no overlaps (by brute force, images included), the numbers asked for, and the same bits every time.
#include "common/scene/packing.hpp"

#include <numbers>
#include <set>

#include <gtest/gtest.h>

#include "common/core/error.hpp"
#include "common/io/lammps.hpp"
#include "common/io/packing_csv.hpp"
#include "tests/support/brute_force.hpp"
#include "tests/support/sanitized.hpp"
#include "tests/support/temporary_folder.hpp"

namespace galet::test::packing_test {
namespace {

using test::put_bytes;
using test::TemporaryFolder;
constexpr double pi = std::numbers::pi;

Scene base_scene(int dim, InitialKind kind, int count, double solid_fraction) {
  Scene scene;
  scene.dimension = dim;
  scene.grains.count = count;
  scene.grains.diameter.kind = SizeKind::uniform;
  scene.grains.diameter.mean = 1.5;
  scene.grains.diameter.spread = 0.2;
  scene.initial.kind = kind;
  scene.initial.solid_fraction = solid_fraction;
  return scene;
}

template <int D>
std::string refusal(const Scene& scene) {
  try {
    initial_sample<D>(scene);
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

#define EXPECT_REFUSED(D, scene, text) \
  EXPECT_NE(refusal<D>(scene).find(text), std::string::npos) << "refused with: " << refusal<D>(scene)

/// Grains inside the cell along periodic directions and wholly inside along the others; none touching; right density.
template <int D>
void expect_sound(const Scene& scene) {
  const Sample<D> sample = initial_sample<D>(scene);
  ASSERT_EQ(sample.count(), scene.grains.count);
  EXPECT_GE(test::least_gap<D>(sample), -1e-12);
  const Mat<D> inverse = sample.cell.box.inverse();
  for (int i = 0; i < sample.count(); ++i)
    for (int a = 0; a < D; ++a) {
      const double margin = sample.cell.periodic[a] ? 0 : sample.radius[i] / sample.cell.box(a, a);
      const double s = (inverse * sample.position[i])[a];
      EXPECT_GE(s, margin - 1e-12);
      EXPECT_LT(s, 1 - margin + 1e-12);
    }
  if (scene.cell.size.empty()) {
    EXPECT_NEAR(sample.solid_fraction(), scene.initial.solid_fraction, 1e-12);
  }
}

TEST(Packing, GasHasNoOverlap) {
  expect_sound<2>(base_scene(2, InitialKind::gas, 400, 0.48));
  expect_sound<3>(base_scene(3, InitialKind::gas, 300, 0.32));
  expect_sound<2>(base_scene(2, InitialKind::compressed_gas, 400, 0.2));
}

// Few grains: the insertion grid is one or two cells wide, where a pair can meet in two images.
TEST(Packing, GasInASmallCell) {
  for (int count = 1; count <= 12; ++count)
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
      Scene scene = base_scene(2, InitialKind::gas, count, 0.2);
      scene.seed = seed;
      expect_sound<2>(scene);
    }
}

TEST(Packing, GasInAPartlyPeriodicCell) {
  Scene scene = base_scene(2, InitialKind::gas, 300, 0.45);
  scene.cell.periodic = {true, false};
  scene.cell.aspect = {3, 1};
  expect_sound<2>(scene);
  EXPECT_NEAR(initial_sample<2>(scene).cell.box(0, 0), 3 * initial_sample<2>(scene).cell.box(1, 1), 1e-12);
  scene = base_scene(3, InitialKind::gas, 200, 0.3);
  scene.cell.periodic = {false, true, false};
  expect_sound<3>(scene);
  scene.cell.size = {10, 12, 14};
  EXPECT_EQ(initial_sample<3>(scene).cell.box, Mat<3>(Vec<3>(10, 12, 14).asDiagonal()));
  expect_sound<3>(scene);
}

TEST(Packing, GrainsStayOffPlanes) {
  for (const InitialKind kind : {InitialKind::gas, InitialKind::lattice}) {
    Scene scene = base_scene(2, kind, 60, 0.3);
    scene.cell.periodic = {true, false};
    scene.cell.size = {20, 30};
    scene.planes = {{{0, 2}, {0, 3}, {}}, {{0, 25}, {0.3, -2}, {0.5, 0}}};
    if (kind == InitialKind::lattice) scene.planes[1].normal = {0, -2};
    const Sample<2> sample = initial_sample<2>(scene);
    EXPECT_GE(test::least_gap<2>(sample), 0);
    ASSERT_EQ(sample.planes.size(), 2u);
    EXPECT_EQ(sample.planes[1].velocity, Vec<2>(0.5, 0));
    for (const Plane<2>& plane : sample.planes) {
      EXPECT_DOUBLE_EQ(plane.normal.norm(), 1);
      for (int i = 0; i < sample.count(); ++i)
        EXPECT_GE((sample.position[i] - plane.point).dot(plane.normal), sample.radius[i] * (1 - 1e-9));
    }
  }
}

TEST(Packing, TooDenseAGasIsRefused) {
  EXPECT_REFUSED(2, base_scene(2, InitialKind::gas, 500, 0.7), "too dense for random insertion");
  EXPECT_REFUSED(3, base_scene(3, InitialKind::gas, 500, 0.5), "too dense for random insertion");
  Scene narrow = base_scene(2, InitialKind::gas, 1, 0.1);
  narrow.cell.size = {1, 10};
  EXPECT_REFUSED(2, narrow, "too narrow");
}

TEST(Packing, SameSeedSameBits) {
  Scene scene = base_scene(3, InitialKind::gas, 100, 0.25);
  scene.initial.speed = 1;
  const Sample<3> a = initial_sample<3>(scene), b = initial_sample<3>(scene);
  EXPECT_EQ(a.position, b.position);
  EXPECT_EQ(a.velocity, b.velocity);
  EXPECT_EQ(a.radius, b.radius);
  scene.seed = 2;
  const Sample<3> c = initial_sample<3>(scene);
  EXPECT_NE(a.position, c.position);
  EXPECT_NE(a.velocity, c.velocity);
  EXPECT_NE(a.radius, c.radius);
}

// A grain's diameter belongs to its own stream: it does not depend on how many others are drawn.
TEST(Packing, DiametersFollowTheDistribution) {
  Scene scene = base_scene(2, InitialKind::gas, 1, 0.2);
  const std::vector<double> many = draw_diameters(scene, 20000), few = draw_diameters(scene, 10);
  EXPECT_TRUE(std::equal(few.begin(), few.end(), many.begin()));
  double sum = 0, squares = 0;
  for (double d : many) {
    EXPECT_GE(d, 1.2);
    EXPECT_LE(d, 1.8);
    sum += d / 20000;
    squares += (d - 1.5) * (d - 1.5) / 20000;
  }
  EXPECT_NEAR(sum, 1.5, 5 * 0.6 / std::sqrt(12.0 * 20000));
  EXPECT_NEAR(std::sqrt(squares), 0.6 / std::sqrt(12.0), 0.003);

  scene.grains.diameter.kind = SizeKind::discrete;
  scene.grains.diameter.diameters = {1, 2, 3};
  scene.grains.diameter.fractions = {0.5, 0.2, 0.3};
  int counts[4] = {};
  for (double d : draw_diameters(scene, 20000)) ++counts[static_cast<int>(d)];
  EXPECT_NEAR(counts[1] / 20000.0, 0.5, 5 * std::sqrt(0.25 / 20000));
  EXPECT_NEAR(counts[2] / 20000.0, 0.2, 5 * std::sqrt(0.16 / 20000));
  EXPECT_NEAR(counts[3] / 20000.0, 0.3, 5 * std::sqrt(0.21 / 20000));
  scene.grains.diameter.fractions = {1};
  EXPECT_THROW(draw_diameters(scene, 1), InputError);
  scene.grains.diameter.kind = SizeKind::monodisperse;
  EXPECT_EQ(draw_diameters(scene, 3), (std::vector<double>{1.5, 1.5, 1.5}));
}

TEST(Packing, VelocitiesHaveTheSpeedAndNoMomentum) {
  Scene scene = base_scene(2, InitialKind::gas, 4000, 0.2);
  EXPECT_EQ(initial_sample<2>(scene).velocity[0], Vec<2>(0, 0));
  scene.initial.speed = 0.8;
  const Sample<2> sample = initial_sample<2>(scene);
  Vec<2> momentum = Vec<2>::Zero(), squares = Vec<2>::Zero();
  for (int i = 0; i < sample.count(); ++i) {
    momentum += sample.mass[i] * sample.velocity[i];
    squares += sample.velocity[i].cwiseAbs2() / sample.count();
  }
  EXPECT_LT(momentum.norm(), 1e-11);
  for (int a = 0; a < 2; ++a) EXPECT_NEAR(std::sqrt(squares[a]), 0.8, 5 * 0.8 / std::sqrt(2.0 * 4000));
}

TEST(Packing, MassesComeFromDensityOrMeanGrain) {
  Scene scene = base_scene(3, InitialKind::gas, 20, 0.1);
  Sample<3> sample = initial_sample<3>(scene);  // a grain of the mean diameter 1.5 would have mass 1
  for (int i = 0; i < 20; ++i) EXPECT_NEAR(sample.mass[i], std::pow(sample.radius[i] / 0.75, 3), 1e-12);
  scene.grains.mass = 7;
  EXPECT_NEAR(initial_sample<3>(scene).mass[3], 7 * sample.mass[3], 1e-12);
  scene.grains.mass.reset();
  scene.grains.density = 2;
  EXPECT_NEAR(initial_sample<3>(scene).mass[3], 2 * grain_volume<3>(2 * sample.radius[3]), 1e-12);
}

TEST(Packing, Lattice) {
  for (const int count : {1, 64, sanitized ? 216 : 1000}) {
    expect_sound<2>(base_scene(2, InitialKind::lattice, count, 0.45));
    expect_sound<3>(base_scene(3, InitialKind::lattice, count, 0.3));
  }
  for (const int count : {2, 7, 11}) {  // these fill no square: vacant sites cost density
    expect_sound<2>(base_scene(2, InitialKind::lattice, count, 0.2));
    expect_sound<3>(base_scene(3, InitialKind::lattice, count, 0.06));
  }
  Scene long_cell = base_scene(2, InitialKind::lattice, 90, 0.4);
  long_cell.cell.aspect = {10, 1};
  expect_sound<2>(long_cell);
  EXPECT_REFUSED(2, base_scene(2, InitialKind::lattice, 100, 0.7), "a lattice of 100 grains");
}

// The densest square and cubic lattices: grains touch, and are not shaken.
TEST(Packing, DensestLattice) {
  Scene scene = base_scene(2, InitialKind::lattice, 100, pi / 4);
  scene.grains.diameter.kind = SizeKind::monodisperse;
  expect_sound<2>(scene);
  Scene cube = base_scene(3, InitialKind::lattice, 64, pi / 6);
  cube.grains.diameter.kind = SizeKind::monodisperse;
  expect_sound<3>(cube);
}

TEST(Packing, LatticeIsShakenALittle) {
  Scene scene = base_scene(2, InitialKind::lattice, 100, 0.5);
  const Sample<2> sample = initial_sample<2>(scene);
  const double spacing = sample.cell.box(0, 0) / 10;
  std::set<double> offsets;
  for (const Vec<2>& x : sample.position) {
    const double offset = x.x() / spacing - 0.5 - std::round(x.x() / spacing - 0.5);
    EXPECT_LT(std::abs(offset) * spacing, 0.0181);
    offsets.insert(offset);
  }
  EXPECT_GT(offsets.size(), 95u);
}

Scene listed_scene() {
  Scene scene;
  scene.dimension = 2;
  scene.initial.kind = InitialKind::listed;
  scene.cell.size = {4, 6};
  scene.grains.listed = {{{1, 1}, {}, {}, 1}, {{5.5, -1}, {0.5, 0.25}, {3}, 2}};
  return scene;
}

TEST(Packing, ListedGrains) {
  const Sample<2> sample = initial_sample<2>(listed_scene());
  ASSERT_EQ(sample.count(), 2);
  EXPECT_EQ(sample.position[0], Vec<2>(1, 1));
  EXPECT_EQ(sample.position[1], Vec<2>(1.5, 5)) << "wrapped into the cell";
  EXPECT_EQ(sample.velocity[1], Vec<2>(0.5, 0.25));
  EXPECT_EQ(sample.spin[1], 3);
  EXPECT_EQ(sample.radius[1], 1);
  EXPECT_NEAR(sample.mass[0], 1 / 2.25, 1e-15);  // d = 1.5, the mean of the two
  EXPECT_NEAR(sample.mass[1], 4 / 2.25, 1e-15);

  Scene free = listed_scene();
  free.cell.size.clear();
  free.cell.periodic = {false, false};
  const Sample<2> outside = initial_sample<2>(free);
  EXPECT_EQ(outside.position[1], Vec<2>(5.5, -1));
  EXPECT_EQ(outside.cell.box(0, 0), 6.5);
}

TEST(Packing, ListedGrainsThatCanNotBe) {
  Scene scene = listed_scene();
  scene.grains.listed.push_back({{1, 1.999}, {}, {}, 1});
  EXPECT_REFUSED(2, scene, "grains 1 and 3 overlap");
  scene.grains.listed[2].position = {1, 2};  // touching is allowed
  EXPECT_EQ(refusal<2>(scene), "");
  scene.grains.listed[2].position = {1, 0.0001};  // overlaps the second grain's image below
  EXPECT_REFUSED(2, scene, "overlap");
  scene = listed_scene();
  scene.planes = {{{0, 0.6}, {0, 1}, {}}};
  EXPECT_REFUSED(2, scene, "grain 1 crosses plane 1");
  scene = listed_scene();
  scene.grains.listed[1].position = {1, 2, 3};
  EXPECT_REFUSED(2, scene, "grain 2, position: expected 2 components, found 3");
  scene = listed_scene();
  scene.cell.size.clear();
  EXPECT_REFUSED(2, scene, "cell.size");
  scene = listed_scene();
  scene.grains.listed[0].diameter = 4.1;
  EXPECT_REFUSED(2, scene, "overlaps its own image");
}

Scene packing_scene(int dim, const TemporaryFolder& folder, const std::string& file) {
  Scene scene;
  scene.dimension = dim;
  scene.initial.kind = InitialKind::packing;
  scene.initial.file = file;
  scene.directory = folder.path();
  return scene;
}

TEST(Packing, CsvRoundTripKeepsEveryBit) {
  const TemporaryFolder folder;
  Scene gas = base_scene(3, InitialKind::gas, 50, 0.2);
  gas.initial.speed = 0.3;
  gas.cell.periodic = {true, false, true};
  Sample<3> sample = initial_sample<3>(gas);
  sample.cell.box(0, 1) = 0.1;
  for (int i = 0; i < 50; ++i) sample.spin[i] = Vec<3>(i, -0.1 * i, 1.0 / (i + 1));
  write_packing_csv<3>(folder.file("a.csv"), sample);
  const Sample<3> back = initial_sample<3>(packing_scene(3, folder, "a.csv"));
  EXPECT_EQ(back.cell.box, sample.cell.box);
  EXPECT_EQ(back.cell.periodic, sample.cell.periodic);
  EXPECT_EQ(back.velocity, sample.velocity);
  EXPECT_EQ(back.spin, sample.spin);
  EXPECT_EQ(back.radius, sample.radius);
  EXPECT_EQ(back.mass, sample.mass);
  const PackingFile<3> raw = read_packing_csv<3>(folder.file("a.csv"));
  EXPECT_EQ(raw.sample.position, sample.position);
}

TEST(Packing, CsvWithoutCell) {
  const TemporaryFolder folder;
  put_bytes(folder.file("a.csv"), "diameter,y,x\n1,0.5,3.5\n1,2.5,-0.5\n");
  Scene scene = packing_scene(2, folder, "a.csv");
  EXPECT_REFUSED(2, scene, "cell.size");
  scene.cell.size = {4, 4};
  const Sample<2> sample = initial_sample<2>(scene);
  EXPECT_EQ(sample.position[0], Vec<2>(3.5, 0.5));
  EXPECT_EQ(sample.position[1], Vec<2>(3.5, 2.5));
  EXPECT_EQ(sample.mass[0], 1);
  scene.initial.speed = 1;
  EXPECT_NE(initial_sample<2>(scene).velocity[0], Vec<2>(0, 0));
}

TEST(Packing, MistakesInPackingFiles) {
  const TemporaryFolder folder;
  const auto refusal_of = [&](const std::string& text) {
    put_bytes(folder.file("a.csv"), text);
    std::string message = refusal<2>(packing_scene(2, folder, "a.csv"));
    return message.starts_with(folder.path()) ? message.substr(folder.path().size() + 1) : message;
  };
  const std::string head = "# cell: 4 0 0 4\n";
  EXPECT_EQ(refusal_of(head + "x,y,diameter\n1,1,1\n"), "");
  EXPECT_EQ(refusal_of(head + "x,y,diameter\n1,1,-1\n"), "a.csv:3:5: error: the diameter must be above 0");
  EXPECT_EQ(refusal_of(head + "x,y,diameter\n1,nan,1\n"), "a.csv:3:3: error: expected a finite number");
  EXPECT_EQ(refusal_of(head + "x,y\n1,1\n"), "a.csv: error: a packing in 2D needs the columns x,y,diameter");
  EXPECT_EQ(refusal_of(head + "x,y,diameter,vx\n1,1,1,0\n"), "a.csv: error: the columns vx, vy go together");
  EXPECT_EQ(refusal_of(head + "x,y,diameter,z\n1,1,1,0\n"),
            "a.csv:2:14: error: unknown column 'z'; known in 2D: x, y, vx, vy, wz, diameter, mass, material");
  EXPECT_EQ(refusal_of(head + "x,y,diameter\n"), "a.csv: error: the packing has no grains");
  EXPECT_EQ(refusal_of("# cell: 4 0 0\nx,y,diameter\n1,1,1\n"),
            "a.csv: error: the comment 'cell: 4 0 0' must hold 4 numbers after 'cell:'");
  EXPECT_EQ(refusal_of("# cell: 0 4 4 0\nx,y,diameter\n1,1,1\n"),
            "a.csv: error: the cell vectors must span a volume above 0 (right-handed)");
  EXPECT_EQ(refusal_of(head + "x,y,diameter\n1,1,1\n3,3,1\n1,1,1\n"), "error: grains 1 and 3 overlap");
  EXPECT_EQ(refusal_of(head + "x,y,diameter\n1,1,1\n1.9,1,1\n"), "") << "soft grains under load overlap a little";
  Scene scene = packing_scene(2, folder, "a.csv");
  scene.cell.size = {4, 4};
  EXPECT_REFUSED(2, scene, "brings its own cell");
  EXPECT_REFUSED(2, packing_scene(2, folder, "absent.csv"), "No such file");
  EXPECT_REFUSED(2, packing_scene(2, folder, "a.txt"), "must end in .csv");
}

/// Grains that come one after the other are near each other: the mean distance of successive grains in a gas of n
/// grains per unit volume is some n^(-1/D) along the curve, and half of the cell's edge (12 n^(-1/D) here) in random
/// order.
template <int D>
double mean_step(int count) {
  const Sample<D> gas = initial_sample<D>(base_scene(D, InitialKind::gas, count, 0.2));
  const Mat<D> inverse = gas.cell.box.inverse();
  double sum = 0;
  for (int k = 1; k < count; ++k) {
    Vec<D> step = inverse * (gas.position[k] - gas.position[k - 1]);
    for (int a = 0; a < D; ++a) step[a] -= std::round(step[a]);
    sum += (gas.cell.box * step).norm();
  }
  return sum / (count - 1) / std::pow(gas.cell.volume() / count, 1.0 / D);
}

TEST(Packing, GasIsNumberedAlongACurve) {
  EXPECT_LT(mean_step<2>(600), 2.5);
  EXPECT_LT(mean_step<3>(1800), 2.5);
}

TEST(Packing, LammpsFile) {
  const TemporaryFolder folder;
  Scene gas = base_scene(2, InitialKind::gas, 30, 0.3);
  gas.grains.density = 3;
  const Sample<2> sample = initial_sample<2>(gas);
  write_lammps_data<2>(folder.file("a.data"), sample);
  Scene scene = packing_scene(2, folder, "a.data");
  const Sample<2> back = initial_sample<2>(scene);
  EXPECT_EQ(back.position, sample.position);
  for (int i = 0; i < 30; ++i) EXPECT_DOUBLE_EQ(back.mass[i], sample.mass[i]);
  scene.grains.density = 1;
  EXPECT_NEAR(initial_sample<2>(scene).mass[0], sample.mass[0] / 3, 1e-12);
}

}  // namespace
}  // namespace galet::test::packing_test
