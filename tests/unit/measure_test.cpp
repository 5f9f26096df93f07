// Measures against closed forms: lattices with a given force, an ideal gas, networks whose rattlers are known by
// construction, series whose error is known.
#include <array>
#include <cmath>
#include <numbers>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "common/core/random.hpp"
#include "common/measure/autocorrelation.hpp"
#include "common/measure/block_average.hpp"
#include "common/measure/coordination.hpp"
#include "common/measure/numbers.hpp"
#include "common/measure/stress.hpp"
#include "common/scene/pair_law.hpp"
#include "tests/support/brute_force.hpp"
#include "tests/support/lattices.hpp"

namespace galet::test::measure_test {
namespace {

using test::snapshot_of;
constexpr double pi = std::numbers::pi;
using test::cubic, test::face_centred, test::square, test::touching, test::triangular;
constexpr double force_value = test::lattice_force, diameter = test::lattice_diameter;

/// References L1 and L3: P = z Phi <F> / (pi d^(D-1)), isotropic, and the lattice's own z and Phi.
template <int D>
void expect_lattice(const Sample<D>& sample, double z, double phi) {
  const ContactColumns<D> contacts = touching(sample);
  const Snapshot<D> snapshot = snapshot_of(sample, contacts);
  EXPECT_NEAR(solid_fraction(snapshot), phi, 1e-14);
  for (const bool friction : {false, true}) {
    const Coordination network = coordination(snapshot, friction);
    EXPECT_DOUBLE_EQ(network.z, z);
    EXPECT_DOUBLE_EQ(network.z_star, z);
    EXPECT_EQ(network.rattler_fraction, 0);
    EXPECT_EQ(network.contacts, static_cast<long>(contacts.size()));
  }
  const double pressure = z * phi * force_value / (pi * std::pow(diameter, D - 1));
  const StressParts<D> parts = stress(snapshot);
  EXPECT_LT((parts.contact - pressure * Mat<D>::Identity()).norm(), 1e-12 * pressure);
  EXPECT_EQ(parts.kinetic.norm(), 0);
  EXPECT_NEAR(mean_pressure<D>(parts.total()), pressure, 1e-12 * pressure);
}

TEST(Measure, TriangularLattice) { expect_lattice(triangular(4), 6, pi / (2 * std::sqrt(3.0))); }
TEST(Measure, SquareLattice) { expect_lattice(square(5), 4, pi / 4); }
TEST(Measure, CubicLattice) { expect_lattice(cubic(3), 6, pi / 6); }
TEST(Measure, FaceCentredLattice) { expect_lattice(face_centred(2), 12, pi / (3 * std::sqrt(2.0))); }

// A cell with one grain: all its contacts are with its own images, and each counts twice for it.
TEST(Measure, GrainThatMeetsItsOwnImages) {
  expect_lattice(square(1), 4, pi / 4);
  expect_lattice(cubic(1), 6, pi / 6);
}

TEST(Measure, StressIsForceTimesBranchOverVolume) {
  Sample<2> sample = square(3);
  ContactColumns<2> contacts = touching(sample);
  for (std::size_t c = 0; c < contacts.size(); ++c)  // vertical contacts only, with a tangential part along -x
    contacts.force[c] = std::abs(contacts.normal[c].y()) > 0.5
                            ? Vec<2>(-0.3 * contacts.normal[c].y(), 0.8 * contacts.normal[c].y())
                            : Vec<2>::Zero();
  const Mat<2> sigma = stress(snapshot_of(sample, contacts)).total();
  EXPECT_NEAR(sigma(1, 1), 0.8 / diameter, 1e-14);  // one contact per width d
  EXPECT_NEAR(sigma(0, 1), -0.3 / diameter, 1e-14);
  EXPECT_EQ(sigma(0, 0), 0);
  EXPECT_EQ(sigma(1, 0), 0);
  EXPECT_NEAR(stress_ratio<2>(sigma), 0.3 / 0.8, 1e-14);
}

// N m <v_a v_b> / V: the pressure of an ideal gas, with the trace tied to the kinetic energy exactly.
TEST(Measure, KineticStressOfIdealGas) {
  Sample<3> gas;
  gas.resize(20000);
  gas.cell.box = Vec<3>(3, 4, 5).asDiagonal();
  const double speed = 0.7, mass = 1.9;
  double energy = 0;
  for (int i = 0; i < gas.count(); ++i) {
    RandomStream random(3, i);
    for (int a = 0; a < 3; ++a) gas.velocity[i][a] = speed * random.normal();
    gas.mass[i] = mass;
    energy += mass * gas.velocity[i].squaredNorm() / 2;
  }
  const ContactColumns<3> none;
  const Mat<3> sigma = stress(snapshot_of(gas, none)).kinetic;
  EXPECT_NEAR(sigma.trace(), 2 * energy / 60, 1e-9 * energy);
  const double pressure = gas.count() * mass * speed * speed / 60;
  const double noise = 1 / std::sqrt(gas.count());  // relative deviation of an off-diagonal component
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b) EXPECT_NEAR(sigma(a, b), a == b ? pressure : 0, 5 * std::sqrt(2) * noise * pressure);
}

/// A network without geometry: only who touches whom. `grains` and more stand for planes.
Coordination network(int grains, const std::vector<std::array<int, 2>>& pairs, bool friction,
                     std::vector<char>* loose = nullptr) {
  Sample<2> sample;
  sample.resize(grains);
  ContactColumns<2> contacts;
  for (const auto& [i, j] : pairs) {
    contacts.i.push_back(i);
    contacts.j.push_back(j);
  }
  const Snapshot<2> snapshot = snapshot_of(sample, contacts);
  if (loose != nullptr) *loose = rattlers(snapshot, friction);
  return coordination(snapshot, friction);
}

// Four grains all touching each other (3 contacts each), a tail 4-5-6 hanging on grain 0, and grain 7 alone.
TEST(Measure, RattlersAreRemovedAlongATail) {
  const std::vector<std::array<int, 2>> pairs = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3},
                                                 {2, 3}, {0, 4}, {4, 5}, {5, 6}};
  for (const bool friction : {false, true}) {
    std::vector<char> loose;
    const Coordination result = network(8, pairs, friction, &loose);
    EXPECT_EQ(loose, (std::vector<char>{0, 0, 0, 0, 1, 1, 1, 1}));
    EXPECT_DOUBLE_EQ(result.z, 18.0 / 8);
    EXPECT_DOUBLE_EQ(result.z_star, 3);
    EXPECT_DOUBLE_EQ(result.rattler_fraction, 0.5);
  }
}

