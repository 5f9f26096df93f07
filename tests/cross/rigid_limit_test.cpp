// Soft grains approach rigid ones as they get stiffer: md against cd on small problems that both engines define
// uniquely. Stiffness level of a problem with speed v: kappa = K d^2 / (m v^2), here d = m = 1 and v about 1.
//
// What separates the engines: md spends a time pi sqrt(m*/K) in contact, so positions and directions differ by an
// amount of order kappa^(-1/2), i.e. by 10 from kappa = 1e3 to 1e5. cd takes steps of 1e-5, far below that.
#include <gtest/gtest.h>

#include "tests/support/planar_impact.hpp"
#include "tests/support/scenes.hpp"

namespace galet::test::rigid_limit_test {
namespace {

constexpr std::array kappas{1e3, 1e4, 1e5};
constexpr double rigid_dt = 1e-5;

/// Positions, velocities and spins at the end of a run, as one list of numbers.
std::vector<double> final_state(EngineKind kind, Scene scene, const Sample<2>& sample, double duration, double kappa) {
  scene.material.normal_stiffness = kappa;
  scene.md.steps_per_contact = 400;  // the error of md's own step (up to zeta w0 dt per impact) stays below 0.2 %
  scene.cd.dt = rigid_dt;
  scene.cd.tolerance = 1e-10;
  const auto engine = make_engine<2>(kind, scene, sample);
  engine->advance(std::lround(duration / engine->dt()));
  const Snapshot<2> state = engine->snapshot();
  std::vector<double> numbers;
  for (int i = 0; i < state.grains(); ++i) {
    // The last step ends within dt of `duration`: positions are taken at the duration itself.
    const Vec<2> position = state.position[i] + (duration - engine->time()) * state.velocity[i];
    numbers.insert(numbers.end(), {position.x(), position.y(), state.velocity[i].x(), state.velocity[i].y()});
    if (!state.spin.empty()) numbers.push_back(state.spin[i] * state.radius[i]);
  }
  return numbers;
}

/// Norm of the difference between md and cd for each stiffness.
std::array<double, 3> distances(const Scene& scene, const Sample<2>& sample, double duration) {
  const std::vector<double> rigid = final_state(EngineKind::cd, scene, sample, duration, kappas[0]);
  std::array<double, 3> distance{};
  for (std::size_t level = 0; level < 3; ++level) {
    const std::vector<double> soft = final_state(EngineKind::md, scene, sample, duration, kappas[level]);
    for (std::size_t k = 0; k < rigid.size(); ++k) distance[level] += std::pow(soft[k] - rigid[k], 2);
    distance[level] = std::sqrt(distance[level]);
  }
  return distance;
}

/// The difference falls with every decade of kappa, by 10 in all if it goes like kappa^(-1/2); half an order is left
/// for what a contact of finite duration does beyond the leading term.
void expect_convergence(const std::array<double, 3>& distance, double last) {
  SCOPED_TRACE(std::to_string(distance[0]) + " " + std::to_string(distance[1]) + " " + std::to_string(distance[2]));
  EXPECT_GT(distance[0], 1e-4);  // or nothing was compared
  EXPECT_LT(distance[1], distance[0]);
  EXPECT_LT(distance[2], distance[1]);
  EXPECT_LT(distance[2], distance[0] / 5);
  EXPECT_LT(distance[2], last);
}

TEST(RigidLimit, CascadeOfThreeBallsWithGaps) {
  Sample<2> sample;
  sample.cell = cube<2>(20, false);
  sample.resize(3);
  for (int i = 0; i < 3; ++i) sample.position[i] = Vec<2>(5 + 1.2 * i, 10);
  sample.velocity[0] = Vec<2>(1, 0);
  const Scene scene = free_scene(2, 0, 0.8, 1);
  // Two contacts of pi sqrt(1 / 2e5) = 0.007 each, during which three balls are displaced by about half of that.
  expect_convergence(distances(scene, sample, 1), 0.02);
}

TEST(RigidLimit, ObliqueImpactSlidingThroughout) {
  // Slip 3 times what sticking could stop: the impulses are (1 + e) m* v_n and mu times that in both engines, and
  // what differs is that the normal turns by v_t t_c / d while soft grains touch.
  Sample<2> sample = pair_sample<2>(generic_direction<2>(), 0.02, {0.5, 0.4}, {1, 0.7});
  const Vec<2> n = generic_direction<2>();
  set_relative_velocity<2>(sample, Vec<2>(-n + 1.5 * generic_tangent<2>(n)));
  sample.spin[0] = -1;
  const Scene scene = free_scene(2, 0.1, 0.6, 1);
  expect_convergence(distances(scene, sample, 0.4), 0.05);
}

/// Tangential over normal impulse of an impact with twice as much slip as approach, between equal disks. The tangential
/// one is what turns them, wherever the normal is while they touch.
double impulse_ratio(EngineKind kind, const Scene& scene, double kappa) {
  const Vec<2> n = generic_direction<2>();
  Sample<2> sample = pair_sample<2>(n, 1e-5, {0.5, 0.5}, {1, 1});
  set_relative_velocity<2>(sample, Vec<2>(-n + 2 * generic_tangent<2>(n)));
  const std::vector<double> end = final_state(kind, scene, sample, 0.4, kappa);
  const double impulse = (Vec<2>(end[2], end[3]) - sample.velocity[0]).norm();
  const double tangential = inertia_ratio<2> * std::abs(end[4]);
  return tangential / std::sqrt(impulse * impulse - tangential * tangential);
}

TEST(RigidLimit, StronglyDampedImpactsTakeLessThanMuUnlessSlidingIsDampedToo) {
  // The normal force is viscous from the first instant on, the tangential spring has yet to stretch: at any stiffness
  // the impact takes a tangential impulse below mu times the normal one (docs/theory.md, "Rigid limit").
  constexpr double zeta = 1.24319;  // e = 0.1
  Scene scene = free_scene(2, 0.4, 0.1, 1);
  scene.material.convention = DampingConvention::total;
  scene.material.restitution.reset();
  scene.material.damping_ratio = zeta;
  const PlanarBodies disks{{0.5, 0.5}, {1, 1}, inertia_ratio<2>, false, Vec<2>(1, 0)};
  const auto oracle = [&](double zeta_t) {
    const PlanarLaw law{NormalLaw::linear, DampingConvention::total, 1e8, 0.5, zeta, zeta_t, 0.4, true};
    PlanarState touching;
    touching.x = Vec<2>(1, 0), touching.u = Vec<2>(-1, 2);
    const PlanarState end = PlanarImpact(law, disks).run(touching, 1e-8);
    return std::abs((end.u.y() - 2) / (end.u.x() + 1));
  };
  EXPECT_NEAR(impulse_ratio(EngineKind::cd, scene, 1), 0.4, 1e-9);
  for (const double zeta_t : {0.0, 1.0}) {
    scene.material.tangential_damping_ratio = zeta_t;
    const double limit = oracle(zeta_t);
    EXPECT_NEAR(limit, zeta_t > 0 ? 0.4 : 0.226, 0.002);
    for (const double kappa : kappas) {
      SCOPED_TRACE("kappa " + std::to_string(kappa) + ", zeta_T " + std::to_string(zeta_t));
      // The normal turns by v_T t_c / d while the disks touch, with t_c = 2.4 / sqrt(kappa).
      EXPECT_NEAR(impulse_ratio(EngineKind::md, scene, kappa), limit, 1 / std::sqrt(kappa));
    }
  }
}

TEST(RigidLimit, BallSlidesThenRolls) {
  // The soft ball loads its tangential spring first and rings around rolling with a velocity mu g / sqrt(3 K / 2).
  Scene scene = free_scene(2, 0.3, 0.2, 1);
  scene.loading.gravity = {0, -1};
  Sample<2> sample = ball_on_plane<2>(up<2>(), 0.0);
  sample.velocity[0] = Vec<2>(1, 0);
  expect_convergence(distances(scene, sample, 2), 0.01);
}

TEST(RigidLimit, BallBouncesDownASlope) {
  // Several impacts, each with sliding friction, on a slope too steep to stick to.
  Scene scene = free_scene(2, 0.1, 0.7, 1);
  scene.loading.gravity = {0.8, -0.6};
  Sample<2> sample = ball_on_plane<2>(up<2>(), 0.3);
  expect_convergence(distances(scene, sample, 3.5), 0.2);
}

/// Statics: the forces in a V groove. A ball on two walls at 90 degrees without friction: each carries m g / sqrt(2).
TEST(RigidLimit, BallInAGroove) {
  Scene scene = free_scene(2, 0, 0.1, 1);
  scene.loading.gravity = {0, -1};
  Sample<2> sample = ball_on_plane<2>(Vec<2>(std::sqrt(0.5), std::sqrt(0.5)), 0.0);
  sample.planes.push_back({sample.planes[0].point, Vec<2>(-std::sqrt(0.5), std::sqrt(0.5)), Vec<2>::Zero()});
  sample.position[0] = sample.planes[0].point + Vec<2>(0, 0.5 * std::sqrt(2.0));
  for (EngineKind kind : both_engines)
    for (double kappa : kappas) {
      SCOPED_TRACE(to_string(kind) + " kappa " + std::to_string(kappa));
      scene.material.normal_stiffness = kappa;
      scene.cd.dt = 1e-3;
      scene.cd.tolerance = 1e-10;
      const auto engine = make_engine<2>(kind, scene, sample);
      engine->advance(std::lround(3 / engine->dt()));  // e = 0.1: the soft ball has come to rest (exp(-zeta w0 t))
      const Snapshot<2> state = engine->snapshot();
      ASSERT_EQ(state.contacts->size(), 2u);
      for (int side = 0; side < 2; ++side)
        EXPECT_NEAR(state.contacts->force[side].norm(), std::sqrt(0.5), 1e-6) << side;
      // The ball sinks by sqrt(2) h with h = m g / (sqrt(2) K); rigid, not at all (beyond the first step's g dt^2).
      const double sunk = sample.position[0].y() - state.position[0].y();
      EXPECT_NEAR(sunk, kind == EngineKind::md ? 1 / kappa : 0.0, kind == EngineKind::md ? 1e-8 : 2e-6);
    }
}

}  // namespace
}  // namespace galet::test::rigid_limit_test
