// Rolling and pivoting resistance of rigid bodies (k = I / (M R^2), s the lever from contact point to centre).
//   one grain:  a body made of one grain moves as that grain, with every other term of the law
//   ring:       down a slope with a = (g sin(theta) - (mu_R / R) g cos(theta)) / (1 + k); rests below tan(theta) = mu_R
//               / R; k = 1 for a ring
//   axle:       two spheres glued side by side roll together, k of their common axis
//   standing:   a dumbbell on one foot, its axis tilted by phi, stands iff R sin(phi) <= mu_R; else from rest
//               dw/dt = M g (R sin(phi) - mu_R) / (I + M s^2 - mu_R M R sin(phi))    (the load is M (g - R sin(phi)
//               dw/dt))
//   pivoting:   dw/dt = -mu_P N / I about the normal
// Resistances are dry, so that cd has these to rounding; md has them to second order in dt and to the deflections.
#include <gtest/gtest.h>

#include "tests/support/rigid_bodies.hpp"

namespace galet::test::clump_rolling_test {
namespace {

constexpr double radius = 0.5;

Scene rolling_scene(int dim, double friction, double rolling, double pivoting = 0) {
  Scene scene = free_scene(dim, friction, 0, 1e5);
  scene.material.rolling_friction = rolling;
  if (dim == 3) scene.material.pivoting_friction = pivoting;
  scene.cd.dt = 1e-3;
  scene.cd.tolerance = 1e-13;
  scene.cd.max_sweeps = 10000;
  return scene;
}

template <int D>
void set_slope(Scene& scene, double theta, const Vec<D>& along) {
  const Vec<D> g = -std::cos(theta) * up<D>() + std::sin(theta) * along;
  scene.loading.gravity.assign(g.data(), g.data() + D);
}

/// The terms that a contact of cd may have, each with rolling and pivoting resistance.
struct Term {
  const char* name;
  void (*add)(Scene&);
};
constexpr std::array terms{
    Term{"no other term", [](Scene&) {}},
    Term{"restitution",
         [](Scene& scene) {
           scene.material.restitution = 0.6;
           scene.material.tangential_restitution = 0.4;
         }},
    Term{"cohesion with range",
         [](Scene& scene) {
           scene.material.cohesion_force = 0.5;
           scene.material.cohesion_range = 0.05;
         }},
    Term{"compliance",
         [](Scene& scene) {
           scene.material.convention = DampingConvention::total;
           scene.material.restitution = 0.3;
           scene.cd.compliance = true;
         }},
    Term{"Hertz compliance",
         [](Scene& scene) {
           scene.material.normal_law = NormalLaw::hertz;
           scene.material.normal_stiffness.reset();
           scene.material.young_modulus = 1e5;
           scene.material.convention = DampingConvention::total;
           scene.cd.compliance = true;
         }},
};

/// A grain that falls on a slope, rebounds, slides, rolls and pivots. (Grains that meet: clump_cell_test.cpp.)
template <int D>
void check_one_grain(const Term& term) {
  SCOPED_TRACE(std::string(term.name) + ", D = " + std::to_string(D));
  Scene scene = rolling_scene(D, 0.3, 0.04, 0.03);
  const Vec<D> along = generic_tangent<D>(up<D>());
  set_slope<D>(scene, 0.1, along);
  term.add(scene);
  Sample<D> sample = ball_on_plane<D>(up<D>(), 0.02);
  sample.velocity[0] = 0.5 * along - 0.3 * up<D>();
  if constexpr (D == 2)
    sample.spin[0] = 3;
  else
    sample.spin[0] = Vec<3>(2, -1, 3);
  const auto grain = make_engine<D>(EngineKind::cd, scene, sample);
  scene.bodies = {free_body(D, "clump")};
  const Vec<D> v = sample.velocity[0];
  scene.bodies[0].velocity.assign(v.data(), v.data() + D);
  if constexpr (D == 2)
    scene.bodies[0].spin = {sample.spin[0]};
  else
    scene.bodies[0].spin = {sample.spin[0].x(), sample.spin[0].y(), sample.spin[0].z()};
  sample.body = {0};
  const auto clump = make_engine<D>(EngineKind::cd, scene, sample);
  const Vec<D> start = sample.position[0];
  grain->advance(800), clump->advance(800);
  const Snapshot<D> a = grain->snapshot(), b = clump->snapshot();
  EXPECT_GT((a.position[0] - start).norm(), 0.05);
  // 800 steps, each solved to 1e-13 of its impulses (elastic ones: forces above the load by K h of 1e-11).
  EXPECT_LT((a.position[0] - b.position[0]).norm(), 1e-9);
  EXPECT_LT((a.velocity[0] - b.velocity[0]).norm(), 1e-9);
  EXPECT_LT(spin_norm(Spin<D>(a.spin[0] - b.spin[0])), 1e-8);
}

TEST(ClumpRolling, OfOneGrainIsThatOfTheGrainCd) {
  for (const Term& term : terms) check_one_grain<2>(term), check_one_grain<3>(term);
}

/// A ring: one grain whose body has M R^2 for its moments.
template <int D>
void check_ring(EngineKind kind) {
  SCOPED_TRACE(to_string(kind) + " D = " + std::to_string(D));
  constexpr double rolling = 0.1, k = 1, stiffness = 1e7;
  const Vec<D> along = generic_tangent<D>(up<D>());
  for (const double share : {0.99, 1.01, 1.5}) {
    const double theta = std::atan(share * rolling / radius);
    Scene scene = rolling_scene(D, 0.6, rolling);
    scene.material.normal_stiffness = stiffness;
    set_slope<D>(scene, theta, along);
    scene.bodies = {free_body(D, "ring")};
    scene.bodies[0].inertia.assign(D == 2 ? 1 : 3, radius * radius);
    if (D == 3) scene.bodies[0].inertia = {radius * radius, radius * radius, radius * radius, 0, 0, 0};
    Sample<D> sample = ball_on_plane<D>(up<D>(), kind == EngineKind::md ? -std::cos(theta) / stiffness : 0);
    sample.body = {0};
    const auto engine = make_engine<D>(kind, scene, sample);
    engine->advance(std::lround(2 / engine->dt()));
    const double speed = engine->snapshot().bodies[0].velocity.dot(along);
    const double a = (std::sin(theta) - rolling / radius * std::cos(theta)) / (1 + k);
    // md: the spring of rolling, K_R = K_N mu_R^2, has no dashpot: it swings with what gravity alone would give in 1 /
    // omega, and keeps up to that behind where it yields. Twice.
    const double swing = std::sin(theta) / (1 + k) / std::sqrt(stiffness * rolling * rolling / (2 * radius * radius));
    EXPECT_NEAR(speed, share < 1 ? 0 : 2 * a, kind == EngineKind::cd ? 1e-11 : 2 * swing) << share;
  }
}

TEST(ClumpRolling, RingOnASlope) {
  for (EngineKind kind : both_engines) check_ring<2>(kind), check_ring<3>(kind);
}

/// Two spheres side by side: N and the resistance are shared, the sum is what one of the whole mass would have.
TEST(ClumpRolling, AxleOnASlopeCd) {
  constexpr double rolling = 0.1, k = 0.4;
  const Vec<3> along = Vec<3>::Unit(0), across = Vec<3>::Unit(1);
  for (const double share : {0.99, 1.01, 1.5}) {
    const double theta = std::atan(share * rolling / radius);
    Scene scene = rolling_scene(3, 0.6, rolling, 0.05);
    set_slope<3>(scene, theta, along);
    scene.bodies = {free_body(3, "axle")};
    Sample<3> sample = dumbbell_sample<3>(across);
    sample.planes.push_back({Vec<3>(sample.position[0] - radius * up<3>()), up<3>(), Vec<3>::Zero()});
    const auto engine = make_engine<3>(EngineKind::cd, scene, sample);
    engine->advance(500);
    const Snapshot<3> state = engine->snapshot();
    const double a = (std::sin(theta) - rolling / radius * std::cos(theta)) / (1 + k);
    EXPECT_NEAR(state.bodies[0].velocity.dot(along), share < 1 ? 0 : 0.5 * a, 1e-9) << share;
    EXPECT_NEAR(state.bodies[0].velocity.dot(across), 0, 1e-9);
    ASSERT_EQ(state.contacts->size(), 2u);
    double torque = 0;
    for (int c : {0, 1}) torque += std::abs(state.contacts->torque[c].dot(across));
    if (share > 1) {
      EXPECT_NEAR(torque, 2 * rolling * std::cos(theta), 1e-8) << "mu_R times the weight";
    }
  }
}

/// The angle is given through its sine, in units of mu_R / R.
template <int D>
void check_standing() {
  SCOPED_TRACE("D = " + std::to_string(D));
  constexpr double rolling = 0.1, mass = 2, inertia = D == 2 ? 0.75 : 0.7;
  const Vec<D> along = generic_tangent<D>(up<D>());
  for (const double share : {0.99, 1.01, 2.0}) {
    Scene scene = rolling_scene(D, 0.9, rolling, 0.05);
    set_slope<D>(scene, 0, along);
    scene.bodies = {free_body(D, "dumbbell")};
    const double sine = share * rolling / radius, cosine = std::sqrt(1 - sine * sine);
    Sample<D> sample = dumbbell_sample<D>(sine * along + cosine * up<D>());
    sample.planes.push_back({Vec<D>(sample.position[0] - radius * up<D>()), up<D>(), Vec<D>::Zero()});
    const auto engine = make_engine<D>(EngineKind::cd, scene, sample);
    if (share < 1) {
      engine->advance(5000);
      const RigidBody<D> body = engine->snapshot().bodies[0];
      EXPECT_LT(body.velocity.norm(), 1e-13);
      EXPECT_LT(spin_norm(body.spin), 1e-13);
      continue;
    }
    engine->advance(1);
    const double lever = radius * radius * (2 + 2 * cosine);  // |s|^2
    const double expected =
        mass * (radius * sine - rolling) / (inertia + mass * lever - rolling * mass * radius * sine);
    // The first step is exact; in 3D its inertia is turned by dt w in its course, (dt w)^2 of the spin.
    EXPECT_NEAR(spin_norm(engine->snapshot().bodies[0].spin), 1e-3 * expected, 1e-12) << share;
  }
}

TEST(ClumpRolling, DumbbellStandsOnOneFootCd) {
  check_standing<2>();
  check_standing<3>();
}

TEST(ClumpRolling, PivotingStopsADumbbellOnOneFootCd) {
  constexpr double pivoting = 0.03, mass = 2, inertia = 2 * 0.4 * radius * radius, w0 = 2;
  Scene scene = rolling_scene(3, 0.5, 0.2, pivoting);
  set_slope<3>(scene, 0, Vec<3>::Unit(0));
  scene.bodies = {free_body(3, "dumbbell")};
  scene.bodies[0].spin = {0, 0, w0};
  Sample<3> sample = dumbbell_sample<3>(up<3>());
  sample.planes.push_back({Vec<3>(sample.position[0] - radius * up<3>()), up<3>(), Vec<3>::Zero()});
  const auto engine = make_engine<3>(EngineKind::cd, scene, sample);
  engine->advance(1000);
  EXPECT_NEAR(engine->snapshot().bodies[0].spin.z(), w0 - pivoting * mass / inertia, 1e-11);
  engine->advance(std::lround(1000 * w0 * inertia / (pivoting * mass)));
  EXPECT_LT(engine->snapshot().bodies[0].spin.norm(), 1e-12);
  EXPECT_LT(engine->snapshot().bodies[0].velocity.norm(), 1e-12);
}

/// On an elastic foot the dumbbell rolls until the torque K_R alpha = M g R sin(phi + alpha) holds it.
template <int D>
void check_elastic_foot() {
  SCOPED_TRACE("D = " + std::to_string(D));
  constexpr double rolling = 0.1, mass = 2, stiffness = 1e5, turning = stiffness * rolling * rolling;
  const Vec<D> along = generic_tangent<D>(up<D>());
  Scene scene = rolling_scene(D, 0.9, rolling, 0.05);
  scene.material.convention = DampingConvention::total;
  scene.cd.compliance = true;
  scene.cd.dt = 0.05;
  set_slope<D>(scene, 0, along);
  scene.bodies = {free_body(D, "dumbbell")};
  const double phi = std::asin(0.5 * rolling / radius);
  Sample<D> sample = dumbbell_sample<D>(std::sin(phi) * along + std::cos(phi) * up<D>());
  sample.planes.push_back({Vec<D>(sample.position[0] - radius * up<D>()), up<D>(), Vec<D>::Zero()});
  const auto engine = make_engine<D>(EngineKind::cd, scene, sample);
  engine->advance(4000);
  double alpha = 0;
  for (int round = 0; round < 50; ++round) alpha = mass * radius * std::sin(phi + alpha) / turning;
  const Snapshot<D> state = engine->snapshot();
  EXPECT_LT(spin_norm(state.bodies[0].spin), 1e-11);
  const Vec<D> axis = state.position[1] - state.position[0];
  // Deflections of the foot and rounding of positions of order 20 turn it by less than 1e-12.
  EXPECT_NEAR(std::atan2(axis.dot(along), axis.dot(up<D>())), phi + alpha, 1e-9);
  EXPECT_NEAR(engine->energy().elastic_rolling, 0.5 * turning * alpha * alpha, 1e-6 * turning * alpha * alpha);
}

TEST(ClumpRolling, ElasticFootCd) {
  check_elastic_foot<2>();
  check_elastic_foot<3>();
}

/// With one e = e_T for all contacts a step makes no energy, whatever the bodies are and resist.
template <int D>
void check_energy(double e) {
  SCOPED_TRACE("D = " + std::to_string(D) + ", e = " + std::to_string(e));
  auto [scene, sample] = clump_gas<D>(D == 2 ? 4 : 3, 3, 85);
  resist_rolling(scene);
  scene.material.restitution = scene.material.tangential_restitution = e;
  scene.cd.tolerance = 1e-10;
  scene.cd.max_sweeps = 20000;
  scene.cd.dt = 4e-3;
  const auto engine = make_engine<D>(EngineKind::cd, scene, sample);
  const double start = engine->energy().total();
  double before = start;
  for (int step = 0; step < 1000; ++step) {
    engine->advance(1);
    const double now = engine->energy().total();
    // The solver's error, and in 3D that of free rotation, of second order and bounded (theory): 1e-5 of a body's
    // energy.
    EXPECT_LT(now, before + (D == 2 ? 1e-9 : 1e-5) * start) << "step " << step;
    before = now;
  }
  EXPECT_LT(before, 0.9 * start) << "enough happened";
  EXPECT_LT(engine->solver_summary().gained, 1e-9 * start) << "contacts make none";
}

TEST(ClumpRolling, MakesNoEnergyCd) {
  for (const double e : {0.0, 0.5, 0.9}) check_energy<2>(e), check_energy<3>(e);
}

}  // namespace
}  // namespace galet::test::clump_rolling_test