// A bridge of two-contact grains between two quads carries force with friction and can't without.
TEST(Measure, BridgeIsLooseWithoutFrictionOnly) {
  const std::vector<std::array<int, 2>> pairs = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}, {0, 4}, {4, 5},
                                                 {5, 6}, {6, 7}, {6, 8}, {6, 9}, {7, 8}, {7, 9}, {8, 9}};
  std::vector<char> loose;
  network(10, pairs, false, &loose);
  EXPECT_EQ(loose, (std::vector<char>{0, 0, 0, 0, 1, 1, 0, 0, 0, 0}));
  const Coordination result = network(10, pairs, true, &loose);
  EXPECT_EQ(loose, std::vector<char>(10, 0));
  EXPECT_DOUBLE_EQ(result.z_star, 3);
}

// In a ring every grain has two contacts; removing one that has fewer than three undoes the whole ring.
TEST(Measure, AllRattlers) {
  const std::vector<std::array<int, 2>> ring = {{0, 1}, {1, 2}, {2, 3}, {0, 3}};
  const Coordination result = network(4, ring, false);
  EXPECT_DOUBLE_EQ(result.z, 2);
  EXPECT_DOUBLE_EQ(result.z_star, 0);
  EXPECT_DOUBLE_EQ(result.rattler_fraction, 1);
  EXPECT_EQ(network(0, {}, true).z, 0);
}

