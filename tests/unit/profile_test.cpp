// Profiles across layers and rings against closed forms: affine flows, lattices, single grains cut by faces.
#include "common/measure/profile.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "common/core/random.hpp"
#include "common/measure/grain_cuts.hpp"
#include "common/measure/numbers.hpp"
#include "common/measure/radial_profile.hpp"
#include "common/measure/stress.hpp"
#include "tests/support/lattices.hpp"

namespace galet::test::profile_test {
namespace {

using test::cubic, test::face_centred, test::snapshot_of, test::square;
constexpr double pi = std::numbers::pi, diameter = test::lattice_diameter;

TEST(Profile, AffineFlowOfALattice) {
  Sample<2> sample = square(8);
  for (Vec<2>& x : sample.position) x += Vec<2>(0.1, diameter / 2);  // one row in the middle of each of 8 layers
  sample.cell.rate(0, 1) = 0.6;
  const ContactColumns<2> none;
  const std::vector<ProfileRow> rows = layer_profile(snapshot_of(sample, none), 8);
  ASSERT_EQ(rows.size(), 8u);
  for (int k = 0; k < 8; ++k) {
    EXPECT_NEAR(rows[k].position, (k + 0.5) * diameter, 1e-13);
    EXPECT_NEAR(rows[k].velocity.x(), 0.6 * rows[k].position, 1e-13);
    EXPECT_EQ(rows[k].grains, 8);
    EXPECT_EQ(rows[k].fluctuation, 0);
    EXPECT_NEAR(rows[k].solid_fraction, pi / 4, 1e-13);
  }
}

// Moving grains by whole cell vectors, or writing the cell in an equivalent tilted form, changes nothing.
TEST(Profile, DoesNotDependOnTheImage) {
  Sample<3> sample;
  sample.resize(60);
  sample.cell.box << 4, 1, 0, 0, 5, 0, 0, 0, 3;
  sample.cell.rate(0, 1) = 0.3;
  sample.cell.periodic.fill(true);
  for (int i = 0; i < sample.count(); ++i) {
    RandomStream random(5, i);
    sample.position[i] = sample.cell.box * Vec<3>(random.uniform(), random.uniform(), random.uniform());
    sample.velocity[i] = Vec<3>(random.normal(), random.normal(), random.normal());
    sample.radius[i] = random.uniform(0.2, 0.9);
  }
  Sample<3> moved = sample;
  moved.cell.box.col(1) -= 2 * moved.cell.box.col(0);
  for (int i = 0; i < moved.count(); ++i) moved.position[i] += sample.cell.box * Vec<3>(i % 3 - 1, i % 5 - 2, -(i % 2));
  const ContactColumns<3> none;
  const std::vector<ProfileRow> a = layer_profile(snapshot_of(sample, none), 7);
  const std::vector<ProfileRow> b = layer_profile(snapshot_of(moved, none), 7);
  double phi = 0;
  for (int k = 0; k < 7; ++k) {
    EXPECT_EQ(a[k].grains, b[k].grains);
    EXPECT_NEAR(a[k].velocity.x(), b[k].velocity.x(), 1e-13);
    EXPECT_NEAR(a[k].fluctuation, b[k].fluctuation, 1e-13);
    EXPECT_NEAR(a[k].solid_fraction, b[k].solid_fraction, 1e-13);
    phi += a[k].solid_fraction / 7;
  }
  EXPECT_NEAR(phi, solid_fraction(snapshot_of(sample, none)), 1e-13);
}

// A grain on the border between two layers is half in each; a sphere cut at R/2 leaves a cap of 5/32 of its volume.
TEST(Profile, CutsGrainsAtTheFacesOfALayer) {
  Sample<2> disk;
  disk.resize(1);
  disk.cell.box = 4 * Mat<2>::Identity();
  disk.cell.periodic = {true, true};
  const ContactColumns<2> none2;
  const std::vector<ProfileRow> halves = layer_profile(snapshot_of(disk, none2), 4);  // the disk sits at y = 0
  EXPECT_NEAR(halves[0].solid_fraction, pi / 8 / 4, 1e-14);
  EXPECT_NEAR(halves[3].solid_fraction, pi / 8 / 4, 1e-14);
  EXPECT_EQ(halves[1].solid_fraction, 0);
  EXPECT_EQ(halves[0].grains + halves[3].grains, 1);

  Sample<3> ball;
  ball.resize(1);
  ball.radius[0] = 1;
  ball.position[0] = Vec<3>(1, 2.5, 1);  // the layer's face at y = 3 cuts it at R/2
  ball.cell.box = 6 * Mat<3>::Identity();
  const ContactColumns<3> none3;
  const std::vector<ProfileRow> cut = layer_profile(snapshot_of(ball, none3), 2);
  EXPECT_NEAR(cut[1].solid_fraction, 5.0 / 32 * (4 * pi / 3) / 108, 1e-14);
  EXPECT_NEAR(cut[0].solid_fraction, 27.0 / 32 * (4 * pi / 3) / 108, 1e-14);
}

TEST(Profile, FluctuationIsPerComponentAboutTheMean) {
  Sample<2> sample = square(4);
  for (Vec<2>& x : sample.position) x.y() += 0.1;
  for (int i = 0; i < sample.count(); ++i) sample.velocity[i] = Vec<2>(5 + (i % 2 == 0 ? 0.3 : -0.3), 0);
  const ContactColumns<2> none;
  for (const ProfileRow& row : layer_profile(snapshot_of(sample, none), 4)) {
    EXPECT_NEAR(row.velocity.x(), 5, 1e-14);
    EXPECT_NEAR(row.fluctuation, 0.3 / std::sqrt(2), 1e-14);
  }
}

// In a periodic cell the flow goes on through its faces: the rate is the affine one in every layer, end layers
// included, and in a cell that is tilted.
TEST(Profile, ShearRateOfAnAffineFlow) {
  Sample<3> sample = cubic(6);
  sample.cell.box.col(1) += 0.4 * sample.cell.box.col(0);
  for (int i = 0; i < sample.count(); ++i) sample.position[i] += Vec<3>::Constant(0.02 * (i % 7));
  sample.cell.rate << 0, 0.7, 0, 0, -0.2, 0, 0, 0.1, 0;
  const ContactColumns<3> none;
  for (const ProfileRow& row : layer_profile(snapshot_of(sample, none), 6))
    EXPECT_LT((row.shear_rate - Vec<3>(0.7, -0.2, 0.1)).norm(), 1e-12);
  sample.cell.periodic.fill(false);
  for (const ProfileRow& row : layer_profile(snapshot_of(sample, none), 6))
    EXPECT_LT((row.shear_rate - Vec<3>(0.7, -0.2, 0.1)).norm(), 1e-12);
}

TEST(Profile, ShearRateOfAParabolicFlow) {
  Sample<2> sample = square(8);
  for (Vec<2>& x : sample.position) x.y() += diameter / 2;
  sample.cell.periodic = {true, false};
  for (int i = 0; i < sample.count(); ++i)
    sample.velocity[i] = Vec<2>(sample.position[i].y() * sample.position[i].y(), 0);
  const ContactColumns<2> none;
  const std::vector<ProfileRow> rows = layer_profile(snapshot_of(sample, none), 8);
  for (int k = 1; k < 7; ++k) EXPECT_NEAR(rows[k].shear_rate.x(), 2 * rows[k].position, 1e-12);  // central: exact
  EXPECT_NEAR(rows[0].shear_rate.x(), 2 * diameter, 1e-12);  // one-sided: the rate between the first two layers
}

// Contact stress is shared by length: its mean over the layers is the stress of the sample, whichever way they lie.
TEST(Profile, StressOfTheLayersAddsUp) {
  const Sample<3> sample = face_centred(3);
  ContactColumns<3> contacts = test::touching(sample);
  for (std::size_t c = 0; c < contacts.size(); ++c)
    contacts.force[c] = Vec<3>(std::sin(1.0 * static_cast<double>(c)), 0.3, 1) + contacts.normal[c];
  const Snapshot<3> snapshot = snapshot_of(sample, contacts);
  const Mat<3> whole = stress(snapshot).contact;
  for (int direction = 0; direction < 3; ++direction) {
    Mat<3> sum = Mat<3>::Zero();
    const int layers = 7;
    for (const ProfileRow& row : layer_profile(snapshot, layers, direction)) sum += row.stress / layers;
    EXPECT_LT((sum - whole).norm(), 1e-12 * whole.norm());
  }
}

// The same force in each contact of a square lattice: every layer, however thin, has the pressure of the sample.
TEST(Profile, StressIsUniformInALattice) {
  const Sample<2> sample = square(4);
  const ContactColumns<2> contacts = test::touching(sample);
  const Snapshot<2> snapshot = snapshot_of(sample, contacts);
  const double pressure = stress(snapshot).contact(1, 1);
  for (const ProfileRow& row : layer_profile(snapshot, 13)) EXPECT_NEAR(row.stress(1, 1), pressure, 1e-12 * pressure);
}

TEST(Profile, TemperatureIsMassTimesTheSquareOfTheFluctuation) {
  Sample<2> sample = square(4);
  for (Vec<2>& x : sample.position) x.y() += 0.1;
  sample.mass.assign(sample.count(), 3);
  for (int i = 0; i < sample.count(); ++i) sample.velocity[i] = Vec<2>(5 + (i % 2 == 0 ? 0.3 : -0.3), 0);
  const ContactColumns<2> none;
  for (const ProfileRow& row : layer_profile(snapshot_of(sample, none), 4)) {
    EXPECT_NEAR(row.temperature, 3 * 0.09 / 2, 1e-14);
    EXPECT_NEAR(row.stress(0, 0), 4 * 3 * 0.09 / (4 * diameter * diameter), 1e-13);  // four grains in a layer
    EXPECT_NEAR(row.stress(1, 1), 0, 1e-14);
  }
}

// ---- cuts of grains and rings -------------------------------------------------------------------------------

// A sphere on the axis of a cylinder of radius r < R: 4 pi / 3 (R^3 - (R^2 - r^2)^(3/2)); far inside and outside, all
// and nothing; a disk whose edge passes the axis at distance r = c = R: the lens of two equal circles,
// R^2 (2 pi / 3 - sqrt(3) / 2).
TEST(GrainCuts, ClosedForms) {
  for (const double r : {0.1, 0.5, 0.9, 0.999})
    EXPECT_NEAR(volume_within<3>(2 * r, 0, 2), 4 * pi / 3 * 8 * (1 - std::pow(1 - r * r, 1.5)), 1e-9);
  EXPECT_DOUBLE_EQ(volume_within<3>(5, 2, 1.5), 4 * pi / 3 * std::pow(1.5, 3));
  EXPECT_EQ(volume_within<3>(1, 3, 1.5), 0);
  EXPECT_NEAR(volume_within<2>(2, 2, 2), 4 * (2 * pi / 3 - std::sqrt(3.0) / 2), 1e-13);
  EXPECT_DOUBLE_EQ(volume_within<2>(0.5, 0.2, 2), pi * 0.25);
}

// A wide cylinder is nearly a plane: the part within reach is the part below, to the first order in R / reach.
TEST(GrainCuts, AWideCylinderCutsLikeAPlane) {
  const double reach = 1e5, radius = 0.8;
  for (const double t : {-0.7, -0.2, 0.0, 0.3, 0.75}) {
    EXPECT_NEAR(volume_within<3>(reach, reach - t, radius), volume_below<3>(t, radius), 2e-5);
    EXPECT_NEAR(volume_within<2>(reach, reach - t, radius), volume_below<2>(t, radius), 2e-5);
  }
}

// Rigid rotation has no radial velocity; all matter is in some ring.
TEST(RadialProfile, RigidRotation) {
  Sample<2> sample = square(9);
  sample.cell.periodic.fill(false);
  const Vec<2> centre(4 * diameter, 4 * diameter);
  for (int i = 0; i < sample.count(); ++i) sample.velocity[i] = cross(0.4, Vec<2>(sample.position[i] - centre));
  const ContactColumns<2> none;
  const std::vector<RingRow> rows = radial_profile(snapshot_of(sample, none), centre, 0, 9 * diameter, 8);
  double matter = 0;
  int grains = 0;
  const double width = 9 * diameter / 8;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const double low = static_cast<double>(k) * width;
    matter += rows[k].solid_fraction * pi * ((low + width) * (low + width) - low * low);
    grains += rows[k].grains;
    EXPECT_NEAR(rows[k].velocity[0], 0, 1e-13);
  }
  EXPECT_EQ(grains, sample.count());
  EXPECT_NEAR(matter, sample.solid_volume(), 1e-12 * matter);
}

// Grains at the middles of rings that turn as v_theta = r^2: d v_theta / dr - v_theta / r = r, exactly by central
// differences; a rigid rotation has none.
TEST(RadialProfile, ShearRateOfRings) {
  const int rings = 6, around = 5;
  for (const double power : {1.0, 2.0}) {
    Sample<2> sample;
    sample.cell.box = 40 * Mat<2>::Identity();
    sample.resize(rings * around);
    const Vec<2> centre(20, 20);
    for (int i = 0; i < sample.count(); ++i) {
      const double r = 4.5 + i / around, angle = 0.3 + 2 * pi * (i % around) / around;
      const Vec<2> out(std::cos(angle), std::sin(angle));
      sample.position[i] = centre + r * out;
      sample.velocity[i] = std::pow(r, power) * Vec<2>(-out.y(), out.x());
    }
    const ContactColumns<2> none;
    const std::vector<RingRow> rows = radial_profile(snapshot_of(sample, none), centre, 4, 10, rings);
    for (int k = 1; k + 1 < rings; ++k) {
      EXPECT_EQ(rows[k].grains, around);
      EXPECT_NEAR(rows[k].velocity[1], std::pow(rows[k].position, power), 1e-12);
      EXPECT_NEAR(rows[k].shear_rate, power == 1 ? 0 : rows[k].position, 1e-12);
    }
  }
}

// Central forces on the spokes of a wheel, each of intensity F: 2 pi r sigma_rr = spokes * F at every radius (balance
// of an annulus), whatever the length of the contacts' branches; tangential forces give sigma_theta,r.
TEST(RadialProfile, StressOfSpokes) {
  Sample<3> sample;
  const int spokes = 8;
  sample.cell.box = Vec<3>(20, 20, 2).asDiagonal();
  sample.resize(2 * spokes);
  ContactColumns<3> contacts;
  for (int k = 0; k < spokes; ++k) {
    const double angle = 2 * pi * k / spokes + 0.1;
    const Vec<3> out(std::cos(angle), std::sin(angle), 0), across(-std::sin(angle), std::cos(angle), 0);
    sample.position[2 * k] = Vec<3>(10, 10, 1) + 2 * out;
    sample.position[2 * k + 1] = Vec<3>(10, 10, 1) + 7 * out;
    contacts.i.push_back(2 * k), contacts.j.push_back(2 * k + 1);
    contacts.normal.push_back(out), contacts.branch.push_back(5 * out),
        contacts.force.push_back(3 * out + 0.5 * across);
  }
  const std::vector<RingRow> rows = radial_profile(snapshot_of(sample, contacts), Vec<3>(10, 10, 0), 3, 6, 5);
  for (const RingRow& row : rows) {
    // Mean over the ring of F / (2 pi r depth): spokes F width / (2 pi r_middle width depth).
    EXPECT_NEAR(row.stress(0, 0), spokes * 3 / (2 * pi * row.position * 2), 1e-12);
    EXPECT_NEAR(row.stress(1, 0), spokes * 0.5 / (2 * pi * row.position * 2), 1e-12);
    EXPECT_NEAR(row.stress(1, 1), 0, 1e-13);
  }
}

}  // namespace
}  // namespace galet::test::profile_test
