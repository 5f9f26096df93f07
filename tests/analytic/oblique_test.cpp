// Frictional impacts (Walton 1993, without tangential restitution): with v_n the normal approach speed, u_T the slip
// velocity, k = I / (m R^2), 1/m* = 1/m_i + 1/m_j,
//   J_n = m* (1 + e) v_n,   J_t = min(mu J_n, m* |u_T| k / (1 + k)), opposed to the slip.
// The second value brings the slip to rest (2/7 m* |u_T| for spheres, 1/3 for disks): the contact sticks.
#include <gtest/gtest.h>

#include "tests/support/scenes.hpp"

namespace galet::test::oblique_test {
namespace {

constexpr double restitution = 0.6;
constexpr double friction = 0.3;

template <int D>
struct State {
  std::vector<Vec<D>> velocity;
  std::vector<Spin<D>> spin;
};

/// R w x n: what a grain's spin takes away from the relative velocity of the contact, the same for both sides.
template <int D>
Vec<D> rim(double radius, const Spin<D>& spin, const Vec<D>& n) {
  return radius * cross(spin, n);
}

/// The closed form, applied to grain 0 and grain 1 (or a plane at rest, when there is one grain only).
template <int D>
State<D> walton(const Sample<D>& sample, const Vec<D>& n) {
  constexpr double k = inertia_ratio<D>;
  const bool pair = sample.count() == 2;
  Vec<D> u = pair ? Vec<D>(sample.velocity[1] - sample.velocity[0]) : Vec<D>(-sample.velocity[0]);
  u -= rim<D>(sample.radius[0], sample.spin[0], n);
  if (pair) u -= rim<D>(sample.radius[1], sample.spin[1], n);
  const double reduced_mass = 1 / (1 / sample.mass[0] + (pair ? 1 / sample.mass[1] : 0));
  const double u_n = u.dot(n);
  const Vec<D> slip = u - u_n * n;
  const double normal_impulse = -reduced_mass * (1 + restitution) * u_n;
  const double sticking_impulse = reduced_mass * k / (1 + k) * slip.norm();
  const double tangential_impulse = std::min(friction * normal_impulse, sticking_impulse);
  Vec<D> r = normal_impulse * n;
  if (slip.norm() > 0) r -= tangential_impulse * slip.normalized();
  State<D> after{sample.velocity, sample.spin};
  for (int side = 0; side < sample.count(); ++side) {
    const double mass = sample.mass[side], radius = sample.radius[side];
    after.velocity[side] += (side == 0 ? -1 : 1) * r / mass;
    const Spin<D> torque = -radius * cross(n, r);
    after.spin[side] += torque / (k * mass * radius * radius);
  }
  return after;
}

template <int D>
Spin<D> spin_across(const Vec<D>& n, double slip_speed) {
  if constexpr (D == 2)
    return slip_speed;
  else
    return Vec<3>(slip_speed * generic_tangent<3>(n) + 0.8 * n);  // with a pivoting part, which nothing may change
}

template <int D>
void expect_walton(const Sample<D>& sample, const Vec<D>& n) {
  Scene scene = free_scene(D, friction, restitution, 1e4);
  scene.cd.tolerance = 1e-13;
  // A step so short that neither the normal nor the lever arms change by more than 1e-11 before the impact is solved.
  scene.cd.dt = 1e-11;
  const auto engine = make_engine<D>(EngineKind::cd, scene, sample);
  engine->advance(1);
  const Snapshot<D> after = engine->snapshot();
  const State<D> expected = walton<D>(sample, n);
  for (int i = 0; i < sample.count(); ++i) {
    EXPECT_LT((after.velocity[i] - expected.velocity[i]).norm(), 1e-10) << "grain " << i;
    EXPECT_LT(spin_norm(after.spin[i] - expected.spin[i]), 1e-10) << "grain " << i;
  }
}

/// Slip speeds from none to far beyond the switch at v_t / v_n = mu (1 + e) (1 + 1/k) (1.44 disks, 1.68 spheres).
constexpr std::array slip_speeds{0.0, 0.4, 1.3, 1.8, 5.0};

template <int D>
void check_rigid_plane() {
  const Vec<D> n = -up<D>();  // from the grain down to the plane
  for (double slip : slip_speeds) {
    SCOPED_TRACE(slip);
    Sample<D> sample = ball_on_plane<D>(up<D>(), 0.0);
    sample.velocity[0] = n + slip * generic_tangent<D>(n);
    expect_walton<D>(sample, n);
    sample.spin[0] = spin_across<D>(n, 2.0);
    expect_walton<D>(sample, n);
  }
}

/// Pairs that meet head-on (so the normal keeps still) and slip because they spin.
template <int D>
void check_rigid_pair() {
  const Vec<D> n = Vec<D>::Unit(0);
  for (double slip : slip_speeds) {
    SCOPED_TRACE(slip);
    Sample<D> sample = pair_sample<D>(n, 0.0, {0.5, 0.25}, {2.0, 0.5});
    set_relative_velocity<D>(sample, -n);
    sample.spin[0] = spin_across<D>(n, 2 * slip);
    expect_walton<D>(sample, n);
    sample.spin[1] = spin_across<D>(n, -1.0);
    expect_walton<D>(sample, n);
    for (Vec<D>& velocity : sample.velocity) velocity += 0.5 * n + 0.25 * generic_tangent<D>(n);
    expect_walton<D>(sample, n);
  }
}

TEST(ObliqueCd, PlaneFollowsWaltonDisks) { check_rigid_plane<2>(); }
TEST(ObliqueCd, PlaneFollowsWaltonSpheres) { check_rigid_plane<3>(); }
TEST(ObliqueCd, PairFollowsWaltonDisks) { check_rigid_pair<2>(); }
TEST(ObliqueCd, PairFollowsWaltonSpheres) { check_rigid_pair<3>(); }

TEST(ObliqueCd, OppositeSpinsWithoutSlipAreLeftAlone) {
  // Chung and Ooi, test 7: surfaces roll on each other; friction has nothing to do at any mu.
  Sample<3> sample = pair_sample<3>(Vec<3>::UnitX(), 0.0);
  set_relative_velocity<3>(sample, -Vec<3>::UnitX());
  sample.spin[0] = Vec<3>(0.7, 0.2, 3);
  sample.spin[1] = Vec<3>(-0.7, -0.2, -3);
  Scene scene = free_scene(3, 10, restitution, 1e4);
  scene.cd.tolerance = 1e-13;
  scene.cd.dt = 1e-11;
  const auto engine = make_engine<3>(EngineKind::cd, scene, sample);
  engine->advance(1);
  const Snapshot<3> after = engine->snapshot();
  EXPECT_NEAR(relative_velocity<3>(after).x(), restitution, 1e-12);
  for (int i = 0; i < 2; ++i) EXPECT_LT((after.spin[i] - sample.spin[i]).norm(), 1e-12);
}

/// md: an impact that slides throughout: v_t is 30 times the slip that sticking could stop, and the tangential spring
/// reaches the bound at once. (`elastic`: K_T v_t > mu K_N v_n. `total`: F_N starts at alpha v_n, so the spring needs a
/// time mu alpha v_n / (K_T v_t) to load, which costs half of that time's impulse, up to 0.7 % of mu J_n.)
template <int D>
void check_soft_sliding(double e, DampingConvention convention) {
  SCOPED_TRACE(to_string(convention) + " e = " + std::to_string(e));
  const Vec<D> n = -up<D>();
  const Vec<D> t = generic_tangent<D>(n);
  const double v_n = 0.1, k = inertia_ratio<D>;
  const double v_t = 30 * friction * (1 + e) * (1 + 1 / k) * v_n;
  Sample<D> sample = ball_on_plane<D>(up<D>(), 1e-6);
  sample.velocity[0] = v_n * n + v_t * t;
  Scene scene = free_scene(D, friction, e, 1e6);  // deflection 1e-4: lever arms change by 2e-4
  scene.material.convention = convention;
  const auto engine = make_engine<D>(EngineKind::md, scene, sample);
  engine->advance(200);
  const Snapshot<D> after = engine->snapshot();
  ASSERT_FALSE(in_contact<D>(after));
  const Vec<D> gain = after.velocity[0] - sample.velocity[0];
  const double normal_impulse = -gain.dot(n);
  // A damping force that jumps at opening or closing counts for half a step too much or too little: the same
  // first-order error as that of the restitution (see collision_test.cpp), relative to J_n.
  // The rest, 1 %, is for that loading and for second-order terms.
  const double error = 2 * damping_of_restitution(e, convention) * std::sqrt(1e6) * engine->dt() + 1e-2;
  const double tolerance = error * normal_impulse;
  EXPECT_NEAR(normal_impulse, (1 + e) * v_n, tolerance);
  EXPECT_NEAR(-gain.dot(t), friction * normal_impulse, friction * tolerance);
  EXPECT_LT((gain - gain.dot(n) * n - gain.dot(t) * t).norm(), 1e-12);
  // The torque is the lever arm (R, up to the deflection) times the tangential impulse.
  const double spin_gain = friction * normal_impulse * 0.5 / (k * 0.25);
  EXPECT_NEAR(spin_norm(after.spin[0]), spin_gain, spin_gain * error);
  EXPECT_GT((after.velocity[0] + cross(after.spin[0], Vec<D>(0.5 * n))).dot(t), 0);
}

TEST(ObliqueMd, SlidingImpulseIsMuTimesNormalImpulse) {
  for (DampingConvention convention : both_conventions)
    for (double e : {0.3, 0.9, 1.0}) {
      check_soft_sliding<2>(e, convention);
      check_soft_sliding<3>(e, convention);
    }
}

TEST(ObliqueMd, RadialReturnMakesUndampedSlidingExact) {
  // Without damping each step's tangential force is mu times its normal force, so the impulses are in that ratio
  // whatever dt. (A midpoint rule for the slip direction is no exception: the direction is constant here.)
  for (double dt : {1e-4, 2e-5}) {
    SCOPED_TRACE(dt);
    Sample<3> sample = ball_on_plane<3>(up<3>(), 1e-6);
    sample.velocity[0] = Vec<3>(2, -1, -0.1);
    Scene scene = free_scene(3, friction, 1, 1e6);
    set_dt(scene, dt);
    scene.md.allow_unsafe_dt = true;  // 31 steps per contact are enough for one ball
    const auto engine = make_engine<3>(EngineKind::md, scene, sample);
    engine->advance(std::lround(0.01 / dt));
    const Vec<3> gain = engine->snapshot().velocity[0] - sample.velocity[0];
    ASSERT_GT(gain.z(), 0.19);
    EXPECT_NEAR(std::hypot(gain.x(), gain.y()), friction * gain.z(), 1e-12);
  }
}

}  // namespace
}  // namespace galet::test::oblique_test
