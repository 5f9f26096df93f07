// LAMMPS data files: small texts with every feature, mistakes with their places, and the packings that LAMMPS itself
// made, whose coordination and pressure are known.
#include "common/io/lammps.hpp"

#include <cstdlib>
#include <filesystem>
#include <numbers>

#include <gtest/gtest.h>

#include "common/core/error.hpp"
#include "common/core/random.hpp"
#include "common/io/particle_text.hpp"
#include "common/measure/coordination.hpp"
#include "common/measure/numbers.hpp"
#include "common/measure/stress.hpp"
#include "tests/support/brute_force.hpp"
#include "tests/support/other_programs.hpp"
#include "tests/support/temporary_folder.hpp"

namespace galet::test::lammps_test {
namespace {

using test::TemporaryFolder;
constexpr double pi = std::numbers::pi;

constexpr std::string_view tilted = R"(a title, even one like: Atoms

 2 atoms      # a comment
1 atom types
0 bonds
-1 3 xlo xhi
0.5 2.5 ylo yhi
0 +5 zlo zhi
1 0.25 -0.5 xy xz yz

Velocities

7 1 2 3 4 5 6
3 -1 0 0 0 0 0   # of the other one

Masses

1 1.0

Pair Coeffs # gran/hooke

1 2

Atoms # sphere

7 1 2.0 3.0 -0.5 1.5 2 0 0 1
3 1 1.0 6.0 -1.5 0.25 0
)";

TEST(Lammps, ReadsAllOfATiltedBox) {
  const Sample<3> sample = parse_lammps_data<3>(tilted, "f.data");
  ASSERT_EQ(sample.count(), 2);
  Mat<3> box;
  box << 4, 1, 0.25, 0, 2, -0.5, 0, 0, 5;
  EXPECT_EQ(sample.cell.box, box);
  EXPECT_EQ(sample.cell.periodic, (std::array{true, true, true}));
  // Order of the ids: 3, then 7. From the corner, atom 3 lies at (-0.5, -0.25, 0): s = (-0.09, -0.125, 0), so it moves
  // by the first two cell vectors; atom 7 at (0.5, 1, 2): s = (-0.05, 0.6, 0.4), so it moves by the first.
  EXPECT_EQ(sample.position[0], Vec<3>(4.5, 1.75, 0));
  EXPECT_EQ(sample.position[1], Vec<3>(4.5, 1, 2));
  EXPECT_EQ(sample.velocity[0], Vec<3>(-1, 0, 0));
  EXPECT_EQ(sample.velocity[1], Vec<3>(1, 2, 3));
  EXPECT_EQ(sample.spin[1], Vec<3>(4, 5, 6));
  EXPECT_EQ(sample.radius[0], 0.5);
  EXPECT_DOUBLE_EQ(sample.mass[0], pi);
  EXPECT_DOUBLE_EQ(sample.mass[1], 3 * pi * 8 / 6);
}

TEST(Lammps, TwoDimensionsIgnoreZ) {
  const Sample<2> sample = parse_lammps_data<2>(tilted, "f.data", {false, false});
  Mat<2> box;
  box << 4, 1, 0, 2;
  EXPECT_EQ(sample.cell.box, box);
  EXPECT_EQ(sample.position[0], Vec<2>(-0.5, -0.25)) << "directions that are not periodic are left alone";
  EXPECT_EQ(sample.spin[1], 6);
  EXPECT_DOUBLE_EQ(sample.mass[0], 6 * pi / 4) << "density times the area of the disk";
}

std::string refusal(std::string text) {
  try {
    parse_lammps_data<3>(text, "f");
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

/// The text above with one piece of it replaced.
std::string with(const std::string& piece, const std::string& replacement) {
  std::string text(tilted);
  const std::size_t place = text.find(piece);
  if (place == std::string::npos) throw std::logic_error("no such piece: " + piece);
  return text.replace(place, piece.size(), replacement);
}

TEST(Lammps, MistakesHaveTheirPlace) {
  EXPECT_EQ(refusal(std::string(tilted)), "");
  EXPECT_EQ(refusal(""), "f: error: the file is empty");
  EXPECT_EQ(refusal(with("2.0 3.0", "x 3.0")), "f:26:5: error: expected a finite number, found 'x'");
  EXPECT_EQ(refusal(with("2.0 3.0", "nan 3.0")), "f:26:5: error: expected a finite number, found 'nan'");
  EXPECT_EQ(refusal(with("2.0 3.0", "0 3.0")), "f:26:5: error: a diameter must be above 0");
  EXPECT_EQ(refusal(with("2.0 3.0", "2.0 -3")), "f:26:9: error: a density must be above 0");
  EXPECT_EQ(refusal(with("2 0 0 1", "2 0 0")),
            "f:26:1: error: expected 'id type diameter density x y z [ix iy iz]', found 9 values");
  EXPECT_EQ(refusal(with("3 1 1.0", "7 1 1.0")), "f:27:1: error: the atom 7 appears twice");
  EXPECT_EQ(refusal(with("3 1 1.0", "3.5 1 1.0")), "f:27:1: error: expected a whole number, found '3.5'");
  EXPECT_EQ(refusal(with("3 -1 0 0", "4 -1 0 0")), "f:14:1: error: there is no atom 4");
  EXPECT_EQ(refusal(with("7 1 2 3 4 5 6", "  7 1 2 3")),
            "f:13:3: error: expected 'id vx vy vz wx wy wz', found 4 values");
  EXPECT_EQ(refusal(with("-1 3 xlo", "-1 -1 xlo")), "f:6:4: error: xhi must be above xlo");
  EXPECT_EQ(refusal(with("0.5 2.5 ylo yhi", "")), "f: error: the file does not give the box along y");
  EXPECT_EQ(refusal(with("2 atoms", "3 atoms")), "f: error: the file announces 3 atoms and has 2");
  EXPECT_EQ(refusal(with(" 2 atoms", "")), "f: error: the file does not say how many atoms it has ('N atoms')");
  EXPECT_EQ(refusal(with("# sphere", "# atomic")),
            "f:24:7: error: the atom style 'atomic' is not supported: use sphere");
  EXPECT_EQ(refusal(with("Masses", "Bonds")),
            "f:16:1: error: the section 'Bonds' is not supported: expected Atoms or Velocities");
  EXPECT_EQ(refusal("t\n1 atoms\n0 1 xlo xhi\n"), "f: error: the file has no section 'Atoms'");
}

template <int D>
Sample<D> random_sample() {
  Sample<D> sample;
  sample.cell.box = Vec<D>::LinSpaced(3, 5).asDiagonal();
  sample.cell.box(0, 1) = -0.7;
  sample.cell.box(D - 2, D - 1) = 0.3;
  sample.cell.periodic.fill(true);
  sample.resize(50);
  for (int i = 0; i < sample.count(); ++i) {
    RandomStream random(1, i);
    Vec<D> s;
    for (int a = 0; a < D; ++a) s[a] = random.uniform(), sample.velocity[i][a] = random.normal();
    sample.position[i] = sample.cell.box * s;
    sample.radius[i] = random.uniform(0.1, 0.9);
    sample.mass[i] = random.uniform(0.1, 0.9);
    if constexpr (D == 2)
      sample.spin[i] = random.normal();
    else
      sample.spin[i] = Vec<3>(random.normal(), random.normal(), random.normal());
  }
  return sample;
}

template <int D>
void expect_round_trip() {
  const TemporaryFolder folder;
  const Sample<D> sample = random_sample<D>();
  write_lammps_data<D>(folder.file("a.data"), sample);
  const Sample<D> back = read_lammps_data<D>(folder.file("a.data"));
  EXPECT_EQ(back.cell.box, sample.cell.box);
  EXPECT_EQ(back.position, sample.position);
  EXPECT_EQ(back.velocity, sample.velocity);
  EXPECT_EQ(back.spin, sample.spin);
  EXPECT_EQ(back.radius, sample.radius);
  for (int i = 0; i < sample.count(); ++i)  // the file holds the density: one rounding each way
    EXPECT_DOUBLE_EQ(back.mass[i], sample.mass[i]);

  Sample<D> turned = sample;
  turned.cell.box(1, 0) = 0.1;
  EXPECT_THROW(write_lammps_data<D>(folder.file("b.data"), turned), std::invalid_argument);
  EXPECT_THROW(read_lammps_data<D>(folder.file("absent.data")), InputError);
}

TEST(Lammps, RoundTrip2D) { expect_round_trip<2>(); }
TEST(Lammps, RoundTrip3D) { expect_round_trip<3>(); }

// LAMMPS itself reads the data file and writes what it read, in 17 digits; then it reads that back as our own dump.
TEST(Lammps, IsReadByLammps) {
  const TemporaryFolder folder;
  const Sample<3> sample = random_sample<3>();
  const ContactColumns<3> none;
  write_lammps_data<3>(folder.file("a.data"), sample);
  write_file(folder.file("a.dump"), lammps_dump(snapshot_of(sample, none), 42));
  const std::string head = "units lj\natom_style sphere\nboundary p p p\ncomm_modify cutoff 2\nread_data a.data\n";
  const std::string columns =
      "id type diameter mass x y z vx vy vz omegax omegay omegaz modify sort id format float %.17g\n";
  if (!run_lammps(head + "write_dump all custom read.txt " + columns +
                      "set group all x 0.1 y 0.1 z 0.1 vx 0 vy 0 vz 0\n"
                      "read_dump a.dump 42 x y z vx vy vz box yes\nwrite_dump all custom dump.txt " +
                      columns,
                  folder))
    GTEST_SKIP() << "lammps is not installed: LAMMPS did not read the files";
  for (const char* file : {"read.txt", "dump.txt"}) {
    std::istringstream text(read_file(folder.file(file)));
    std::string line;
    for (int k = 0; k < 5; ++k) std::getline(text, line);
    EXPECT_EQ(line, "ITEM: BOX BOUNDS xy xz yz pp pp pp");
    for (int k = 0; k < 4; ++k) std::getline(text, line);
    const Mat<3> inverse = sample.cell.box.inverse();
    for (int i = 0; i < sample.count(); ++i) {
      double id, type, diameter, mass;
      Vec<3> x, v, w;
      text >> id >> type >> diameter >> mass >> x[0] >> x[1] >> x[2] >> v[0] >> v[1] >> v[2] >> w[0] >> w[1] >> w[2];
      ASSERT_TRUE(text) << file << ", grain " << i;
      EXPECT_EQ(id, i + 1);
      EXPECT_EQ(type, 1);
      EXPECT_EQ(v, sample.velocity[i]) << file;
      EXPECT_EQ(w, sample.spin[i]);
      EXPECT_DOUBLE_EQ(diameter, 2 * sample.radius[i]);
      EXPECT_DOUBLE_EQ(mass, sample.mass[i]);
      // LAMMPS wraps positions by way of fractions of the cell: some roundings of lengths of 5.
      const Vec<3> moved = inverse * (x - sample.position[i]);
      for (int a = 0; a < 3; ++a) EXPECT_NEAR(moved[a], std::round(moved[a]), 1e-14) << file;
    }
  }
}

/// Path of a shared packing, or nothing when this machine does not have them.
std::string shared_packing(const std::string& name) {
  const char* set = std::getenv("GALET_SHARED");
  const std::filesystem::path folder = set != nullptr ? set : std::filesystem::path(GALET_SOURCE_DIR) / "../shared";
  const std::filesystem::path path = folder / "packings" / name;
  return std::filesystem::exists(path) ? path.string() : "";
}

/// z, and the pressure of the linear law F_N = h (K_N = 1). Tangential forces add nothing to the trace of sigma.
template <int D>
void expect_packing(const std::string& name, int count, double phi, double z, double pressure) {
  const std::string path = shared_packing(name);
  if (path.empty()) GTEST_SKIP() << name << " is not here: set GALET_SHARED to the folder that has packings/";
  const Sample<D> sample = read_lammps_data<D>(path);
  EXPECT_EQ(sample.count(), count);
  const ContactColumns<D> contacts =
      test::brute_force_contacts<D>(sample, 0, [](int, int, double gap) { return -gap; });
  const Snapshot<D> snapshot = test::snapshot_of(sample, contacts);
  if (phi > 0) {
    EXPECT_NEAR(solid_fraction(snapshot), phi, 0.0005);
  }
  EXPECT_NEAR(coordination(snapshot, true).z, z, 0.005);
  EXPECT_NEAR(mean_pressure<D>(stress(snapshot).total()) / pressure, 1, 0.04);
}

// Numbers of the README beside the packings.
TEST(Lammps, PackingOfSpheresMadeByLammps) { expect_packing<3>("pack4k_hooke.data", 4096, 0.624, 5.35, 1.03e-4); }
TEST(Lammps, PackingOfDisksMadeByLammps) { expect_packing<2>("pack2d.data", 2025, 0, 3.55, 1.5e-4); }

}  // namespace
}  // namespace galet::test::lammps_test
