// Fabric, forces and balance against closed forms: lattices, and ensembles of contacts with given distributions.
#include "common/measure/fabric.hpp"

#include <cmath>
#include <numbers>

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include "common/measure/balance.hpp"
#include "common/measure/coordination.hpp"
#include "common/measure/force_distribution.hpp"
#include "common/measure/gap_distribution.hpp"
#include "common/measure/histogram.hpp"
#include "common/measure/mobilisation.hpp"
#include "common/measure/stress.hpp"
#include "common/measure/temperature.hpp"
#include "tests/support/lattices.hpp"

namespace galet::test::fabric_test {
namespace {

using test::cubic, test::face_centred, test::snapshot_of, test::square, test::touching, test::triangular;
constexpr double pi = std::numbers::pi, diameter = test::lattice_diameter;

template <int D>
void expect_isotropic(const Sample<D>& sample) {
  const ContactColumns<D> contacts = touching(sample);
  const Fabric<D> network = fabric(snapshot_of(sample, contacts));
  EXPECT_EQ(network.contacts, static_cast<long>(contacts.size()));
  EXPECT_LT((network.orientation - Mat<D>::Identity() / D).norm(), 1e-14);
  EXPECT_NEAR(network.mean_normal_force, test::lattice_force, 1e-14);
  const Anisotropies all = anisotropies(network);
  for (const double value : {all.contact, all.normal, all.tangential, all.branch}) EXPECT_NEAR(value, 0, 1e-13);
}

TEST(Fabric, LatticesAreIsotropicInTheSecondOrder) {
  expect_isotropic(triangular(3));
  expect_isotropic(square(3));
  expect_isotropic(cubic(2));
  expect_isotropic(face_centred(2));
}

/// Angle at which the cumulated probability of (1 + a cos 2 theta) / 2 pi is u.
double quantile(double u, double a) {
  double theta = 2 * pi * u;
  for (int k = 0; k < 60; ++k)
    theta -= (theta + 0.5 * a * std::sin(2 * theta) - 2 * pi * u) / (1 + a * std::cos(2 * theta));
  return theta;
}

// Contacts drawn, without noise, from the Fourier forms of the header. Averages over quantiles are midpoint rules of
// periodic analytic functions: exact to rounding. In closed form, with c = 1 + a_c a_n / 2 the mean of F_N over f,
//   F: a_c exactly;  chi_N: (a_c + a_n) / c;  chi_T: a_t / c
struct Ensemble {
  double ac, an, at, angle, length;
};

ContactColumns<2> contacts_of(const Ensemble& ensemble, int count) {
  ContactColumns<2> contacts;
  for (int k = 0; k < count; ++k) {
    const double theta = quantile((k + 0.5) / count, ensemble.ac), turned = theta + ensemble.angle;
    const Vec<2> n(std::cos(turned), std::sin(turned)), t(-n.y(), n.x());
    contacts.i.push_back(0), contacts.j.push_back(1);
    contacts.normal.push_back(n);
    contacts.branch.push_back((1 + ensemble.length * std::cos(2 * theta)) * n);
    contacts.force.push_back(2.5 *
                             ((1 + ensemble.an * std::cos(2 * theta)) * n - ensemble.at * std::sin(2 * theta) * t));
  }
  return contacts;
}

TEST(Fabric, FourierFormsOfDisks) {
  Sample<2> sample;
  sample.resize(2);
  for (const Ensemble& given : {Ensemble{0.2, 0.3, 0.1, 0, 0}, Ensemble{-0.15, 0.35, 0.05, 0.7, 0}}) {
    const ContactColumns<2> contacts = contacts_of(given, 400);
    const Snapshot<2> snapshot = snapshot_of(sample, contacts);
    const Fabric<2> network = fabric(snapshot);
    const Anisotropies measured = anisotropies(network);
    const double c = 1 + given.ac * given.an / 2;
    EXPECT_NEAR(network.mean_normal_force, 2.5 * c, 1e-12);
    EXPECT_NEAR(measured.contact, given.ac, 1e-12);
    EXPECT_NEAR(measured.normal, (given.ac + given.an) / c - given.ac, 1e-12);
    EXPECT_NEAR(measured.tangential, given.at / c, 1e-12);
    EXPECT_NEAR(measured.branch, 0, 1e-12);  // all branches have one length
    EXPECT_NEAR(std::abs(network.major.dot(Vec<2>(std::cos(given.angle), std::sin(given.angle)))), 1, 1e-12);
  }
}

/// (sigma_1 - sigma_D) / tr sigma of the contact stress.
template <int D>
double deviation(const Snapshot<D>& snapshot) {
  const Mat<D> sigma = stress(snapshot).contact;
  const Eigen::SelfAdjointEigenSolver<Mat<D>> principal(0.5 * (sigma + sigma.transpose()));
  return (principal.eigenvalues()[D - 1] - principal.eigenvalues()[0]) / sigma.trace();
}

// Stress-force-fabric relation, to rounding, also where branches have unlike lengths.
TEST(Fabric, StressForceFabricRelation) {
  Sample<2> sample;
  sample.resize(2);
  for (const double length : {0.0, 0.12}) {
    const ContactColumns<2> contacts = contacts_of({0.2, 0.3, 0.1, 0.4, length}, 300);
    const Snapshot<2> snapshot = snapshot_of(sample, contacts);
    const Anisotropies measured = anisotropies(fabric(snapshot));
    EXPECT_NEAR(deviation(snapshot), measured.sum() / anisotropy_scale<2>, 1e-13);
    // Longer branches along the major stress: a_l is its coefficient, up to products of two anisotropies.
    EXPECT_NEAR(measured.branch, length, 0.5 * length * (0.2 + 0.3 + 0.1) + 1e-14);
  }
}

// Axial symmetry about z: p = (1 + a_c (3 c^2 - 1)) / 4 pi, F_N and F_T as in the header. Cosines at the midpoints of
// 4000 quantiles: second order in 1/4000, errors of some 1e-7.
TEST(Fabric, AxialFormsOfSpheres) {
  const double ac = 0.1, an = 0.15, at = 0.08;
  Sample<3> sample;
  sample.resize(2);
  ContactColumns<3> contacts;
  const int count = 4000, around = 4;
  for (int k = 0; k < count; ++k) {
    const double u = (k + 0.5) / count;
    double c = 2 * u - 1;  // of (c + 1) / 2 + a_c (c^3 - c) / 2 = u
    for (int round = 0; round < 60; ++round)
      c -= ((c + 1) / 2 + ac * (c * c * c - c) / 2 - u) / (0.5 + ac * (3 * c * c - 1) / 2);
    const double s = std::sqrt(1 - c * c);
    for (int m = 0; m < around; ++m) {
      const double phi = 2 * pi * m / around;
      const Vec<3> n(s * std::cos(phi), s * std::sin(phi), c), growing(c * std::cos(phi), c * std::sin(phi), -s);
      contacts.i.push_back(0), contacts.j.push_back(1);
      contacts.normal.push_back(n), contacts.branch.push_back(0.7 * n);
      contacts.force.push_back((1 + an * (3 * c * c - 1)) * n - at * 2 * s * c * growing);
    }
  }
  const Snapshot<3> snapshot = snapshot_of(sample, contacts);
  const Anisotropies measured = anisotropies(fabric(snapshot));
  EXPECT_NEAR(measured.contact, ac, 1e-6);
  EXPECT_NEAR(measured.sum(), anisotropy_scale<3> * deviation(snapshot), 1e-12);
  // <(3c^2-1)^2> = 4/5, <(3c^2-1)^3> = 16/35: with m = 1 + 4/5 a_c a_n the mean normal force,
  // <F_N (3c^2-1)> = 4/5 (a_c + a_n) + 16/35 a_c a_n, and a = 5/2 * (1/2) of it.
  const double m = 1 + 0.8 * ac * an, along = (0.8 * (ac + an) + 16.0 / 35 * ac * an) / m;
  EXPECT_NEAR(measured.normal, 1.25 * along - ac, 1e-6);
  // <F_T (x) n>: zz - xx = a_t <3 s^2 c^2> = a_t 3 (2/15 + a_c (3 <c^4 s^2> - <c^2 s^2>)) = a_t (2/5 + 4/35 a_c).
  EXPECT_NEAR(measured.tangential, 2.5 * at * (0.4 + 4.0 / 35 * ac) / m, 1e-6);
  EXPECT_NEAR(std::abs(fabric(snapshot).major.z()), 1, 1e-9);
}

TEST(Fabric, OnlyContactsBetweenGrainsCount) {
  Sample<2> sample;
  sample.resize(2);
  ContactColumns<2> contacts = contacts_of({0.2, 0.3, 0.1, 0, 0}, 50);
  const Anisotropies before = anisotropies(fabric(snapshot_of(sample, contacts)));
  contacts.touching.assign(contacts.size(), 1);
  for (const int j : {1, 2}) {  // a pair across a gap, a plane
    contacts.i.push_back(0), contacts.j.push_back(j), contacts.touching.push_back(j == 1 ? 0 : 1);
    contacts.normal.push_back(Vec<2>::UnitX()), contacts.branch.push_back(Vec<2>::UnitX());
    contacts.force.push_back(Vec<2>(-1e3, 1e3));
  }
  const Anisotropies after = anisotropies(fabric(snapshot_of(sample, contacts)));
  EXPECT_EQ(before.contact, after.contact);
  EXPECT_EQ(before.sum(), after.sum());
  const ContactColumns<2> none;
  EXPECT_TRUE(std::isnan(anisotropies(fabric(snapshot_of(sample, none))).contact));
}

TEST(Histogram, SharesAndDensities) {
  const std::vector<double> values = {-1, 0, 0.1, 0.6, 1, 2.5, NAN};
  const Histogram result = histogram(values, 0, 1, 4);
  EXPECT_EQ(result.values, 6);
  EXPECT_DOUBLE_EQ(result.below, 1.0 / 6);
  EXPECT_DOUBLE_EQ(result.above, 1.0 / 6);
  const std::vector<double> shares = {2.0 / 6, 0, 1.0 / 6, 1.0 / 6};
  for (std::size_t k = 0; k < 4; ++k) EXPECT_DOUBLE_EQ(result.density[k] * result.width, shares[k]);
  EXPECT_DOUBLE_EQ(result.centre(2), 0.625);
  EXPECT_EQ(histogram({}, 0, 1, 4).density, std::vector<double>(4, 0.0));
}

// Forces at the quantiles of an exponential law: P(x) = exp(-x) in each interval, up to one value of 1e5.
TEST(ForceDistribution, ExponentialLaw) {
  Sample<2> sample;
  sample.resize(2);
  ContactColumns<2> contacts;
  const int count = 100000;
  for (int k = 0; k < count; ++k) {
    const double x = -std::log(1 - (k + 0.5) / count);
    contacts.i.push_back(0), contacts.j.push_back(1);
    contacts.normal.push_back(Vec<2>::UnitX()), contacts.force.push_back(Vec<2>(3 * x, -0.5 * x));
  }
  const ForceDistribution result = force_distribution(snapshot_of(sample, contacts), 5, 20);
  EXPECT_NEAR(result.mean_normal, 3, 3e-5);  // the midpoint rule misses some of the tail's logarithm
  EXPECT_NEAR(result.mean_tangential, 0.5, 1e-5);
  for (const Histogram& part : {result.normal, result.tangential})
    for (std::size_t k = 0; k < part.density.size(); ++k) {
      const double low = std::exp(-static_cast<double>(k) * part.width);
      // Two values at the ends of the interval, and the ends moved by the mean's error.
      EXPECT_NEAR(part.density[k] * part.width, low * (1 - std::exp(-part.width)), 2.0 / count + 2e-5 * 5);
    }
}

TEST(Mobilisation, MeanAndShare) {
  Sample<2> sample;
  sample.resize(2);
  ContactColumns<2> contacts;
  contacts.i.assign(5, 0), contacts.j.assign(5, 1);
  contacts.mobilised = {0.5, 1, 1 - 1e-13, NAN, 0.2};
  contacts.touching = {1, 1, 1, 1, 0};
  const Mobilisation result = mobilisation(snapshot_of(sample, contacts));
  EXPECT_EQ(result.contacts, 3);
  EXPECT_NEAR(result.mean, 2.5 / 3, 1e-12);
  EXPECT_DOUBLE_EQ(result.sliding, 2.0 / 3);
}

// Triangular lattice of gap g: 6 neighbours at g, 6 more at sqrt(3) (d + g) - d, then 6 at 2 (d + g) - d. (No row's gap
// is one of these.)
TEST(GapDistribution, NeighboursOfATriangularLattice) {
  Sample<2> sample = triangular(6);
  const double shrunk = 0.95 * diameter, gap = 0.05 * diameter;
  sample.radius.assign(sample.count(), shrunk / 2);
  const std::vector<GapRow> rows = gap_distribution(snapshot_of(sample, ContactColumns<2>()), 1.23 * diameter, 48);
  ASSERT_EQ(rows.size(), 49u);
  const double second = std::sqrt(3.0) * diameter - shrunk, third = 2 * diameter - shrunk;
  for (const GapRow& row : rows) {
    const double expected = row.gap >= third ? 18 : row.gap >= second ? 12 : row.gap >= gap ? 6 : 0;
    EXPECT_NEAR(row.coordination, expected, 1e-12) << row.gap;
  }
}

TEST(Temperature, EnergyPerFreedom) {
  Sample<3> sample = cubic(2);
  sample.mass.assign(8, 2);
  for (int i = 0; i < 8; ++i) {
    const double sign = i % 2 == 0 ? 1 : -1;
    sample.velocity[i] = Vec<3>(4, 5, 6) + sign * Vec<3>(0.1, 0.2, 0);
    sample.spin[i] = Vec<3>(1, 0, 0) + sign * Vec<3>(0, 0.3, 0);
  }
  const ContactColumns<3> none;
  const Temperature result = granular_temperature(snapshot_of(sample, none));
  EXPECT_NEAR(result.translational, 2 * 0.05 / 3, 1e-14);
  EXPECT_NEAR(result.rotational, 0.4 * 2 * diameter * diameter / 4 * 0.09 / 3, 1e-14);
}

// A column of three disks on a plane: in equilibrium with its weight; without gravity each grain lacks m g, against
// contact forces m g, 2 m g, 3 m g, of which 5 ends are on grains (12 m g in all - the plane's 3): mean 9/5 m g.
TEST(Balance, ColumnUnderItsWeight) {
  Sample<2> sample;
  sample.resize(3);
  sample.planes.push_back({Vec<2>::Zero(), Vec<2>::UnitY(), Vec<2>::Zero()});
  ContactColumns<2> contacts;
  for (int k = 0; k < 3; ++k) {
    sample.position[k] = Vec<2>(0, 0.5 + k);
    contacts.i.push_back(k == 0 ? 0 : k - 1), contacts.j.push_back(k == 0 ? 3 : k);
    const Vec<2> n = k == 0 ? Vec<2>(-Vec<2>::UnitY()) : Vec<2>(Vec<2>::UnitY());
    contacts.normal.push_back(n), contacts.branch.push_back(k == 0 ? 0.5 * n : n);
    contacts.force.push_back(9.0 * (3 - k) * n);
  }
  const Snapshot<2> snapshot = snapshot_of(sample, contacts);
  const std::vector<char> loose(3, 0);
  EXPECT_NEAR(unbalance(snapshot, loose, Vec<2>(0, -9)).force, 0, 1e-15);
  EXPECT_NEAR(unbalance(snapshot, loose).force, 5.0 / 9, 1e-14);
  EXPECT_EQ(unbalance(snapshot, loose).torque, 0);
  EXPECT_TRUE(std::isnan(unbalance(snapshot, std::vector<char>(3, 1)).force));
  // A tangential force f on the upper grain turns it and the one below alike, by -f d/2 each; both rub.
  contacts.force[2] += Vec<2>(2, 0);
  const Balance turned = unbalance(snapshot, loose, Vec<2>(0, -9));
  const double mean = (27 + 2 * 18 + 2 * std::hypot(9, 2)) / 5;
  EXPECT_NEAR(turned.torque, 2 * (2 * 0.5) / (mean * 3 * 0.5), 1e-13);
  EXPECT_NEAR(turned.force, 2 * 2 / (3 * mean), 1e-13);
}

}  // namespace
}  // namespace galet::test::fabric_test
