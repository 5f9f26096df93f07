// The stability bound of the md step holds for the stiffest things that a scene can ask for: a crystal with as many
// contacts as grains can have, whose contacts never slide, with every spring and dashpot.
#include <gtest/gtest.h>

#include "common/core/error.hpp"
#include "tests/support/scenes.hpp"

namespace galet::test::stability_test {
namespace {

struct Stiff {
  std::string name;
  void (*change)(MaterialSpec&);
};

const std::vector<Stiff>& stiff_laws() {
  static const std::vector<Stiff> laws = {
      {"normal only", [](MaterialSpec& m) { m.friction = 0; }},
      {"undamped", [](MaterialSpec&) {}},
      {"K_T = K_N", [](MaterialSpec& m) { m.tangential_stiffness_ratio = 1; }},
      {"rolling", [](MaterialSpec& m) { m.rolling_friction = 0.3; }},
      {"stiff rolling", [](MaterialSpec& m) { m.rolling_friction = 0.3, m.rolling_stiffness_ratio = 4; }},
      {"damped", [](MaterialSpec& m) { m.restitution = 0.2; }},
      {"tangential viscosity", [](MaterialSpec& m) { m.tangential_damping_ratio = 0.5; }},
      {"all of it",
       [](MaterialSpec& m) {
         m.restitution = 0.3, m.tangential_damping_ratio = 0.5;
         m.rolling_friction = 0.3, m.tangential_stiffness_ratio = 1;
       }},
  };
  return laws;
}

/// Largest energy of motion in `steps` steps over that at the start, at `factor` times the bound.
template <int D>
double growth(const Stiff& law, double factor, int steps = 3000) {
  // Neighbours overlap by 2 %: contacts don't open while grains shake by 1e-6.
  Sample<D> sample = crystal_sample<D>(D == 2 ? 5 : 3, 0.98);
  shake<D>(sample, 1e-4, 61, 1e-4);
  Scene scene = periodic_scene(D, 1e3, 1, 1e4);
  law.change(scene.material);
  if (D == 3) scene.material.pivoting_friction = scene.material.rolling_friction;
  scene.md.dt = factor * *derive_for<D>(scene, sample).md_dt_stable;
  scene.md.allow_unsafe_dt = true;
  const auto engine = make_engine<D>(EngineKind::md, scene, sample);
  const auto motion = [&] { return engine->energy().kinetic + engine->energy().rotational; };
  const double start = motion();
  double most = start;
  try {
    for (int look = 0; look < steps / 50; ++look) {
      engine->advance(50);
      most = std::max(most, motion());
      if (!(most < 1e6 * start)) break;
    }
  } catch (const RunError&) {
    return INFINITY;  // the engine itself found the state unsound
  }
  return most / start;
}

template <int D>
void check() {
  for (const Stiff& law : stiff_laws()) {
    SCOPED_TRACE(law.name + ", D = " + std::to_string(D));
    // An oscillator's energy moves between its forms, and near the bound the scheme's own energy wobbles by a factor.
    const double at = growth<D>(law, 1), beyond = growth<D>(law, 4);
    EXPECT_LT(at, 10);
    // The bound is no idle one: a few times it, the motion runs away.
    EXPECT_GT(beyond, 1e3);
  }
}

/// Nothing but the springs acts on the spins of grains that stick: velocities predicted without a share of the change
/// of acceleration make them run away within this many steps of a third of the bound.
TEST(Stability, StuckSpinsDoNotGainEnergy) {
  EXPECT_LT(growth<2>(stiff_laws()[2], 0.33, 20000), 2);
  EXPECT_LT(growth<3>(stiff_laws()[2], 0.33, 20000), 2);
}

/// Grains pressed together so far that the next nearest touch too: a body-centred crystal whose edge is shorter than a
/// diameter has 8 and 6 neighbours.
Sample<3> pressed_sample(int cells, double edge) {
  Sample<3> sample;
  sample.cell.box = cells * edge * Mat<3>::Identity();
  sample.cell.periodic.fill(true);
  sample.resize(2 * cells * cells * cells);
  for (int k = 0; k < sample.count(); ++k) {
    const int cell = k / 2;
    const Vec<3> corner(cell % cells, cell / cells % cells, cell / cells / cells);
    sample.position[k] = edge * (corner + Vec<3>::Constant(k % 2 ? 0.75 : 0.25));
  }
  return sample;
}

TEST(Stability, MoreNeighboursThanTheStepAllowsAreRefused) {
  Scene scene = periodic_scene(3, 0.3, 0.5, 1e4);
  const Sample<3> twelve = crystal_sample<3>(3, 0.98), fourteen = pressed_sample(3, 0.99);
  const double bound = *derive_for<3>(scene, twelve).md_dt_stable;
  // A step at the bound is good for the 12 neighbours that it was derived for, and for no more: without damping the
  // bound falls as 1 / sqrt(z), sqrt(12/14) = 0.926, and with it as 1 / z at worst, 0.857.
  scene.md.dt = 0.999 * bound;
  EXPECT_NO_THROW(make_engine<3>(EngineKind::md, scene, twelve));
  try {
    make_engine<3>(EngineKind::md, scene, fourteen);
    ADD_FAILURE() << "14 neighbours were accepted";
  } catch (const RunError& error) {
    EXPECT_NE(std::string(error.what()).find("touches 14 others"), std::string::npos) << error.what();
  }
  scene.md.dt = 0.85 * bound;
  EXPECT_NO_THROW(make_engine<3>(EngineKind::md, scene, fourteen));
  scene.md.dt = 0.999 * bound, scene.md.allow_unsafe_dt = true;
  EXPECT_NO_THROW(make_engine<3>(EngineKind::md, scene, fourteen));
}

TEST(Stability, BoundHoldsForEveryTermDisks) { check<2>(); }
TEST(Stability, BoundHoldsForEveryTermSpheres) { check<3>(); }

}  // namespace
}  // namespace galet::test::stability_test
