// Rigid bodies that move and turn, in both engines: free fall, torques, imposed rotation, rest and sliding, and the
// motion of a top without torque.
#include <gtest/gtest.h>

#include "tests/support/rigid_bodies.hpp"

namespace galet::test::rigid_body_test {
namespace {

constexpr double gravity = 1;

Scene body_scene(int dim, double friction = 0.5, double restitution = 0.5) {
  Scene scene = free_scene(dim, friction, restitution, 1e4);
  set_dt(scene, 1e-3);
  scene.cd.tolerance = 1e-11;
  scene.cd.max_sweeps = 20000;
  return scene;
}

template <int D>
void check_fall(EngineKind kind) {
  SCOPED_TRACE(to_string(kind) + " D = " + std::to_string(D));
  Scene scene = body_scene(D);
  scene.loading.gravity.assign(D, 0);
  scene.loading.gravity.back() = -gravity;
  scene.bodies = {free_body(D, "clump")};
  scene.cd.theta = 0.5;  // free flight is then exact in cd too
  const Sample<D> sample = dumbbell_sample<D>(generic_direction<D>());
  const auto engine = make_engine<D>(kind, scene, sample);
  engine->advance(1000);
  const Snapshot<D> state = engine->snapshot();
  // A constant acceleration is integrated exactly by both schemes; 1000 roundings of numbers of order 20.
  EXPECT_LT((state.bodies[0].velocity + gravity * up<D>()).norm(), 1e-12);
  for (int k : {0, 1}) {
    EXPECT_LT((state.position[k] - sample.position[k] + 0.5 * gravity * up<D>()).norm(), 1e-11);
    EXPECT_LT((state.velocity[k] + gravity * up<D>()).norm(), 1e-12);
    EXPECT_EQ(spin_norm(state.spin[k]), 0);
  }
}

TEST(RigidBody, FallsWithoutTurning) {
  for (const EngineKind kind : both_engines) check_fall<2>(kind), check_fall<3>(kind);
}

/// Two disks of mass 1 and radius 1/2 that touch: I = 2 (m R^2 / 2 + m R^2) = 3/4; spheres, across: 2 (2/5 + 1) / 4.
TEST(RigidBody, TurnsByTorqueOverInertia) {
  for (const EngineKind kind : both_engines) {
    SCOPED_TRACE(to_string(kind));
    Scene scene = body_scene(2);
    scene.bodies = {free_body(2, "wheel")};
    scene.bodies[0].torque = {0.3};
    scene.cd.theta = 0.5;
    const auto engine = make_engine<2>(kind, scene, dumbbell_sample<2>(Vec<2>(1, 0)));
    engine->advance(1000);
    const double rate = 0.3 / 0.75;
    EXPECT_NEAR(engine->snapshot().bodies[0].spin, rate, 1e-12);
    EXPECT_NEAR(engine->snapshot().bodies[0].orientation, 0.5 * rate, 1e-12);
    // Grains move as parts of the body.
    const Vec<2> arm = 0.5 * Vec<2>(std::cos(0.5 * rate), std::sin(0.5 * rate));
    EXPECT_LT((engine->snapshot().position[1] - Vec<2>(20, 20) - arm).norm(), 1e-12);
    EXPECT_LT((engine->snapshot().velocity[1] - cross(rate, arm)).norm(), 1e-12);
    EXPECT_NEAR(engine->snapshot().spin[0], rate, 1e-12);
  }
}

TEST(RigidBody, TurnsAboutAnAxisOrFreelyInSpace) {
  for (const EngineKind kind : both_engines)
    for (const bool hinge : {false, true}) {
      SCOPED_TRACE(to_string(kind) + (hinge ? " about z" : " freely"));
      Scene scene = body_scene(3);
      scene.bodies = {free_body(3, "wheel")};
      if (hinge) scene.bodies[0].free_rotation = {false, false, true};
      scene.bodies[0].torque = {0, 0, 0.3};
      const auto engine = make_engine<3>(kind, scene, dumbbell_sample<3>(Vec<3>(1, 0, 0)));
      engine->advance(1000);
      EXPECT_LT((engine->snapshot().bodies[0].spin - Vec<3>(0, 0, 0.3 / 0.7)).norm(), 1e-12);
    }
}

TEST(RigidBody, AHingeTakesTheTorqueAcrossIt) {
  // A dumbbell askew to its hinge: e.I e = I_1 sin^2 + I_3 cos^2 with I_1 = 0.7 and I_3 = 0.2 about its own line.
  for (const EngineKind kind : both_engines) {
    Scene scene = body_scene(3);
    scene.bodies = {free_body(3, "wheel")};
    scene.bodies[0].free_rotation = {false, false, true};
    scene.bodies[0].torque = {0, 0, 0.3};
    const double angle = 0.4;
    const auto engine = make_engine<3>(kind, scene, dumbbell_sample<3>(Vec<3>(std::sin(angle), 0, std::cos(angle))));
    engine->advance(1000);
    const double inertia = 0.7 * std::pow(std::sin(angle), 2) + 0.2 * std::pow(std::cos(angle), 2);
    EXPECT_LT((engine->snapshot().bodies[0].spin - Vec<3>(0, 0, 0.3 / inertia)).norm(), 1e-12) << to_string(kind);
  }
}

TEST(RigidBody, MassAndInertiaMayBeGiven) {
  for (const EngineKind kind : both_engines) {
    Scene scene = body_scene(3);
    scene.bodies = {free_body(3, "block")};
    scene.bodies[0].mass = 4;
    scene.bodies[0].inertia = {2, 3, 5, 0, 0, 0};
    scene.bodies[0].force = {8, 0, 0};
    scene.bodies[0].torque = {0, 6, 0};
    const auto engine = make_engine<3>(kind, scene, dumbbell_sample<3>(Vec<3>(1, 0, 0)));
    engine->advance(500);
    EXPECT_LT((engine->snapshot().bodies[0].velocity - Vec<3>(1, 0, 0)).norm(), 1e-12) << to_string(kind);
    EXPECT_LT((engine->snapshot().bodies[0].spin - Vec<3>(0, 1, 0)).norm(), 1e-12) << to_string(kind);
  }
}

// ---- Imposed rotation ----

TEST(RigidBody, ImposedRotationMovesGrainsOnCircles) {
  for (const EngineKind kind : both_engines) {
    SCOPED_TRACE(to_string(kind));
    Scene scene = body_scene(2);
    scene.cell.periodic = {true, true};
    scene.bodies = {{.name = "rotor", .velocity = {3, 1}, .spin = {2}}};
    Sample<2> sample = dumbbell_sample<2>(Vec<2>(1, 0), Vec<2>(2, 2));
    sample.cell = cube<2>(4, true);
    const auto engine = make_engine<2>(kind, scene, sample);
    engine->advance(5000);  // 10 rad, through the cell's borders
    const Snapshot<2> state = engine->snapshot();
    const Vec<2> arm = 0.5 * Vec<2>(std::cos(10), std::sin(10));
    // 5000 roundings of the position of the centre and of the angle.
    EXPECT_LT(lattice_distance<2>(*state.cell, state.position[1], Vec<2>(2, 2) + 5 * Vec<2>(3, 1) + arm), 1e-11);
    EXPECT_LT((state.velocity[1] - Vec<2>(3, 1) - cross(2.0, arm)).norm(), 1e-11);
    EXPECT_EQ(state.contacts->size(), 0u) << "grains of a body don't act on each other";
  }
}

TEST(RigidBody, RollersTurnTheGrainBetweenThem) {
  // A grain in the hollow of two rollers that turn the same way: it stays, turns by the ratio of the radii, and the
  // rollers carry it (each with a tangential force that the laws leave open).
  for (const EngineKind kind : both_engines) {
    SCOPED_TRACE(to_string(kind));
    Scene scene = body_scene(2, 0.5, 0.1);
    scene.material.normal_stiffness = 1e5;
    scene.md.dt = 2e-4;
    scene.cd.tolerance = 1e-9;  // below it only the last digits of two opposed impulses move
    scene.loading.gravity = {0, -gravity};
    scene.bodies = {{.name = "left", .spin = {0.5}}, {.name = "right", .spin = {0.5}}};
    Sample<2> sample;
    sample.cell = cube<2>(40, false);
    sample.resize(3);
    sample.position = {Vec<2>(19.4, 20), Vec<2>(20.6, 20), Vec<2>(20, 20.8)};
    sample.radius = {0.6, 0.6, 0.4};
    sample.body = {0, 1, -1};
    const auto engine = make_engine<2>(kind, scene, sample);
    engine->advance(std::lround(20 / engine->dt()));
    const Snapshot<2> state = engine->snapshot();
    EXPECT_NEAR(state.spin[2], -0.5 * 0.6 / 0.4, 1e-6);
    EXPECT_LT(state.velocity[2].norm(), 1e-6);
    ASSERT_EQ(state.contacts->size(), 2u);
    const Vec<2> carried = state.contacts->force[0] + state.contacts->force[1];
    EXPECT_LT((carried - Vec<2>(0, gravity)).norm(), 1e-6);
  }
}

// ---- Rest and sliding ----

/// A dumbbell that lies on a plane, its centre of mass at a third of the way between the feet.
template <int D>
void check_rest(EngineKind kind) {
  SCOPED_TRACE(to_string(kind) + " D = " + std::to_string(D));
  Scene scene = body_scene(D, 0.5, 0.2);
  scene.md.dt = 5e-4;
  scene.loading.gravity.assign(D, 0);
  scene.loading.gravity.back() = -gravity;
  scene.bodies = {free_body(D, "clump")};
  Sample<D> sample = dumbbell_sample<D>(Vec<D>::Unit(0));
  sample.mass = {2, 1};
  const double height = sample.position[0][D - 1] - 0.5;
  sample.planes.push_back({height * up<D>(), up<D>(), Vec<D>::Zero()});
  const auto engine = make_engine<D>(kind, scene, sample);
  engine->advance(20000);  // md: deflections settle from none, damped
  const Snapshot<D> before = engine->snapshot();
  ASSERT_EQ(before.contacts->size(), 2u);
  EXPECT_NEAR(-before.contacts->force[0][D - 1], 2 * gravity, 1e-8) << "levers of 1/3 and 2/3";
  EXPECT_NEAR(-before.contacts->force[1][D - 1], 1 * gravity, 1e-8);
  const std::vector<Vec<D>> place(before.position.begin(), before.position.end());
  engine->advance(1000);
  for (int k : {0, 1}) {
    EXPECT_LT((engine->snapshot().position[k] - place[k]).norm(), 1e-10) << "at rest";
    EXPECT_LT(engine->snapshot().velocity[k].norm(), 1e-10);
    EXPECT_LT(spin_norm(engine->snapshot().spin[k]), 1e-10);
  }
}

TEST(RigidBody, RestsOnAPlaneAndSharesItsWeight) {
  for (const EngineKind kind : both_engines) check_rest<2>(kind), check_rest<3>(kind);
}

/// A dumbbell that slides along its own line: V = V_0 - mu g t, and the front foot carries M g (1/2 + mu R / d).
template <int D>
void check_sliding(EngineKind kind) {
  SCOPED_TRACE(to_string(kind) + " D = " + std::to_string(D));
  constexpr double friction = 0.3;
  Scene scene = body_scene(D, friction, 0.2);
  scene.material.normal_stiffness = 1e6;
  scene.md.dt = 5e-5;
  scene.loading.gravity.assign(D, 0);
  scene.loading.gravity.back() = -gravity;
  scene.bodies = {free_body(D, "sledge")};
  scene.bodies[0].velocity.assign(D, 0);
  scene.bodies[0].velocity[0] = 1;
  Sample<D> sample = dumbbell_sample<D>(Vec<D>::Unit(0));
  sample.planes.push_back({(sample.position[0][D - 1] - 0.5) * up<D>(), up<D>(), Vec<D>::Zero()});
  const auto engine = make_engine<D>(kind, scene, sample);
  engine->advance(std::lround(1 / engine->dt()));  // md: feet sink meanwhile, and friction is not yet mu M g
  const double before = engine->snapshot().bodies[0].velocity[0];
  engine->advance(std::lround(1 / engine->dt()));
  const Snapshot<D> state = engine->snapshot();
  // md: what is left of the bouncing of the start.
  EXPECT_NEAR(state.bodies[0].velocity[0] - before, -friction * gravity, kind == EngineKind::md ? 1e-7 : 1e-8);
  EXPECT_LT(spin_norm(state.bodies[0].spin), 1e-8);
  ASSERT_EQ(state.contacts->size(), 2u);
  // md: the deflections, 1e-6, shorten the lever of friction.
  const double error = kind == EngineKind::md ? 2e-6 : 1e-8;
  EXPECT_NEAR(-state.contacts->force[1][D - 1], 2 * gravity * (0.5 + friction * 0.5), error);
  EXPECT_NEAR(-state.contacts->force[0][D - 1], 2 * gravity * (0.5 - friction * 0.5), error);
}

TEST(RigidBody, SlidesWithItsLoadOnTheFrontFoot) {
  for (const EngineKind kind : both_engines) check_sliding<2>(kind), check_sliding<3>(kind);
}

// ---- A top without torque ----

TEST(RigidBody, SymmetricTopPrecessesAboutItsMomentum) {
  // The dumbbell's line e turns about J with |J| / I_1, and w = J / I_1 + (1/I_3 - 1/I_1) (J.e) e.
  for (const EngineKind kind : both_engines) {
    SCOPED_TRACE(to_string(kind));
    Scene scene = body_scene(3);
    scene.bodies = {free_body(3, "top")};
    scene.bodies[0].spin = {1.5, -0.7, 2.2};
    set_dt(scene, 0.01);
    scene.md.allow_unsafe_dt = true;  // there are no contacts
    const Vec<3> start = generic_direction<3>(), spin(1.5, -0.7, 2.2);
    const double across = 0.7, along = 0.2;
    const Vec<3> momentum = across * spin + (along - across) * spin.dot(start) * start;
    const auto engine = make_engine<3>(kind, scene, dumbbell_sample<3>(start));
    engine->advance(1000);  // 30 rad
    const double angle = momentum.norm() / across * 10;
    const Vec<3> line = Eigen::AngleAxisd(angle, momentum.normalized()) * start;
    const Vec<3> expected = momentum / across + (1 / along - 1 / across) * momentum.dot(line) * line;
    const Snapshot<3> state = engine->snapshot();
    // Exact for symmetric tops: 1000 roundings of an angle.
    EXPECT_LT((state.bodies[0].spin - expected).norm(), 1e-11);
    EXPECT_LT((state.position[1] - state.position[0] - line).norm(), 1e-11);
    EXPECT_LT((angular_momentum(state.bodies[0]) - momentum).norm(), 1e-12);
  }
}

TEST(RigidBody, AnyTopKeepsItsMomentumAndItsEnergyToSecondOrder) {
  for (const EngineKind kind : both_engines) {
    SCOPED_TRACE(to_string(kind));
    std::vector<double> step, worst;
    for (const double dt : {0.02, 0.01, 0.005}) {
      Scene scene = body_scene(3);
      scene.bodies = {free_body(3, "top")};
      scene.bodies[0].spin = {0.02, 2, 0.01};  // about the middle axis: it tumbles
      scene.bodies[0].inertia = {1, 2, 2.5, 0.1, 0, 0.05};
      set_dt(scene, dt);
      scene.md.allow_unsafe_dt = true;
      const auto engine = make_engine<3>(kind, scene, dumbbell_sample<3>(Vec<3>(1, 0, 0)));
      const Vec<3> momentum = angular_momentum(engine->snapshot().bodies[0]);
      const double energy = engine->energy().rotational;
      double error = 0, half = 0, least = 1, most = -1;
      const int count = static_cast<int>(std::lround(60 / dt));
      for (int k = 0; k < count; ++k) {
        engine->advance(1);
        error = std::max(error, std::abs(engine->energy().rotational / energy - 1));
        least = std::min(least, rotation_of(engine->snapshot().bodies[0])(1, 1));
        most = std::max(most, rotation_of(engine->snapshot().bodies[0])(1, 1));
        if (k == count / 2) half = error;
      }
      EXPECT_LT(least, -0.9) << "the middle axis turned over";
      EXPECT_GT(most, 0.9);
      EXPECT_LT((angular_momentum(engine->snapshot().bodies[0]) - momentum).norm(), 1e-11);
      EXPECT_LT(error, 1.3 * half) << "no drift";
      step.push_back(dt), worst.push_back(error);
    }
    EXPECT_NEAR(observed_order(step, worst), 2, 0.1);
  }
}

}  // namespace
}  // namespace galet::test::rigid_body_test