// z = (2 N_gg + N_gw) / N; a grain held between two planes is no rattler with friction.
TEST(Measure, PlanesCountOnce) {
  const Coordination result = network(2, {{0, 1}, {0, 2}, {1, 3}}, true);
  EXPECT_DOUBLE_EQ(result.z, 2);
  EXPECT_DOUBLE_EQ(result.z_star, 2);
  EXPECT_EQ(result.rattler_fraction, 0);
  EXPECT_DOUBLE_EQ(network(1, {{0, 1}, {0, 2}}, true).z, 2);
  EXPECT_EQ(network(1, {{0, 1}}, true).rattler_fraction, 1);
}

TEST(Measure, Overlaps) {
  Sample<2> sample;
  sample.resize(3);
  ContactColumns<2> contacts;
  EXPECT_EQ(overlap(snapshot_of(sample, contacts)).largest, 0);
  contacts.i = {0, 0, 1};
  contacts.j = {1, 2, 2};
  contacts.gap = {-0.1, 0.4, -0.3};
  const Overlap result = overlap(snapshot_of(sample, contacts));
  EXPECT_DOUBLE_EQ(result.mean, 0.4 / 3);
  EXPECT_DOUBLE_EQ(result.largest, 0.3);
}

TEST(Measure, ControlNumbersHaveNoUnits) {
  // The same state in other units of mass, length and time: I and kappa stay.
  const double m = 3, l = 5, t = 7;
  for (const int dim : {2, 3}) {
    const double pressure_unit = dim == 2 ? m / (t * t) : m / (l * t * t);
    EXPECT_NEAR(inertial_number(dim, 0.2 / t, 0.5 * pressure_unit, 1.5 * m, 0.8 * l),
                inertial_number(dim, -0.2, 0.5, 1.5, 0.8), 1e-15);
    PairLaw law, rescaled;
    law.stiffness = 100, rescaled.stiffness = 100 * m / (t * t);
    EXPECT_NEAR(stiffness_level(rescaled, dim, 0.5 * pressure_unit, 0.8 * l), stiffness_level(law, dim, 0.5, 0.8),
                1e-11);
    // The modulus of a hertzian law is a force per area in both dimensions.
    law.normal_law = rescaled.normal_law = NormalLaw::hertz;
    rescaled.stiffness = 100 * m / (l * t * t);
    EXPECT_NEAR(stiffness_level(rescaled, dim, 0.5 * pressure_unit, 0.8 * l), stiffness_level(law, dim, 0.5, 0.8),
                1e-11);
  }
  EXPECT_DOUBLE_EQ(inertial_number(2, 0.2, 0.25, 1, 9), 0.4);
  PairLaw law;
  law.stiffness = 100;
  EXPECT_DOUBLE_EQ(stiffness_level(law, 3, 0.25, 2), 200);
  // Glass at 1 kPa (the chapter): E = 70 GPa, nu = 0.3, kappa = 181000.
  law.normal_law = NormalLaw::hertz;
  law.stiffness = 70e9 / (2 * (1 - 0.09));
  EXPECT_NEAR(stiffness_level(law, 3, 1e3, 1e-3), 181000, 500);
}

TEST(BlockAverage, FewValues) {
  EXPECT_EQ(block_average({}).value, 0);
  const std::array one = {4.0};
  EXPECT_EQ(block_average(one).value, 4);
  EXPECT_EQ(block_average(one).error, 0);
  const std::array two = {1.0, 4.0};
  EXPECT_DOUBLE_EQ(block_average(two).value, 2.5);
  EXPECT_DOUBLE_EQ(block_average(two).error, 1.5);  // deviation 3/sqrt(2), over sqrt(2)
  const std::vector<double> constant(1000, 0.1);
  EXPECT_NEAR(block_average(constant).value, 0.1, 1e-14);
  EXPECT_NEAR(block_average(constant).error, 0, 1e-14);
}

