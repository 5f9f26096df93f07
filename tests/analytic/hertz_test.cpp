// The Hertz law, F_N = (4/3) E* sqrt(R*) h^(3/2): static forces, elastic impacts (references.md, A8) and the tests 1
// and 3 of Chung and Ooi 2011 (B1, B3; their numbers are the closed forms of A8).
#include <gtest/gtest.h>

#include "tests/support/impact.hpp"

namespace galet::test::hertz_test {
namespace {

/// Two bodies that touch, with the constants of their contact.
template <int D>
struct Partners {
  std::string name;
  Scene scene;
  Sample<D> sample;
  double coefficient;  ///< k of F_N = k h^(3/2)
  double reduced_mass;
};

constexpr Elastic soft{2e4, 0.2};
constexpr Elastic hard{9e4, 0.45};

/// A scene with the material `soft` and, as material 1, `hard`.
Scene two_materials(int dim) {
  Scene scene = hertz_scene(dim, 0, soft.young, soft.poisson);
  scene.other_materials.push_back(other("hard"));
  scene.other_materials[0].young_modulus = hard.young;
  scene.other_materials[0].poisson_ratio = hard.poisson;
  return scene;
}

template <int D>
std::vector<Partners<D>> all_partners() {
  const Vec<D> n = generic_direction<D>();
  const std::array unequal{0.3, 0.6};
  const std::array masses{0.25, 2.0};
  const auto k = [](Elastic a, Elastic b, double radius) { return hertz_coefficient(contact_modulus(a, b), radius); };
  const double small_radius = reduced(0.3, 0.6), small_mass = reduced(0.25, 2.0);
  const Scene scene = two_materials(D);
  std::vector<Partners<D>> all{
      {"equal pair", scene, pair_apart<D>(n, 0, {0.5, 0.5}, {1, 1}), k(soft, soft, 0.25), 0.5},
      {"unequal pair", scene, pair_apart<D>(n, 0, unequal, masses), k(soft, soft, small_radius), small_mass},
      {"mixed pair", scene, pair_apart<D>(n, 0, unequal, masses), k(soft, hard, small_radius), small_mass},
      {"hard pair", scene, pair_apart<D>(n, 0, unequal, masses), k(hard, hard, small_radius), small_mass},
      {"plane", scene, ball_apart<D>(n, 0, 0.4, 1.5), k(soft, soft, 0.4), 1.5},
      {"hard plane", scene, ball_apart<D>(n, 0, 0.4, 1.5), k(soft, hard, 0.4), 1.5},
      {"hard ball", scene, ball_apart<D>(n, 0, 0.4, 1.5), k(hard, soft, 0.4), 1.5}};
  all[2].sample.material[1] = 1;
  all[3].sample.material = {1, 1};
  all[5].sample.plane_material = {1};
  all[6].sample.material = {1};
  return all;
}

template <int D>
void check_static_force() {
  for (const Partners<D>& partners : all_partners<D>())
    for (double deflection : {1e-6, 1e-4, 1e-2, 0.05}) {
      SCOPED_TRACE(partners.name + " h = " + std::to_string(deflection));
      Sample<D> sample = partners.sample;
      const Vec<D> n = generic_direction<D>();
      sample.position[0] += deflection * n;
      // In 3 steps of 1e-12 a force of 1e3 moves nothing by more than 1e-20.
      const Probe<D> seen = probe<D>(partners.scene, sample, 1e-12);
      EXPECT_TRUE(seen.touches);
      // Positions of order 10: rounding of 2e-15 in each component of two positions.
      EXPECT_NEAR(-seen.gap, deflection, 1e-14);
      const double expected = partners.coefficient * std::pow(-seen.gap, 1.5);
      // `gap` is computed apart from the contact pass: two ulps of a distance of order 1. With a plane the pass works
      // with the point of the plane next to the grain, rounded like any position of order 10 (2e-15 in each component).
      const double rounding = (sample.planes.empty() ? 4e-16 : 4e-15) * 1.5 * expected / deflection;
      EXPECT_NEAR(seen.normal_force, expected, 1e-13 * expected + rounding);
      EXPECT_LT((seen.normal - n).norm(), 1e-14);
      EXPECT_EQ(seen.tangential_force.norm() < (sample.planes.empty() ? 1e-15 : 2e-14) * expected, true);
    }
}

TEST(HertzLaw, StaticForceDisks) { check_static_force<2>(); }
TEST(HertzLaw, StaticForceSpheres) { check_static_force<3>(); }

struct Peak {
  double deflection = 0, force = 0;
};

/// Largest deflection and force of a head-on impact, looked at after every step.
template <int D>
Peak peak(const Partners<D>& partners, double speed, double dt, double duration) {
  Scene scene = partners.scene;
  set_dt(scene, dt);
  Sample<D> sample = partners.sample;
  const Vec<D> n = generic_direction<D>();
  sample.position[0] -= 1.37 * speed * dt * n;
  set_relative_velocity<D>(sample, -speed * n);
  const auto engine = make_engine<D>(EngineKind::md, scene, sample);
  Peak seen;
  while (engine->time() < 0.7 * duration) {  // the turning point is half-way
    engine->advance(1);
    const Snapshot<D> state = engine->snapshot();
    if (state.contacts->size() == 0) continue;
    seen.deflection = std::max(seen.deflection, -state.contacts->gap[0]);
    seen.force = std::max(seen.force, state.contacts->force[0].norm());
  }
  return seen;
}

/// With N steps per contact the largest sample misses the turning point by half a step at most, which is
/// |h''| (dt/2)^2 / 2 = (V^2 / 0.8 h) dt^2 / 8, i.e. (2.94/N)^2 / 6.4 of h and 1.5 times that of F; the scheme's own
/// error, w^2 dt^2 / 24 with w^2 = K_N / m* = 1.9 (V/h)^2, is smaller than that.
double peak_tolerance(double steps) { return 4 * std::pow(2.94 / steps, 2) / 6.4; }

template <int D>
void check_elastic_impact(const Partners<D>& partners, double speed) {
  SCOPED_TRACE(partners.name + " V = " + std::to_string(speed));
  const double steps = 1000;
  const HertzImpact expected = hertz_impact(partners.coefficient, partners.reduced_mass, speed);
  const double dt = expected.duration / steps;
  const Peak seen = peak<D>(partners, speed, dt, expected.duration);
  EXPECT_NEAR(seen.deflection / expected.deflection, 1, peak_tolerance(steps));
  EXPECT_NEAR(seen.force / expected.force, 1, peak_tolerance(steps));
  const HeadOn impact = head_on<D>(partners.scene, partners.sample, speed, dt, 0.37, 2 * expected.duration);
  // No force jumps, so the scheme's error is of order (w dt)^2, w dt = 4/N; entry and exit add (1/N)^2.5.
  EXPECT_NEAR(impact.contact_time / expected.duration, 1, std::pow(4 / steps, 2));
  EXPECT_NEAR(impact.restitution, 1, std::pow(4 / steps, 2));
  EXPECT_LT(impact.momentum_error, 1e-14);
}

TEST(HertzLaw, ElasticImpactDisks) {
  for (const Partners<2>& partners : all_partners<2>())
    for (double speed : {0.01, 1.0}) check_elastic_impact<2>(partners, speed);
}
TEST(HertzLaw, ElasticImpactSpheres) {
  for (const Partners<3>& partners : all_partners<3>())
    for (double speed : {0.01, 1.0}) check_elastic_impact<3>(partners, speed);
}

/// Rms over the impact phases of the errors of an elastic impact.
struct Errors {
  double restitution = 0, duration = 0;
};

Errors impact_errors(double steps) {
  const Partners<3> partners = all_partners<3>()[1];
  const HertzImpact expected = hertz_impact(partners.coefficient, partners.reduced_mass, 1);
  Errors errors;
  const int phases = 16;
  for (int k = 0; k < phases; ++k) {
    const HeadOn impact = head_on<3>(partners.scene, partners.sample, 1, expected.duration / steps, (k + 0.37) / phases,
                                     2 * expected.duration);
    errors.restitution += std::pow(impact.restitution - 1, 2) / phases;
    errors.duration += std::pow(impact.contact_time / expected.duration - 1, 2) / phases;
  }
  return {std::sqrt(errors.restitution), std::sqrt(errors.duration)};
}

TEST(HertzLaw, ElasticImpactConvergesAtSecondOrder) {
  const std::array<double, 4> steps{30.3, 60.7, 121.3, 242.7};
  std::array<double, 4> dt, restitution, duration;
  for (std::size_t k = 0; k < 4; ++k) {
    const Errors errors = impact_errors(steps[k]);
    dt[k] = 1 / steps[k], restitution[k] = errors.restitution, duration[k] = errors.duration;
  }
  // 2 for the smooth part; the energy that a step across the end of the contact misplaces is k (V dt)^(5/2), of order
  // 5/2. 0.1 for curvature at 30 steps.
  EXPECT_GT(observed_order(dt, restitution), 1.9);
  EXPECT_GT(observed_order(dt, duration), 1.9);
  EXPECT_LT(observed_order(dt, duration), 2.6);
}

/// Test 1 of Chung and Ooi: two equal spheres at +- 10 m/s, elastic.
void check_first_test(Elastic matter, double density, double deflection, double force, double duration) {
  const double radius = 0.010, mass = density * grain_volume<3>(2 * radius), speed = 20;
  const Vec<3> n = generic_direction<3>();
  Scene scene = hertz_scene(3, 0.35, matter.young, matter.poisson);
  scene.grains.diameter.mean = 2 * radius;
  const Partners<3> partners{"", scene, pair_apart<3>(n, 0, {radius, radius}, {mass, mass}), 0, 0};
  const double steps = 1000;
  const Peak seen = peak<3>(partners, speed, duration / steps, duration);
  // Half a unit of the last digit given, and the error of 1000 steps.
  const double relative = peak_tolerance(steps);
  EXPECT_NEAR(seen.deflection, deflection, 0.5e-8 + relative * deflection);
  EXPECT_NEAR(seen.force, force, 0.5e-4 * force + relative * force);
  const HeadOn impact = head_on<3>(scene, partners.sample, speed, duration / steps, 0.37, 2 * duration);
  EXPECT_NEAR(impact.contact_time, duration, 0.5e-9 + std::pow(4 / steps, 2) * duration);
  EXPECT_NEAR(impact.restitution, 1, std::pow(4 / steps, 2));
}

TEST(HertzLaw, ChungAndOoiTestOne) {
  check_first_test({48e9, 0.20}, 2800, 274.11e-6, 10697, 40.339e-6);   // glass
  check_first_test({20e9, 0.25}, 2500, 368.30e-6, 7108.2, 54.201e-6);  // limestone
}

struct Ball {
  Elastic matter;
  double density, deflection, force, duration;
};
constexpr Ball alumina{{380e9, 0.23}, 4000, 8.0888e-6, 615.35, 6.1045e-6};
constexpr Ball iron{{100e9, 0.25}, 7000, 17.189e-6, 506.8, 12.97e-6};

/// Test 3 of Chung and Ooi: a sphere of radius 2.5 mm on a rigid plane at 3.9 m/s, with restitution e.
Partners<3> third_test(const Ball& ball, double e, DampingConvention convention) {
  const double radius = 0.0025, mass = ball.density * grain_volume<3>(2 * radius);
  Scene scene = hertz_scene(3, 0, ball.matter.young, ball.matter.poisson);
  scene.grains.diameter.mean = 2 * radius;
  scene.material.restitution = e;
  scene.material.convention = convention;
  scene.other_materials.push_back(other("rigid"));
  scene.other_materials[0].young_modulus = 1e7 * ball.matter.young;  // lowers E* by 1e-7
  Partners<3> partners{"", scene, ball_apart<3>(generic_direction<3>(), 0, radius, mass), 0, 0};
  partners.sample.plane_material = {1};
  return partners;
}

constexpr double third_speed = 3.9;

TEST(HertzLaw, ChungAndOoiTestThreeElastic) {
  for (const Ball& ball : {alumina, iron}) {
    const Partners<3> partners = third_test(ball, 1, DampingConvention::elastic);
    const double steps = 1000;
    const Peak seen = peak<3>(partners, third_speed, ball.duration / steps, ball.duration);
    // 1e-4: the digits given (506.8, 12.97: half a unit is 1e-4 and 4e-4).
    EXPECT_NEAR(seen.deflection / ball.deflection, 1, 1e-4);
    EXPECT_NEAR(seen.force / ball.force, 1, 1.1e-4);
    const HeadOn impact =
        head_on<3>(partners.scene, partners.sample, third_speed, ball.duration / steps, 0.37, 2 * ball.duration);
    EXPECT_NEAR(impact.contact_time / ball.duration, 1, 4e-4);
    EXPECT_NEAR(impact.restitution, 1, std::pow(4 / steps, 2));
  }
}

TEST(HertzLaw, ChungAndOoiTestThreeRestitution) {
  // The damping coefficient starts as h^(1/4), so no force jumps; a step across the end of the contact misplaces an
  // impulse of zeta sqrt(m* K_N(V dt)) V dt or (1/N)^(5/4) zeta m* V times 5: below 5e-5 at 10^4 steps, zeta < 1.
  const double steps = 1e4;
  for (DampingConvention convention : both_conventions)
    for (const Ball& ball : {alumina, iron})
      for (double e : {0.2, 0.4, 0.6, 0.8, 1.0}) {
        SCOPED_TRACE(to_string(convention) + " e = " + std::to_string(e));
        const Partners<3> partners = third_test(ball, e, convention);
        const HeadOn impact =
            head_on<3>(partners.scene, partners.sample, third_speed, ball.duration / steps, 0.37, 20 * ball.duration);
        EXPECT_NEAR(impact.restitution, e, 1e-4);
      }
}

}  // namespace
}  // namespace galet::test::hertz_test
