// No step of rigid grains makes energy: random small clusters that collide, with friction and rolling resistance, one
// e_N = e_T in [0, 1] for all contacts, where Moreau's law is dissipative. With unlike restitutions it can make energy;
// how much is measured here, and the engine's account must tell.
#include <gtest/gtest.h>

#include "tests/support/scenes.hpp"

namespace galet::test::cd_energy_test {
namespace {

template <int D>
Vec<D> random_direction(RandomStream& stream) {
  Vec<D> n;
  do
    for (int a = 0; a < D; ++a) n[a] = stream.uniform(-1, 1);
  while (n.norm() > 1 || n.norm() < 0.1);
  return n.normalized();
}

/// 2 to 6 unequal grains, each next to one before (touching, or a little apart), in random motion.
template <int D>
Sample<D> random_cluster(RandomStream& stream) {
  Sample<D> sample;
  sample.cell = cube<D>(40, false);
  const int count = 2 + static_cast<int>(stream.uniform(0, 5));
  sample.resize(count);
  for (int i = 0; i < count; ++i) {
    sample.radius[i] = stream.uniform(0.3, 0.7);
    sample.mass[i] = stream.uniform(0.2, 2);
    for (bool placed = false; !placed;) {
      sample.position[i] = Vec<D>::Constant(20);
      if (i > 0) {
        const int at = static_cast<int>(stream.uniform(0, i));
        const double gap = stream.uniform(0, 1) < 0.5 ? 0 : stream.uniform(0, 0.01);
        sample.position[i] =
            sample.position[at] + (sample.radius[at] + sample.radius[i] + gap) * random_direction<D>(stream);
      }
      placed = true;
      for (int k = 0; k < i && placed; ++k)
        placed = (sample.position[k] - sample.position[i]).norm() >= sample.radius[k] + sample.radius[i] - 1e-12;
    }
    for (int a = 0; a < D; ++a) sample.velocity[i][a] = stream.normal();
    if constexpr (D == 2)
      sample.spin[i] = 2 * stream.normal();
    else
      sample.spin[i] = 2 * Vec<3>(stream.normal(), stream.normal(), stream.normal());
  }
  return sample;
}

struct Growth {
  double largest = 0;  ///< of the energy, relative to that at the start
  int growing = 0;     ///< scenes in which a step made energy
  double account = 0;  ///< largest error of the engine's account, relative
};

/// `unlike`: e_N of contacts differ, and e_T does not follow.
template <int D>
void run_scene(std::uint64_t seed, bool rolling, bool unlike, Growth& growth) {
  RandomStream stream(seed, 9);
  const double e = stream.uniform(0, 1) < 0.1 ? 1 : stream.uniform(0, 1);
  Scene scene = free_scene(D, stream.uniform(0, 1), e, 1e4);
  scene.material.tangential_restitution = e;
  if (rolling) {
    scene.material.rolling_friction = stream.uniform(0, 0.3);
    if (D == 3) scene.material.pivoting_friction = stream.uniform(0, 0.3);
  }
  if (unlike) {
    scene.material.tangential_restitution = 0;
    scene.other_materials = {{.name = "b", .restitution = stream.uniform(0, 1)}};
    scene.pairs = {{.between = {"default", "b"}, .restitution = stream.uniform(0, 1)}};
  }
  scene.cd.dt = 5e-3;
  scene.cd.tolerance = 1e-9;
  scene.cd.max_sweeps = 20000;
  Sample<D> sample = random_cluster<D>(stream);
  if (unlike)
    for (int i = 0; i < sample.count(); ++i) sample.material[i] = i % 2;
  const auto engine = make_engine<D>(EngineKind::cd, scene, sample);
  const double start = engine->energy().total();
  double before = start, worst = -1;
  for (int step = 0; step < 2; ++step) {
    engine->advance(1);
    const double now = engine->energy().total();
    worst = std::max(worst, (now - before) / start);
    before = now;
  }
  growth.largest = std::max(growth.largest, worst);
  growth.growing += worst > 1e-7;
  const SolverSummary summary = engine->solver_summary();
  growth.account = std::max(growth.account, std::abs(before - start - summary.gained + summary.dissipated) / start);
}

Growth run_scenes(std::uint64_t count, bool unlike) {
  Growth growth;
  for (std::uint64_t seed = 0; seed < count; ++seed) {
    if (seed % 2 == 0)
      run_scene<2>(seed, seed % 4 == 0, unlike, growth);
    else
      run_scene<3>(seed, seed % 4 == 1, unlike, growth);
  }
  return growth;
}

TEST(EnergyOfStepsCd, NeverGrowsWithOneRestitution) {
  const Growth growth = run_scenes(100000, false);
  // The solver stops at a residual of 1e-9; its error in energy is of that order, times the condition of a cluster.
  EXPECT_LT(growth.largest, 1e-7);
  EXPECT_EQ(growth.growing, 0);
  // Rounding of some ten contacts, the worst of 1e5 scenes.
  EXPECT_LT(growth.account, 1e-12) << "the account of the contacts' energy is exact";
}

TEST(EnergyOfStepsCd, GrowthWithUnlikeRestitutionsIsAccounted) {
  const Growth growth = run_scenes(20000, true);
  RecordProperty("growing_per_10000", growth.growing / 2);
  RecordProperty("largest_growth_percent", static_cast<int>(100 * growth.largest));
  EXPECT_GT(growth.growing, 0) << "else nothing needs to be told";
  EXPECT_LT(growth.account, 1e-12);
}

}  // namespace
}  // namespace galet::test::cd_energy_test
