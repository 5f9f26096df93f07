// Compliance and cohesion at the contacts of bodies that turn, in cd, against closed forms.
#include <gtest/gtest.h>

#include "tests/support/rigid_bodies.hpp"

namespace galet::test::cd_clump_laws_test {
namespace {

constexpr double radius = 0.5;

/// A dumbbell that lies along a slope and that friction holds there: the plane carries T = M g sin(theta) and
/// N_1 + N_2 = M g cos(theta); no torque is left where N_2 - N_1 = 2 R T (grains at +- R). Deflections N / K_N turn the
/// body by T / K_N, tangential springs give way by T / (2 K_T), and the centre moves by both: T / (2 K_T) + R T / K_N.
template <int D>
void check_held_dumbbell() {
  SCOPED_TRACE("D = " + std::to_string(D));
  constexpr double stiffness = 1e6, ratio = 0.5, theta = 0.1;
  Scene scene = free_scene(D, 0.5, 0.5, stiffness);
  scene.material.convention = DampingConvention::total;
  scene.material.tangential_stiffness_ratio = ratio;
  scene.cd.compliance = true;
  scene.cd.tolerance = 1e-12;
  scene.cd.max_sweeps = 100000;
  scene.cd.dt = 0.05;
  const Vec<D> along = Vec<D>::Unit(0);
  const Vec<D> g = -std::cos(theta) * up<D>() + std::sin(theta) * along;
  scene.loading.gravity.assign(g.data(), g.data() + D);
  scene.bodies = {free_body(D, "dumbbell")};
  Sample<D> sample = dumbbell_sample<D>(along);
  sample.planes.push_back({Vec<D>(sample.position[0] - radius * up<D>()), up<D>(), Vec<D>::Zero()});
  const auto engine = make_engine<D>(EngineKind::cd, scene, sample);
  engine->advance(3000);
  const Snapshot<D> state = engine->snapshot();
  const double shear = 2 * std::sin(theta), load = 2 * std::cos(theta);
  ASSERT_EQ(state.contacts->size(), 2u);
  for (int k : {0, 1}) {
    const double normal = 0.5 * (load + (k == 0 ? -1 : 1) * 2 * radius * shear);
    // Levers are shorter than R by the deflection: 2 h / R = 4e-6.
    EXPECT_NEAR(-state.contacts->force[k].dot(up<D>()), normal, 1e-5);
    EXPECT_NEAR(-state.contacts->gap[k], normal / stiffness, 1e-5 * normal / stiffness + 1e-14);
  }
  const double moved = shear / (2 * ratio * stiffness) + radius * shear / stiffness;
  // The same, and the rounding of positions of order 20.
  EXPECT_NEAR((state.bodies[0].centre - 0.5 * (sample.position[0] + sample.position[1])).dot(along), moved,
              1e-4 * moved);
  EXPECT_LT(state.bodies[0].velocity.norm(), 1e-10);
  const double energy = shear * shear / (4 * ratio * stiffness);
  EXPECT_NEAR(engine->energy().elastic_tangential, energy, 1e-4 * energy);
}

TEST(ClumpLawsCd, SpringsOfADumbbellHeldOnASlope) {
  check_held_dumbbell<2>();
  check_held_dumbbell<3>();
}

constexpr double cohesion = 2, dt = 1e-3;

Scene cohesive_scene(int dim) {
  Scene scene = free_scene(dim, 0.3, 0, 1e4);
  scene.material.cohesion_force = cohesion;
  scene.cd.dt = dt;
  scene.cd.tolerance = 1e-12;
  return scene;
}

/// A dumbbell that hangs from a ceiling by one of its grains: F0 holds its whole weight.
template <int D>
void check_hanging() {
  SCOPED_TRACE("D = " + std::to_string(D));
  const Vec<D> down = -up<D>();
  for (const double weight : {0.99 * cohesion, 1.01 * cohesion}) {
    Scene scene = cohesive_scene(D);
    const Vec<D> g = 0.5 * weight * down;
    scene.loading.gravity.assign(g.data(), g.data() + D);
    scene.bodies = {free_body(D, "dumbbell")};
    Sample<D> sample = dumbbell_sample<D>(up<D>());
    sample.planes.push_back({Vec<D>(sample.position[1] + radius * up<D>()), down, Vec<D>::Zero()});
    const auto engine = make_engine<D>(EngineKind::cd, scene, sample);
    engine->advance(1000);
    const Snapshot<D> state = engine->snapshot();
    if (weight < cohesion) {
      EXPECT_LT(state.bodies[0].velocity.norm(), 1e-13);
      ASSERT_EQ(state.contacts->size(), 1u);
      EXPECT_NEAR(state.contacts->force[0].dot(state.contacts->normal[0]), -weight, 1e-9);
    } else {
      // The step in which the contact opens still pulls: from then on it falls freely.
      EXPECT_NEAR(state.bodies[0].velocity.dot(down), 0.5 * (dt * (weight - cohesion) + (1 - dt) * weight), 1e-11);
      EXPECT_EQ(state.contacts->size(), 0u);
    }
  }
}

TEST(ClumpLawsCd, CohesionCarriesAHangingDumbbell) {
  check_hanging<2>();
  check_hanging<3>();
}

/// Attraction F0 (1 - g / D0) on one end of a dumbbell moves it by F / M and turns it by arm x F / I, I = 3/4 for
/// disks and 7/10 for spheres.
template <int D>
void check_attraction() {
  SCOPED_TRACE("D = " + std::to_string(D));
  constexpr double range = 0.2, gap = 0.05;
  Scene scene = cohesive_scene(D);
  scene.material.cohesion_range = range;
  scene.bodies = {free_body(D, "dumbbell"), {.name = "post"}};
  Sample<D> sample = dumbbell_sample<D>(Vec<D>::Unit(1));
  const Vec<D> n = generic_direction<D>();
  add_grain<D>(sample, sample.position[1] + (1 + gap) * n);
  sample.body[2] = 1;
  const auto engine = make_engine<D>(EngineKind::cd, scene, sample);
  engine->advance(1);
  const RigidBody<D> body = engine->snapshot().bodies[0];
  const Vec<D> force = cohesion * (1 - gap / range) * n;
  const Spin<D> spin = dt / (D == 2 ? 0.75 : 0.7) * cross(Vec<D>(0.5 * Vec<D>::Unit(1)), force);
  EXPECT_LT((body.velocity - 0.5 * dt * force).norm(), 1e-15);
  // The inertia of the end of the step is turned by dt w: (dt w)^2 of the spin, 1e-9 of it.
  EXPECT_LT(spin_norm(Spin<D>(body.spin - spin)), 1e-11);
}

TEST(ClumpLawsCd, AttractionTurnsADumbbell) {
  check_attraction<2>();
  check_attraction<3>();
}

}  // namespace
}  // namespace galet::test::cd_clump_laws_test
