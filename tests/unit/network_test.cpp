// The contact network as a structure, and Voronoi cells, against closed forms: counts of crystals and isostatic
// structures, moduli of crystals and of springs in series, cells of lattices.
#include <cmath>
#include <numbers>

#include <Eigen/QR>
#include <gtest/gtest.h>

#include "common/core/random.hpp"
#include "common/measure/elastic_moduli.hpp"
#include "common/measure/equilibrium_matrix.hpp"
#include "common/measure/numbers.hpp"
#include "common/measure/voronoi.hpp"
#include "tests/support/lattices.hpp"

namespace galet::test::network_test {
namespace {

using test::cubic, test::face_centred, test::snapshot_of, test::square, test::touching, test::triangular;
constexpr double pi = std::numbers::pi, diameter = test::lattice_diameter;
constexpr NetworkOptions smooth{false, true}, rough{true, true};

/// A disk of radius 1/2 resting in a groove of two planes, with the forces that carry the weight 1.
struct Groove {
  Sample<2> sample;
  ContactColumns<2> contacts;
  Groove() {
    sample.resize(1);
    for (const double side : {-1.0, 1.0}) {
      const Vec<2> n = Vec<2>(side, -1).normalized();
      sample.planes.push_back({0.5 * n, -n, Vec<2>::Zero()});
      contacts.i.push_back(0), contacts.j.push_back(side < 0 ? 1 : 2);
      contacts.normal.push_back(n), contacts.branch.push_back(0.5 * n);
      contacts.force.push_back(n / std::sqrt(2.0));
    }
  }
};

// Reference T12: h = 2 contacts * 2 - 3 = 1 with friction. Without: 2 forces, 2 translations, isostatic.
TEST(Indeterminacy, DiskInAGroove) {
  const Groove groove;
  const Snapshot<2> snapshot = snapshot_of(groove.sample, groove.contacts);
  const Indeterminacy with = indeterminacy(snapshot, rough);
  EXPECT_EQ(with.forces, 4);
  EXPECT_EQ(with.freedoms, 3);
  EXPECT_EQ(with.indeterminacy(), 1);
  EXPECT_EQ(with.mechanisms(), 0);
  const Indeterminacy without = indeterminacy(snapshot, {false, false});
  EXPECT_EQ(without.indeterminacy(), 0);
  EXPECT_EQ(without.mechanisms(), 0);
  // The planes press towards each other: normal and tangential parts alike, equal by symmetry.
  const auto basis = self_stresses(snapshot, rough);
  ASSERT_EQ(basis.size(), 1u);
  EXPECT_LT((basis[0][0] - Vec<2>(-basis[0][1].x(), basis[0][1].y())).norm(), 1e-14);
  EXPECT_NEAR(basis[0][0].y(), 0, 1e-14);  // two ends of one line of force: through both contact points
}

// Periodic n x n (x n) crystals without friction in a cell that is held. Square and cubic: each line of n contacts is a
// ring with one self-stress, so that h = lines, k = D N - D N + lines. Triangular: rigid but for the translations.
TEST(Indeterminacy, Crystals) {
  for (const int n : {3, 5}) {
    const Sample<2> flat = square(n), dense = triangular(n);
    const ContactColumns<2> lines = touching(flat), all = touching(dense);
    const Indeterminacy floppy = indeterminacy(snapshot_of(flat, lines), smooth);
    EXPECT_EQ(floppy.indeterminacy(), 2 * n);
    EXPECT_EQ(floppy.mechanisms(), 2 * n);
    const long grains = dense.count();
    const Indeterminacy held = indeterminacy(snapshot_of(dense, all), smooth);
    EXPECT_EQ(held.mechanisms(), 2);
    EXPECT_EQ(held.indeterminacy(), 3 * grains - 2 * grains + 2);
    // A free cell adds three freedoms and, the lattice being rigid, takes three self-stresses: the stresses themselves.
    const Indeterminacy free = indeterminacy(snapshot_of(dense, all), smooth, unit_strains<2>());
    EXPECT_EQ(free.indeterminacy(), held.indeterminacy() - 3);
  }
  const Sample<3> sample = cubic(3);
  const ContactColumns<3> contacts = touching(sample);
  const Indeterminacy lines = indeterminacy(snapshot_of(sample, contacts), smooth);
  EXPECT_EQ(lines.indeterminacy(), 27);
  EXPECT_EQ(lines.mechanisms(), 27);
}

/// A dense random packing for networks: a triangular or fcc lattice with a fifth of its contacts taken away.
template <int D>
ContactColumns<D> diluted(const Sample<D>& sample, std::uint64_t seed) {
  const ContactColumns<D> all = touching(sample);
  ContactColumns<D> kept;
  for (std::size_t c = 0; c < all.size(); ++c) {
    if (RandomStream(seed, c).uniform() < 0.2) continue;
    kept.i.push_back(all.i[c]), kept.j.push_back(all.j[c]), kept.image.push_back(all.image[c]);
    kept.normal.push_back(all.normal[c]), kept.branch.push_back(all.branch[c]);
    kept.gap.push_back(all.gap[c]), kept.force.push_back(all.force[c]);
  }
  return kept;
}

template <int D>
void expect_dense_rank(const Sample<D>& sample) {
  const ContactColumns<D> contacts = diluted(sample, 4);
  const Snapshot<D> snapshot = snapshot_of(sample, contacts);
  for (const NetworkOptions& options : {smooth, rough}) {
    const EquilibriumMatrix<D> network = equilibrium_matrix(snapshot, options, unit_strains<D>());
    const Eigen::MatrixXd dense(network.matrix);
    Eigen::ColPivHouseholderQR<Eigen::MatrixXd> factors(dense);
    factors.setThreshold(1e-10);
    const Indeterminacy counted = indeterminacy(snapshot, options, unit_strains<D>());
    EXPECT_EQ(counted.rank, factors.rank());
    EXPECT_EQ(counted.freedoms + counted.indeterminacy(), counted.forces + counted.mechanisms());
    // Self-stresses: as many as h, orthonormal, no resultant anywhere.
    const auto basis = self_stresses(snapshot, options, unit_strains<D>());
    ASSERT_EQ(static_cast<long>(basis.size()), counted.indeterminacy());
    Eigen::MatrixXd self(network.matrix.cols(), static_cast<long>(basis.size()));
    for (std::size_t k = 0; k < basis.size(); ++k)
      for (std::size_t block = 0; block < network.contact.size(); ++block)
        self.block(static_cast<long>(block) * network.components, static_cast<long>(k), network.components, 1) =
            network.frame[block].transpose() * basis[k][network.contact[block]];
    EXPECT_LT((network.matrix * self).norm(), 1e-11);
    EXPECT_LT((self.transpose() * self - Eigen::MatrixXd::Identity(self.cols(), self.cols())).norm(), 1e-11);
  }
}

TEST(Indeterminacy, RankOfADenseMatrix) {
  expect_dense_rank(triangular(5));
  expect_dense_rank(face_centred(2));
}

// ---- moduli -------------------------------------------------------------------------------------------------

template <int D>
std::vector<ContactStiffness> equal_springs(const ContactColumns<D>& contacts, double normal, double tangential) {
  return std::vector<ContactStiffness>(contacts.size(), {normal, tangential});
}

// Bravais lattices deform affinely: C = (1/V) sum b^2 (K_N nnnn + K_T ...). Triangular, K_T = 0: lambda = G =
// sqrt(3)/4 K_N, bulk sqrt(3)/2 K_N; with K_T: bulk unchanged, G = sqrt(3)/4 (K_N + K_T). (Kruyt and Rothenburg 1996.)
TEST(ElasticModuli, TriangularLattice) {
  const Sample<2> sample = triangular(4);
  const ContactColumns<2> contacts = touching(sample);
  const Snapshot<2> snapshot = snapshot_of(sample, contacts);
  const double kn = 70, kt = 20, root = std::sqrt(3.0);
  const auto bare = elastic_moduli(snapshot, equal_springs(contacts, kn, 0), smooth);
  ASSERT_TRUE(bare);
  EXPECT_NEAR(bare->bulk, root / 2 * kn, 1e-8 * kn);  // shift and refinement: far below 1e-8
  EXPECT_NEAR(bare->shear, root / 4 * kn, 1e-8 * kn);
  EXPECT_NEAR(bare->stiffness(0, 1), root / 4 * kn, 1e-8 * kn);
  EXPECT_NEAR(bare->stiffness(2, 2), root / 4 * kn, 1e-8 * kn);
  EXPECT_NEAR(bare->stiffness(0, 2), 0, 1e-8 * kn);
  const auto full = elastic_moduli(snapshot, equal_springs(contacts, kn, kt), rough);
  EXPECT_NEAR(full->bulk, root / 2 * kn, 1e-8 * kn);
  EXPECT_NEAR(full->shear, root / 4 * (kn + kt), 1e-8 * kn);
  EXPECT_NEAR(full->affine_shear, full->shear, 1e-8 * kn);
}

// Square and simple cubic: C_11 = K_N / d^(D-2), C_12 = 0, and shear by K_T of two sets of contacts that share it, each
// with half of the strain: C_66 = K_T / (2 d^(D-2)). fcc without friction: C_11 = 2 C_12 = 2 C_44 = sqrt(2) K_N / d.
TEST(ElasticModuli, CubicLattices) {
  const double kn = 50, kt = 30;
  const Sample<2> flat = square(3);
  const ContactColumns<2> flat_contacts = touching(flat);
  const auto two = elastic_moduli(snapshot_of(flat, flat_contacts), equal_springs(flat_contacts, kn, kt), rough);
  EXPECT_NEAR(two->stiffness(0, 0), kn, 1e-8 * kn);
  EXPECT_NEAR(two->stiffness(0, 1), 0, 1e-8 * kn);
  EXPECT_NEAR(two->stiffness(2, 2), kt / 2, 1e-8 * kn);
  const Sample<3> sample = cubic(2);
  const ContactColumns<3> contacts = touching(sample);
  const auto three = elastic_moduli(snapshot_of(sample, contacts), equal_springs(contacts, kn, kt), rough);
  EXPECT_NEAR(three->stiffness(0, 0), kn / diameter, 1e-8 * kn);
  EXPECT_NEAR(three->stiffness(3, 3), kt / 2 / diameter, 1e-8 * kn);
  EXPECT_NEAR(three->bulk, kn / diameter / 3, 1e-8 * kn);
  const Sample<3> dense = face_centred(2);
  const ContactColumns<3> all = touching(dense);
  const auto fcc = elastic_moduli(snapshot_of(dense, all), equal_springs(all, kn, 0), smooth);
  const double c = std::sqrt(2.0) * kn / diameter;
  EXPECT_NEAR(fcc->stiffness(0, 0), c, 1e-8 * kn);
  EXPECT_NEAR(fcc->stiffness(0, 1), c / 2, 1e-8 * kn);
  EXPECT_NEAR(fcc->stiffness(3, 3), c / 2, 1e-8 * kn);
}

// Springs in series do not deform affinely: rows of a square lattice with K and K' in turn have 2 K K' / (K + K').
TEST(ElasticModuli, SpringsInSeries) {
  const Sample<2> sample = square(4);
  const ContactColumns<2> contacts = touching(sample);
  std::vector<ContactStiffness> springs = equal_springs(contacts, 10, 0);
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    if (std::abs(contacts.normal[c].x()) < 0.5) continue;
    const double middle = sample.position[contacts.i[c]].x() + 0.5 * contacts.branch[c].x();
    const long place = std::lround(middle / diameter - 0.5);
    springs[c].normal = (place + 4) % 2 == 0 ? 10 : 40;
  }
  const auto moduli = elastic_moduli(snapshot_of(sample, contacts), springs, smooth);
  EXPECT_NEAR(moduli->stiffness(0, 0), 2.0 * 10 * 40 / 50, 1e-7);
  EXPECT_NEAR(moduli->affine(0, 0), 25, 1e-12);
  EXPECT_NEAR(moduli->stiffness(1, 1), 10, 1e-7);
}

// A disordered network against a dense pseudo-inverse, with rotations.
TEST(ElasticModuli, DenseOracle) {
  const Sample<3> sample = face_centred(2);
  const ContactColumns<3> contacts = diluted(sample, 9);
  std::vector<ContactStiffness> springs;
  for (std::size_t c = 0; c < contacts.size(); ++c)
    springs.push_back({RandomStream(1, c).uniform(1, 3), RandomStream(2, c).uniform(0.2, 1)});
  const Snapshot<3> snapshot = snapshot_of(sample, contacts);
  const auto moduli = elastic_moduli(snapshot, springs, rough);
  const EquilibriumMatrix<3> network = equilibrium_matrix(snapshot, rough, unit_strains<3>());
  Eigen::VectorXd stiffness(network.matrix.cols());
  for (std::size_t block = 0; block < network.contact.size(); ++block)
    for (int k = 0; k < 3; ++k) {
      const ContactStiffness& spring = springs[network.contact[block]];
      stiffness[static_cast<long>(block) * 3 + k] = k == 0 ? spring.normal : spring.tangential;
    }
  const Eigen::MatrixXd g(network.matrix), full = g * stiffness.asDiagonal() * g.transpose();
  const int n = network.grain_freedoms;
  const Eigen::MatrixXd inner = full.topLeftCorner(n, n), coupling = full.topRightCorner(n, 6);
  const Eigen::MatrixXd expected =
      (full.bottomRightCorner(6, 6) -
       coupling.transpose() * Eigen::ColPivHouseholderQR<Eigen::MatrixXd>(inner).solve(coupling)) /
      sample.cell.volume();
  EXPECT_LT((moduli->stiffness - expected).norm(), 1e-8 * expected.norm());
  EXPECT_LT(moduli->shear, moduli->affine_shear);  // an upper bound, not reached in disorder
}

TEST(ElasticModuli, NoCellNoModuli) {
  const Groove groove;
  EXPECT_FALSE(
      elastic_moduli(snapshot_of(groove.sample, groove.contacts), equal_springs(groove.contacts, 1, 1), rough));
}

// K_N of each law at the deflection h, from the overlap (md) or from the force (rigid grains): the same number.
TEST(ElasticModuli, StiffnessFromOverlapOrForce) {
  Sample<3> sample;
  sample.resize(2);
  ContactColumns<3> contacts;
  contacts.i = {0}, contacts.j = {1};
  contacts.normal = {Vec<3>::UnitX()};
  LawTable laws;
  laws.pairs.resize(1);
  PairLaw& law = laws.pairs[0];
  law.friction = 0.3, law.tangential_ratio = 0.8, law.stiffness = 200, law.normal_law = NormalLaw::hertz;
  const double h = 1e-3, k = 4.0 / 3 * 200 * std::sqrt(0.25);
  for (const bool soft : {true, false}) {
    contacts.gap = {soft ? -h : 1e-9};
    contacts.force = {Vec<3>(k * std::pow(h, 1.5), 0, 0)};
    const auto stiffness = contact_stiffness(snapshot_of(sample, contacts), laws, {}, {});
    EXPECT_NEAR(stiffness[0].normal, 1.5 * k * std::sqrt(h), 1e-12);
    EXPECT_NEAR(stiffness[0].tangential, 0.8 * 1.5 * k * std::sqrt(h), 1e-12);
  }
  // F = K h - sqrt(4 K F0 h): dF/dh by central differences.
  law.normal_law = NormalLaw::linear, law.cohesion_law = CohesionLaw::square_root, law.cohesion = 0.05;
  const auto force = [&](double x) { return 200 * x - std::sqrt(4 * 200 * 0.05 * x); };
  contacts.gap = {-h};
  const auto stiffness = contact_stiffness(snapshot_of(sample, contacts), laws, {}, {});
  EXPECT_NEAR(stiffness[0].normal, (force(h * 1.0001) - force(h * 0.9999)) / (2e-4 * h), 1e-5);
  EXPECT_NEAR(stiffness[0].tangential, 0.8 * 200, 1e-12);
}

// ---- Voronoi cells ------------------------------------------------------------------------------------------

template <int D>
void expect_equal_cells(Sample<D> sample) {
  for (int i = 0; i < sample.count(); ++i)  // images and places in the cell don't matter
    sample.position[i] += sample.cell.box * Vec<D>::Constant(i % 3 - 1.0) + Vec<D>::Constant(0.3);
  const ContactColumns<D> none;
  const Snapshot<D> snapshot = snapshot_of(sample, none);
  for (const double phi : local_solid_fraction(snapshot)) EXPECT_NEAR(phi, solid_fraction(snapshot), 1e-10);
}

TEST(Voronoi, CellsOfLattices) {
  expect_equal_cells(triangular(5));
  expect_equal_cells(square(4));
  expect_equal_cells(cubic(3));
  expect_equal_cells(face_centred(2));
}

// A cell that is turned and tilted, with grains of all sizes: the cells fill it, and hold their grains.
template <int D>
void expect_filled(Mat<D> box, int side) {
  Sample<D> sample;
  sample.cell.box = box;
  sample.cell.periodic.fill(true);
  int count = 1;
  for (int a = 0; a < D; ++a) count *= side;
  sample.resize(count);
  for (int i = 0; i < count; ++i) {
    RandomStream random(3, i);
    Vec<D> s;
    for (int a = 0, rest = i; a < D; ++a, rest /= side) s[a] = (rest % side + random.uniform(0, 0.4)) / side;
    sample.position[i] = box * s;
    sample.radius[i] = random.uniform(0.05, 0.3);
  }
  const ContactColumns<D> none;
  const Snapshot<D> snapshot = snapshot_of(sample, none);
  double sum = 0;
  for (const double volume : voronoi_volumes(snapshot)) sum += volume;
  EXPECT_NEAR(sum, sample.cell.volume(), 1e-9 * sum);
  ASSERT_GT(test::least_gap(sample), 0);
  for (const double phi : local_solid_fraction(snapshot)) EXPECT_LT(phi, 1);
}

TEST(Voronoi, CellsFillATiltedCell) {
  Mat<2> flat;
  flat << 5, 2, 1, 6;
  expect_filled<2>(flat, 5);
  Mat<3> space;
  space << 5, 1, 0.5, 0.4, 6, 1, -0.3, 0.2, 5;
  expect_filled<3>(space, 4);
}

// Radical planes: between disks of radii R and r in a row at distance c, the border is (c^2 + R^2 - r^2) / 2c from R.
TEST(Voronoi, RadicalPlaneOfUnlikeDisks) {
  Sample<2> sample;
  sample.resize(2);
  sample.cell.box = Vec<2>(4, 3).asDiagonal();
  sample.cell.periodic.fill(true);
  sample.position = {Vec<2>(0.5, 1), Vec<2>(2.5, 1)};
  sample.radius = {0.9, 0.4};
  const ContactColumns<2> none;
  const std::vector<double> volumes = voronoi_volumes(snapshot_of(sample, none));
  const double reach = (4 + 0.81 - 0.16) / 4;
  EXPECT_NEAR(volumes[0], 2 * reach * 3, 1e-10);
  EXPECT_NEAR(volumes[1], 2 * (2 - reach) * 3, 1e-10);
}

TEST(Voronoi, OpenCellEndsAtItsFaces) {
  Sample<3> sample;
  sample.resize(2);
  sample.cell.box = Vec<3>(4, 3, 2).asDiagonal();
  sample.position = {Vec<3>(1, 1, 1), Vec<3>(2, 1, 1)};
  const ContactColumns<3> none;
  const std::vector<double> volumes = voronoi_volumes(snapshot_of(sample, none));
  EXPECT_NEAR(volumes[0], 1.5 * 6, 1e-10);
  EXPECT_NEAR(volumes[1], 2.5 * 6, 1e-10);
  sample.cell.periodic = {true, false, false};
  EXPECT_THROW(voronoi_volumes(snapshot_of(sample, none)), std::invalid_argument);
}

}  // namespace
}  // namespace galet::test::network_test
