// Impacts of rigid grains over a map of (mu, e_N, e_T, angle), against Walton's three-parameter model (Walton 1993):
//   u_N' = e_N v_n,   J_n = m* (1 + e_N) v_n
//   u_T' = -e_T v_t                             where the impulse that takes, m_T (1 + e_T) v_t, is below mu J_n
//   u_T' = v_t - mu (1 + e_N) (m*/m_T) v_n      where it is above, J_t = mu J_n
// with v_n the speed of approach, v_t the slip of the contact points, 1/m_T = 1/m* + R_i^2/I_i + R_j^2/I_j (m*/m_T = 3
// for disks, 7/2 for spheres).
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/support/scenes.hpp"

namespace galet::test::cd_impact_test {
namespace {

struct Impact {
  double friction, e_n, e_t, angle;
};

std::vector<Impact> impact_map() {
  std::vector<Impact> map;
  for (double friction : {0.0, 0.1, 0.4, 1.0})
    for (double e_n : {0.0, 0.3, 0.8, 1.0})
      for (double e_t : {0.0, 0.4, 1.0})
        for (double angle : {0.0, 0.2, 0.7, 1.2, 1.5}) map.push_back({friction, e_n, e_t, angle});
  return map;
}

/// What a pair (or ball and plane) does in one step with unit approach speed: slip velocity of j's contact point seen
/// from i's, spins included.
template <int D>
struct Outcome {
  Vec<D> slip;  ///< relative velocity of the contact points
  Vec<D> impulse;
  double inverse_mass = 0, inverse_tangential_mass = 0;
};

template <int D>
Vec<D> contact_velocity(const Snapshot<D>& state, const Sample<D>& sample, const Vec<D>& n) {
  Spin<D> rolling = zero_spin<D>();
  for (int i = 0; i < sample.count(); ++i) rolling += sample.radius[i] * state.spin[i];
  return relative_velocity<D>(state) - cross(rolling, n);
}

template <int D>
void check(const Impact& impact, bool plane) {
  SCOPED_TRACE(fmt::format("D = {} mu = {} e_N = {} e_T = {} angle = {} plane = {}", D, impact.friction, impact.e_n,
                           impact.e_t, impact.angle, plane));
  constexpr double dt = 1e-12;  // impacts take no time; so short that normals do not turn
  Scene scene = free_scene(D, impact.friction, impact.e_n, 1e4);
  scene.material.tangential_restitution = impact.e_t;
  scene.cd.dt = dt;
  scene.cd.tolerance = 1e-13;
  const Vec<D> n = generic_direction<D>();
  Sample<D> sample = plane ? ball_on_plane<D>(Vec<D>(-n), 0, 0.6, 1.7) : pair_sample<D>(n, 0, {0.4, 0.6}, {0.7, 1.9});
  // The slip comes from velocities and spins: rotations give a third of it.
  const double v_n = std::cos(impact.angle), v_t = std::sin(impact.angle);
  const Vec<D> t = generic_tangent<D>(n);
  set_relative_velocity<D>(sample, Vec<D>(-v_n * n + 2.0 / 3 * v_t * t));
  // u_T = (v_j - v_i) - R_i w_i x n, and (n x t) x n = t.
  if (impact.friction > 0) sample.spin[0] = -v_t / (3 * sample.radius[0]) * cross(n, t);
  const auto engine = make_engine<D>(EngineKind::cd, scene, sample);
  const Vec<D> expected_start = -v_n * n + (impact.friction > 0 ? 1 : 2.0 / 3) * v_t * t;
  double inverse_mass = 0, turning = 0;
  for (int i = 0; i < sample.count(); ++i) inverse_mass += 1 / sample.mass[i];
  turning = inverse_mass / inertia_ratio<D>;
  const double inverse_tangential = inverse_mass + turning;
  engine->advance(1);
  const Snapshot<D> state = engine->snapshot();

  const double j_n = (1 + impact.e_n) * v_n / inverse_mass;
  const double slip = t.dot(expected_start);
  const double wanted = (1 + impact.e_t) * slip / inverse_tangential;
  const double j_t = std::min(wanted, impact.friction * j_n);
  // One contact is solved in closed form: what is left is rounding, and the turn of the normal in one step.
  constexpr double tolerance = 5e-12;
  ASSERT_EQ(state.contacts->size(), 1u);
  const Vec<D> force = state.contacts->force[0] * dt;
  EXPECT_NEAR(force.dot(n), j_n, tolerance);
  EXPECT_NEAR((force - force.dot(n) * n + j_t * t).norm(), 0, tolerance);
  if (impact.friction == 0) {  // spins are not computed
    EXPECT_NEAR(relative_velocity<D>(state).dot(n), impact.e_n * v_n, tolerance);
    return;
  }
  const Vec<D> after = contact_velocity<D>(state, sample, n);
  EXPECT_NEAR(after.dot(n), impact.e_n * v_n, tolerance);
  const double slip_after = wanted <= impact.friction * j_n ? -impact.e_t * slip : slip - j_t * inverse_tangential;
  EXPECT_NEAR((after - after.dot(n) * n - slip_after * t).norm(), 0, tolerance);
}

TEST(ImpactCd, MapFollowsWalton) {
  int sticking = 0, sliding = 0;
  for (const Impact& impact : impact_map()) {
    if (impact.angle == 1.5 && impact.e_n == 0) continue;  // a grazing contact without rebound is not told from rest
    for (bool plane : {false, true}) {
      check<2>(impact, plane);
      check<3>(impact, plane);
    }
    const double limit = impact.friction * (1 + impact.e_n) * 3.5 / (1 + impact.e_t);
    (std::tan(impact.angle) < limit ? sticking : sliding) += 1;
  }
  EXPECT_GT(sticking, 50);
  EXPECT_GT(sliding, 50);
}

/// Cradles (Moreau's law acts at all contacts at once where balls touch): n balls in contact, hit by the first, leave
/// with ((2 - n)/n, 2/n, ..., 2/n) for e = 1 and all with 1/n for e = 0; with gaps the last ball takes all (e = 1).
std::vector<double> cradle(int balls, double e, double gap) {
  Scene scene = free_scene(2, 0, e, 1e4);
  scene.cd.dt = 1e-2;
  scene.cd.tolerance = 1e-13;
  Sample<2> sample;
  sample.cell = cube<2>(40, false);
  sample.resize(balls);
  for (int k = 0; k < balls; ++k) sample.radius[k] = 0.5, sample.mass[k] = 1;
  for (int k = 0; k < balls; ++k) sample.position[k] = Vec<2>(10 + k * (1 + gap), 20);
  sample.velocity[0] = Vec<2>(1, 0);
  const auto engine = make_engine<2>(EngineKind::cd, scene, sample);
  engine->advance(gap > 0 ? 500 : 1);
  std::vector<double> speeds;
  for (const Vec<2>& v : engine->snapshot().velocity) speeds.push_back(v.x());
  return speeds;
}

TEST(ImpactCd, Cradle) {
  for (int n : {2, 3, 5, 8}) {
    const std::vector<double> elastic = cradle(n, 1, 0), dead = cradle(n, 0, 0), gaps = cradle(n, 1, 0.05);
    for (int k = 0; k < n; ++k) {
      // The solver's tolerance, 1e-13, times the condition of a chain, n^2.
      EXPECT_NEAR(elastic[k], k == 0 ? (2.0 - n) / n : 2.0 / n, 1e-11) << n << " balls, " << k;
      EXPECT_NEAR(dead[k], 1.0 / n, 1e-11) << n << " balls, " << k;
      EXPECT_NEAR(gaps[k], k == n - 1 ? 1 : 0, 1e-12) << n << " balls, " << k;
    }
  }
}

/// e_N and e_T of a pair of materials, and of grain and plane.
TEST(ImpactCd, RestitutionOfThePairOfMaterials) {
  Scene scene = free_scene(2, 0.5, 0.9, 1e4);
  scene.cd.dt = 1e-3;
  scene.cd.tolerance = 1e-13;
  scene.other_materials = {{.name = "b", .restitution = 0.5, .tangential_restitution = 0.3}};
  scene.pairs = {{.between = {"default", "b"}, .restitution = 0.25, .tangential_restitution = 0.6}};
  const auto rebound = [&](int a, int b, bool plane) {
    Sample<2> sample = plane ? ball_on_plane<2>(Vec<2>(0, 1), 0) : pair_sample<2>(Vec<2>(0, 1), 0);
    sample.material.assign(sample.count(), a);
    if (plane)
      sample.plane_material = {b};
    else
      sample.material[1] = b;
    const Vec<2> n = plane ? Vec<2>(0, -1) : Vec<2>(0, 1);
    set_relative_velocity<2>(sample, Vec<2>(-n + 0.1 * Vec<2>(1, 0)));
    const auto engine = make_engine<2>(EngineKind::cd, scene, sample);
    engine->advance(1);
    const Vec<2> u = contact_velocity<2>(engine->snapshot(), sample, n);
    return Vec<2>(u.dot(n), -u.x() / 0.1);
  };
  for (bool plane : {false, true}) {
    EXPECT_LT((rebound(0, 0, plane) - Vec<2>(0.9, 0)).norm(), 1e-13);
    EXPECT_LT((rebound(1, 1, plane) - Vec<2>(0.5, 0.3)).norm(), 1e-13);
    EXPECT_LT((rebound(0, 1, plane) - Vec<2>(0.25, 0.6)).norm(), 1e-13);
    EXPECT_LT((rebound(1, 0, plane) - Vec<2>(0.25, 0.6)).norm(), 1e-13);
  }
}

}  // namespace
}  // namespace galet::test::cd_impact_test
