// Head-on and oblique frictionless impacts of two grains, and of a grain on a plane, in free space.
#include <gtest/gtest.h>

#include "tests/support/scenes.hpp"

namespace galet::test::collision_test {
namespace {

constexpr double stiffness = 1e4;
constexpr double speed = 0.1;  // deflections of speed / w0 = 1e-3 d: small, though the linear law does not care

template <int D>
struct Partners {
  std::string name;
  Sample<D> sample;
  double reduced_mass;
};

/// Two equal grains, two unequal ones, and a grain on a plane; all meet along a direction that is no axis.
template <int D>
std::vector<Partners<D>> all_partners(double gap) {
  const Vec<D> n = generic_direction<D>();
  return {{"equal pair", pair_sample<D>(n, gap), 0.5},
          {"unequal pair", pair_sample<D>(n, gap, {0.3, 0.6}, {0.25, 2.0}), 0.25 * 2.0 / 2.25},
          {"plane", ball_on_plane<D>(-n, gap), 1.0}};
}

struct Impact {
  double restitution = 0;
  double steps_in_contact = 0;
  double dt = 0;
  double momentum_error = 0;
};

/// Runs a head-on impact that starts `phase` steps (0 to 1) before a step that first sees an overlap.
template <int D>
Impact soft_impact(const Scene& scene, Sample<D> sample, double phase) {
  const Vec<D> n = generic_direction<D>();
  set_relative_velocity<D>(sample, -speed * n);
  const double dt = make_engine<D>(EngineKind::md, scene, sample)->dt();
  const Vec<D> approach = (1 + phase) * speed * dt * n;  // the gap closes during the second step
  if (sample.count() == 1)
    sample.position[0] -= approach;
  else
    sample.position[1] += approach;
  const auto engine = make_engine<D>(EngineKind::md, scene, sample);
  Impact impact;
  impact.dt = dt;
  for (int step = 0; step < 100000; ++step) {
    engine->advance(1);
    if (in_contact<D>(engine->snapshot()))
      ++impact.steps_in_contact;
    else if (impact.steps_in_contact > 0)
      break;
  }
  // A few more steps: a contact of the `elastic` convention may pass through zero force before it opens.
  engine->advance(5);
  const Snapshot<D> after = engine->snapshot();
  impact.restitution = relative_velocity<D>(after).dot(n) / speed;
  if (sample.count() == 2)
    impact.momentum_error = (after.mass[0] * after.velocity[0] + after.mass[1] * after.velocity[1]).norm();
  return impact;
}

/// What an integrator that samples the force at the steps may lose: a damping force that jumps when the contact
/// opens or closes counts for half a step too much or too little, which changes the relative velocity by the factor
/// 1 +- zeta w0 dt each time; the smooth part adds an error of second order.
double restitution_tolerance(double e, double zeta, double frequency_dt) {
  return 2 * zeta * frequency_dt * e + frequency_dt * frequency_dt;
}

template <int D>
void check_default_step(double e, DampingConvention convention) {
  Scene scene = free_scene(D, 0, e, stiffness);
  scene.material.convention = convention;
  const double zeta = damping_of_restitution(e, convention);
  for (const Partners<D>& partners : all_partners<D>(0.0)) {
    SCOPED_TRACE(partners.name + ", " + to_string(convention) + ", e = " + std::to_string(e));
    const double frequency = std::sqrt(stiffness / partners.reduced_mass);
    const double duration = collision_duration(zeta, convention, partners.reduced_mass, stiffness);
    double mean_steps = 0;
    double dt = 0;
    const int phases = 16;
    for (int k = 0; k < phases; ++k) {
      const Impact impact = soft_impact<D>(scene, partners.sample, (k + 0.37) / phases);
      dt = impact.dt;
      EXPECT_NEAR(impact.restitution, e, restitution_tolerance(e, zeta, frequency * dt)) << "phase " << k;
      // The number of steps that fall into an interval of this length, give or take one.
      EXPECT_NEAR(impact.steps_in_contact, duration / dt, 1.5) << "phase " << k;
      EXPECT_LT(impact.momentum_error, 1e-14);
      mean_steps += impact.steps_in_contact / phases;
    }
    // Over evenly spread phases that number averages to duration / dt; half a step is left for the second-order
    // error in the frequency and for 16 phases being no continuum.
    EXPECT_NEAR(mean_steps, duration / dt, 0.5);
  }
}

template <int D>
void check_default_step_for_all() {
  for (DampingConvention convention : both_conventions)
    for (double e : {0.1, 0.5, 0.9}) check_default_step<D>(e, convention);
}

TEST(CollisionMd, RestitutionAndDurationDisks) { check_default_step_for_all<2>(); }
TEST(CollisionMd, RestitutionAndDurationSpheres) { check_default_step_for_all<3>(); }

/// Rms error of the restitution over the impact phases.
std::vector<double> restitution_errors(double e, DampingConvention convention, std::span<const double> steps) {
  Scene scene = free_scene(2, 0, e, stiffness);
  scene.material.convention = convention;
  scene.md.allow_unsafe_dt = true;  // the bound is for packings, an isolated pair is stable far above it
  const double zeta = damping_of_restitution(e, convention);
  const double duration = collision_duration(zeta, convention, 0.5, stiffness);
  std::vector<double> errors;
  for (double steps_per_contact : steps) {
    set_dt(scene, duration / steps_per_contact);
    double sum = 0;
    const int phases = 24;
    for (int k = 0; k < phases; ++k) {
      const Sample<2> pair = pair_sample<2>(generic_direction<2>(), 0.0);
      sum += std::pow(soft_impact<2>(scene, pair, (k + 0.37) / phases).restitution - e, 2);
    }
    errors.push_back(std::sqrt(sum / phases));
  }
  return errors;
}

TEST(CollisionMd, RestitutionConvergesWithTheTimeStep) {
  // Half-integer numbers of steps per contact: whole ones would make the errors of opening and closing cancel by luck
  // in the `elastic` convention, and unlike fractions would add luck of their own to the order.
  const std::array steps{41.5, 82.5, 165.5, 330.5};
  std::array<double, 4> dt;
  for (std::size_t k = 0; k < 4; ++k) dt[k] = 1 / steps[k];
  for (DampingConvention convention : both_conventions)
    for (double e : {0.1, 0.5, 0.9, 1.0}) {
      SCOPED_TRACE(to_string(convention) + " e = " + std::to_string(e));
      const std::vector<double> error = restitution_errors(e, convention, steps);
      // Order 1 from the jump of the damping force at opening, 2 without it; 0.05 for the second order's remainder.
      EXPECT_GT(observed_order(dt, error), 0.95);
      const double zeta = damping_of_restitution(e, convention);
      const double finest_dt = collision_duration(zeta, convention, 1, 1) / steps.back();  // times w0
      EXPECT_LT(error.back(), restitution_tolerance(e, zeta, finest_dt));
    }
}

/// Rigid impacts. The tolerance of the solver is set to rounding: a single contact is solved in closed form.
Scene rigid_scene(int dim, double e) {
  Scene scene = free_scene(dim, 0, e, stiffness);
  scene.cd.tolerance = 1e-13;
  set_dt(scene, 0.01);
  return scene;
}

template <int D>
void check_rigid_rebound() {
  const Vec<D> n = generic_direction<D>();
  for (double e : {0.0, 0.1, 0.5, 0.9, 1.0})
    for (Partners<D> partners : all_partners<D>(0.0513)) {
      SCOPED_TRACE(partners.name + " e = " + std::to_string(e));
      set_relative_velocity<D>(partners.sample, -n);
      const auto engine = make_engine<D>(EngineKind::cd, rigid_scene(D, e), partners.sample);
      engine->advance(4);
      // Still flying after 4 of the 5.13 steps that the gap takes.
      EXPECT_NEAR(relative_velocity<D>(engine->snapshot()).dot(n), -1, 1e-15);
      engine->advance(6);
      const Vec<D> u = relative_velocity<D>(engine->snapshot());
      EXPECT_NEAR(u.dot(n), e, 1e-12);
      EXPECT_LT((u - u.dot(n) * n).norm(), 1e-12);
    }
}

TEST(CollisionCd, ReboundIsExactDisks) { check_rigid_rebound<2>(); }
TEST(CollisionCd, ReboundIsExactSpheres) { check_rigid_rebound<3>(); }

/// An oblique frictionless impact of unequal grains, seen from a moving frame.
template <int D>
void check_oblique(EngineKind kind, double e) {
  SCOPED_TRACE(to_string(kind) + " e = " + std::to_string(e));
  const Vec<D> direction = generic_direction<D>();
  const Vec<D> tangent = generic_tangent<D>(direction);
  const std::array mass{0.25, 2.0};
  Sample<D> sample = pair_sample<D>(direction, 0.05, {0.3, 0.6}, mass);
  const Vec<D> u_before = -direction + 0.7 * tangent;
  set_relative_velocity<D>(sample, u_before);
  const Vec<D> drift = Vec<D>::Constant(0.3);
  for (Vec<D>& velocity : sample.velocity) velocity += drift;
  const std::vector<Vec<D>> before = sample.velocity;
  Scene scene = rigid_scene(D, e);
  scene.material.normal_stiffness = 1e8;  // md: the contact lasts 2e-4, the normal hardly turns meanwhile
  set_dt(scene, kind == EngineKind::md ? 1e-6 : 1e-4);
  const auto engine = make_engine<D>(kind, scene, sample);
  engine->advance(std::lround(0.15 / engine->dt()));
  const Snapshot<D> after = engine->snapshot();
  const Vec<D> gain = after.velocity[1] - before[1];
  ASSERT_GT(gain.norm(), 0.05);
  EXPECT_LT((mass[0] * (after.velocity[0] - before[0]) + mass[1] * gain).norm(), 1e-12);
  const Vec<D> n = gain.normalized();
  const double u_n = u_before.dot(n);
  // In cd the impulse is along one normal, so this is exact. In md it is spread over a turning normal (angle
  // 0.7 * 2e-4 / 0.9) and has the error in e of 150 steps per contact.
  EXPECT_NEAR(relative_velocity<D>(after).dot(n), -e * u_n, kind == EngineKind::cd ? 1e-12 : 5e-3);
  const double kinetic_loss = 0.5 * (0.5 / 2.25) * (u_before.squaredNorm() - relative_velocity<D>(after).squaredNorm());
  EXPECT_NEAR(kinetic_loss, 0.5 * (0.5 / 2.25) * (1 - e * e) * u_n * u_n, kind == EngineKind::cd ? 1e-12 : 1e-3);
  // The true normal at touching: |x + u t| = 0.9 with x = 0.95 direction. It turns by 0.7 dt / 0.9 in a step.
  const Vec<D> x = 0.95 * direction;
  const double b = x.dot(u_before), a = u_before.squaredNorm();
  const double touch = (-b - std::sqrt(b * b - a * (x.squaredNorm() - 0.81))) / a;
  const Vec<D> true_normal = (x + touch * u_before).normalized();
  EXPECT_LT((n - true_normal).norm(), kind == EngineKind::cd ? 2 * 1e-4 : 3e-4);
}

TEST(CollisionMd, ObliqueFrictionless) {
  check_oblique<2>(EngineKind::md, 0.5);
  check_oblique<3>(EngineKind::md, 0.5);
}
TEST(CollisionCd, ObliqueFrictionless) {
  for (double e : {0.0, 0.5, 1.0}) {
    check_oblique<2>(EngineKind::cd, e);
    check_oblique<3>(EngineKind::cd, e);
  }
}

/// Balls 1 and 2 in a row, with gaps, hit by ball 0: Newton's law one pair after the other.
void check_cascade(EngineKind kind, double tolerance) {
  SCOPED_TRACE(to_string(kind));
  const double e = 0.8;
  Sample<2> sample;
  sample.cell = cube<2>(20, false);
  sample.resize(3);
  for (int i = 0; i < 3; ++i) sample.position[i] = Vec<2>(5 + 1.05 * i, 10);
  sample.velocity[0] = Vec<2>(1, 0);
  Scene scene = rigid_scene(2, e);
  scene.material.normal_stiffness = 1e6;
  scene.md.dt.reset();
  scene.cd.dt = 1e-3;
  const auto engine = make_engine<2>(kind, scene, sample);
  engine->advance(std::lround(0.2 / engine->dt()));
  const Snapshot<2> after = engine->snapshot();
  // 0 hits 1 (shares (1-e)/2, (1+e)/2), then 1 hits 2; 0 then follows 1, only 0.01 faster, and does not reach it.
  const double first = (1 + e) / 2;
  EXPECT_NEAR(after.velocity[0].x(), (1 - e) / 2, tolerance);
  EXPECT_NEAR(after.velocity[1].x(), first * (1 - e) / 2, tolerance);
  EXPECT_NEAR(after.velocity[2].x(), first * first, tolerance);
}

TEST(CollisionCd, CascadeWithGaps) { check_cascade(EngineKind::cd, 1e-12); }
TEST(CollisionMd, CascadeWithGaps) {
  const double zeta = damping_of_restitution(0.8, DampingConvention::elastic);
  check_cascade(EngineKind::md, 2 * restitution_tolerance(0.8, zeta, pi / 50));
}

/// Touching rigid balls in a row (Moreau: Newton's law at all contacts at once): n = 3, e = 1 gives (-1, 2, 2) / 3;
/// e = 0 shares the velocity.
TEST(CollisionCd, NewtonCradleInContact) {
  for (double e : {0.0, 1.0}) {
    SCOPED_TRACE(e);
    Sample<2> sample;
    sample.cell = cube<2>(20, false);
    sample.resize(3);
    for (int i = 0; i < 3; ++i) sample.position[i] = Vec<2>(5 + 1.0 * i, 10);
    sample.velocity[0] = Vec<2>(1, 0);
    Scene scene = rigid_scene(2, e);
    scene.cd.tolerance = 1e-12;
    const auto engine = make_engine<2>(EngineKind::cd, scene, sample);
    engine->advance(1);
    const Snapshot<2> after = engine->snapshot();
    const std::array expected = e == 1 ? std::array{-1 / 3.0, 2 / 3.0, 2 / 3.0} : std::array{1 / 3.0, 1 / 3.0, 1 / 3.0};
    // 1e-10: the solver's tolerance on impulses times the conditioning (3) of a chain of two contacts, and margin.
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(after.velocity[i].x(), expected[i], 1e-10);
  }
}

}  // namespace
}  // namespace galet::test::collision_test
