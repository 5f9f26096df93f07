// Strain increments of crystals whose parts are known.
#include "common/measure/strain_split.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "src/simulation.hpp"
#include "tests/support/lattices.hpp"

namespace galet::test::strain_split_test {
namespace {

using test::snapshot_of;

std::vector<ContactStiffness> equal_springs(const ContactColumns<2>& contacts, double normal) {
  return std::vector<ContactStiffness>(contacts.size(), {normal, 0});
}

// Triangular lattice of springs K without friction (plane): C_xxxx = C_yyyy = 3 sqrt(3) K / 4, C_xxyy = C_xyxy = a
// third of it. A strain that is C^-1 of a stress, and one that no stress goes with.
TEST(StrainSplit, TriangularLattice) {
  Sample<2> sample = test::triangular(4);
  const ContactColumns<2> contacts = test::touching<2>(sample);
  const auto moduli = elastic_moduli(snapshot_of(sample, contacts), equal_springs(contacts, 50), {false, true});
  ASSERT_TRUE(moduli);
  const double c = std::sqrt(3.0) / 4 * 50;
  Mat<2> elastic, plastic, stress;
  elastic << 2e-3, 0.5e-3, 0.5e-3, -1e-3;
  plastic << 1e-3, -2e-4, -2e-4, 3e-3;
  stress << c * (3 * elastic(0, 0) + elastic(1, 1)), c * 2 * elastic(0, 1), c * 2 * elastic(0, 1),
      c * (elastic(0, 0) + 3 * elastic(1, 1));
  const StressStrain<2> before{Mat<2>::Identity(), 0.1 * Mat<2>::Identity()};
  const StressStrain<2> after{before.stress + stress, before.strain + elastic + plastic};
  const auto split = strain_split(before, after, *moduli);
  ASSERT_TRUE(split);
  const Eigen::Vector3d one(elastic(0, 0), elastic(1, 1), 2 * elastic(0, 1));
  const Eigen::Vector3d two(plastic(0, 0), plastic(1, 1), 2 * plastic(0, 1));
  // C is right to the shift of its factorisation, 1e-10 of the largest stiffness, refined twice.
  EXPECT_LT((split->type_one - one).norm(), 1e-8 * one.norm());
  EXPECT_LT((split->type_two - two).norm(), 1e-8 * one.norm());
  EXPECT_LT((split->total - one - two).norm(), 1e-15);
}

// A square lattice without friction has a shear that needs no stress: no split.
TEST(StrainSplit, IsNothingWhereTheNetworkIsLoose) {
  Sample<2> sample = test::square(4);
  const ContactColumns<2> contacts = test::touching<2>(sample);
  const auto moduli = elastic_moduli(snapshot_of(sample, contacts), equal_springs(contacts, 50), {false, true});
  ASSERT_TRUE(moduli);
  EXPECT_FALSE(strain_split<2>({}, {}, *moduli));
  EXPECT_THROW(strain_split<3>({}, {}, *moduli), std::invalid_argument);
}

// md under a stress that grows by a tenth, in the crystal of a packing file's kind: all strain is of contacts.
TEST(StrainSplit, OfMdInACrystalIsAllOfTypeI) {
  Sample<2> sample = test::triangular(4);
  for (double& radius : sample.radius) radius *= 1.0001;  // touching, under some pressure
  Scene scene;
  scene.grains.count = sample.count();
  scene.material.friction = 0;
  scene.material.restitution = 0;
  scene.material.normal_stiffness = 1e4;
  scene.initial.kind = InitialKind::listed;
  scene.loading.kind = LoadingKind::isotropic;
  scene.run.duration = 60;
  scene.run.samples = 10;
  sample.mass.assign(sample.count(), 1.0);
  std::optional<ElasticModuli> moduli;
  std::vector<StressStrain<2>> states;
  for (const double pressure : {1.0, 1.1}) {
    scene.loading.pressure = pressure;
    Simulation<2> simulation(scene, EngineKind::md, sample);
    const RunResult result = simulation.run();
    ASSERT_EQ(result.ending, Ending::finished) << result.failure;
    const Snapshot<2> state = simulation.engine().snapshot();
    EXPECT_NEAR(result.last[Observable::pressure], pressure, 1e-6);
    StressStrain<2>& now = states.emplace_back();
    now.stress = Mat<2>(pressure * Mat<2>::Identity());
    now.strain = -std::log(state.cell->volume()) / 2 * Mat<2>::Identity();
    if (!moduli) moduli = elastic_moduli(state, equal_springs(*state.contacts, 1e4), {false, true});
  }
  ASSERT_TRUE(moduli);
  const auto split = strain_split(states[0], states[1], *moduli);
  ASSERT_TRUE(split);
  EXPECT_GT(split->total[0], 1e-6);
  // The moduli leave out the forces' own turning and the change of geometry: of the order of the deflection, 1e-4.
  EXPECT_LT(split->type_two.norm(), 1e-3 * split->total.norm());
}

}  // namespace
}  // namespace galet::test::strain_split_test