// Without the level's limit the error of blocks of two would be found: (1, 1, -1, -1, ...) in pairs.
TEST(BlockAverage, KeepsToLevelsWithEnoughBlocks) {
  std::vector<double> series;
  for (int k = 0; k < 20; ++k) series.insert(series.end(), 2, k % 2 == 0 ? 1.0 : -1.0);
  EXPECT_NEAR(block_average(series, 20).error, 1 / std::sqrt(19.0), 1e-14);
  EXPECT_NEAR(block_average(series, 21).error, 1 / std::sqrt(39.0), 1e-14);
}

// x_k = phi x_(k-1) + noise: the variance of the mean of n values is known exactly,
// s^2/n [(1+phi)/(1-phi) - 2 phi (1-phi^n) / (n (1-phi)^2)].
TEST(BlockAverage, ErrorOfCorrelatedNoise) {
  const int length = 1 << 14, repeats = 60;
  for (const double phi : {0.0, 0.5, 0.9, 0.97}) {
    const double exact = std::sqrt(
        ((1 + phi) / (1 - phi) - 2 * phi * (1 - std::pow(phi, length)) / (length * (1 - phi) * (1 - phi))) / length);
    double error = 0, squares = 0;
    for (int repeat = 0; repeat < repeats; ++repeat) {
      RandomStream random(11, repeat);
      std::vector<double> series(length);
      double x = random.normal();
      for (double& value : series) {
        value = x;
        x = phi * x + std::sqrt(1 - phi * phi) * random.normal();
      }
      const Estimate estimate = block_average(series);
      error += estimate.error / repeats;
      squares += estimate.value * estimate.value / repeats;
    }
    // The largest of several noisy levels lies above the plateau, by up to 25 % with 16 blocks at least.
    EXPECT_GT(error, 0.97 * exact) << "phi = " << phi;
    EXPECT_LT(error, 1.30 * exact) << "phi = " << phi;
    // The series really has the error that the formula says: 60 repeats know it within 5 sigma = 46 %.
    EXPECT_NEAR(std::sqrt(squares) / exact, 1, 0.46) << "phi = " << phi;
  }
}

// x_k = phi x_(k-1) + noise: rho_k = phi^k, so that tau = 1/2 + phi / (1 - phi) = (1 + phi) / (2 (1 - phi)).
TEST(AutocorrelationTime, OfCorrelatedNoise) {
  const int length = 1 << 14, repeats = 40;
  for (const double phi : {0.0, 0.5, 0.9, 0.97}) {
    const double exact = (1 + phi) / (2 * (1 - phi));
    double mean = 0;
    for (int repeat = 0; repeat < repeats; ++repeat) {
      RandomStream random(12, repeat);
      std::vector<double> series(length);
      double x = random.normal();
      for (double& value : series) {
        value = x;
        x = phi * x + std::sqrt(1 - phi * phi) * random.normal();
      }
      mean += autocorrelation_time(series) / repeats;
    }
    // Bias: the window of 5 tau leaves e^-5 = 0.7 % out, the mean of the series takes 2 tau / n = 0.4 % at most away.
    // Noise: relative variance 2 (2 W + 1) / n with W = 5 tau (Madras and Sokal), over the repeats, 4 sigma.
    const double noise = std::sqrt(2 * (10 * exact + 3) / length / repeats);
    EXPECT_NEAR(mean / exact, 1, 0.012 + 4 * noise) << "phi = " << phi;
  }
}

TEST(AutocorrelationTime, IsNothingWhereItCanNotBeKnown) {
  EXPECT_TRUE(std::isnan(autocorrelation_time({})));
  EXPECT_TRUE(std::isnan(autocorrelation_time(std::vector<double>(100, 0.25))));
  std::vector<double> drift(200);
  for (std::size_t k = 0; k < drift.size(); ++k) drift[k] = static_cast<double>(k);
  EXPECT_TRUE(std::isnan(autocorrelation_time(drift)));
}

}  // namespace
}  // namespace galet::test::measure_test
