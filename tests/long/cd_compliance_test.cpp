// Elastic contacts of cd at time steps far above the duration of a collision: statics in closed form, and the same
// deflections as md, contact by contact.
#include <map>
#include <tuple>

#include <gtest/gtest.h>

#include "tests/support/scenes.hpp"

namespace galet::test::cd_compliance_test {
namespace {

constexpr double stiffness = 1e6, young = 1e8, poisson = 0.25;

Scene elastic_scene(int dim, NormalLaw law, double friction) {
  Scene scene = free_scene(dim, friction, 0.5, stiffness);
  scene.material.normal_law = law;
  scene.material.convention = DampingConvention::total;
  if (law == NormalLaw::hertz) {
    scene.material.normal_stiffness.reset();
    scene.material.young_modulus = young;
    scene.material.poisson_ratio = poisson;
  }
  scene.cd.compliance = true;
  // Forces balance to the tolerance; the deflection that a force belongs to only to (omega dt)^2 = 5000 times that.
  scene.cd.tolerance = 1e-12;
  scene.cd.max_sweeps = 100000;
  scene.cd.dt = 0.05;  // 20 tau_c and more
  return scene;
}

/// Deflection of two equal spheres or disks of diameter 1 (of one on a plane) under a force: E* = E / (2 (1 - nu^2)),
/// R* = 1/4 (1/2).
double deflection(NormalLaw law, double force, bool plane) {
  if (law == NormalLaw::linear) return force / stiffness;
  const double modulus = young / (2 * (1 - poisson * poisson));
  return std::pow(0.75 * force / (modulus * std::sqrt(plane ? 0.5 : 0.25)), 2.0 / 3);
}

template <int D>
void check_column(NormalLaw law) {
  Scene scene = elastic_scene(D, law, 0.3);
  scene.loading.gravity.assign(D, 0.0);
  scene.loading.gravity[D - 1] = -1;
  const auto engine = make_engine<D>(EngineKind::cd, scene, column_sample<D>(4));
  engine->advance(400);
  const Snapshot<D> state = engine->snapshot();
  ASSERT_EQ(state.contacts->size(), 4u);
  double energy = 0;
  for (std::size_t c = 0; c < 4; ++c) {
    const bool plane = state.contacts->j[c] == 4;
    const double force = plane ? 4 : 3 - state.contacts->i[c], h = deflection(law, force, plane);
    // The solver's tolerance, 1e-12, times the condition of a column, n^2; on deflections times (omega dt)^2, and the
    // rounding of positions of about 20.
    EXPECT_NEAR(state.contacts->force[c].norm(), force, 1e-8);
    EXPECT_NEAR(-state.contacts->gap[c], h, 1e-7 * h + 1e-14);
    energy += force * h / (law == NormalLaw::linear ? 2 : 2.5);
  }
  EXPECT_NEAR(engine->energy().elastic_normal, energy, 1e-7 * energy);
}

TEST(ComplianceCd, DeflectionsOfAColumn) {
  for (NormalLaw law : {NormalLaw::linear, NormalLaw::hertz}) {
    check_column<2>(law);
    check_column<3>(law);
  }
}

/// A ball that friction and rolling resistance hold on a slope: F_T = m g sin(theta) winds up the tangential spring,
/// its moment R F_T the rolling spring: x = F_T / K_T + R^2 F_T / K_R.
template <int D>
void check_held_ball(NormalLaw law) {
  constexpr double rolling = 0.2, theta = 0.1, ratio = 0.5;
  Scene scene = elastic_scene(D, law, 0.5);
  scene.material.rolling_friction = rolling;
  scene.material.rolling_stiffness_ratio = 0.25;
  const Vec<D> along = generic_tangent<D>(up<D>());
  const Vec<D> g = -std::cos(theta) * up<D>() + std::sin(theta) * along;
  scene.loading.gravity.assign(g.data(), g.data() + D);
  const double h = deflection(law, std::cos(theta), true), force = std::sin(theta);
  // Starts at its normal deflection: K_T is then what it is at the end.
  const Sample<D> sample = ball_on_plane<D>(up<D>(), -h);
  const auto engine = make_engine<D>(EngineKind::cd, scene, sample);
  engine->advance(2000);
  const double k_n = law == NormalLaw::linear ? stiffness : 1.5 * std::cos(theta) / h;
  const double k_t = (law == NormalLaw::linear ? ratio : (2 - 2 * poisson) / (2 - poisson)) * k_n;
  const double k_r = 0.25 * k_n * rolling * rolling;
  const double expected = force / k_t + 0.25 * force / k_r;
  const Vec<D> moved = engine->snapshot().position[0] - sample.position[0];
  // The lever is R - h: 2 h / R = 4e-6 of the part that rolls; positions are rounded at 4e-15.
  EXPECT_NEAR(moved.dot(along), expected, 1e-4 * expected);
  EXPECT_LT(engine->snapshot().velocity[0].norm(), 1e-10);
  EXPECT_NEAR(engine->energy().elastic_tangential, force * force / (2 * k_t), 1e-4 * force * force / (2 * k_t));
}

TEST(ComplianceCd, SpringsOfAHeldBall) {
  for (NormalLaw law : {NormalLaw::linear, NormalLaw::hertz}) {
    check_held_ball<2>(law);
    check_held_ball<3>(law);
  }
}

TEST(ComplianceCd, ResolvedCollisionsHaveTheRestitutionOfTheDashpot) {
  // Steps far below tau_c: the implicit scheme converges to the law, which has e = 0.5, at first order.
  std::vector<double> steps, errors;
  const double duration = pi * std::sqrt(0.5 / stiffness);
  for (double per_collision : {100.0, 200.0, 400.0, 800.0}) {
    Scene scene = elastic_scene(2, NormalLaw::linear, 0);
    scene.cd.dt = duration / per_collision;
    Sample<2> sample = pair_sample<2>(generic_direction<2>(), 1e-6);
    set_relative_velocity<2>(sample, Vec<2>(-generic_direction<2>()));
    const auto engine = make_engine<2>(EngineKind::cd, scene, sample);
    engine->advance(std::lround(3 * per_collision));
    steps.push_back(1 / per_collision);
    errors.push_back(std::abs(relative_velocity<2>(engine->snapshot()).norm() - 0.5));
  }
  EXPECT_LT(errors.back(), 5e-3);
  EXPECT_NEAR(observed_order(steps, errors), 1, 0.2);
}

// ---- the same packing in both engines ------------------------------------------------------------------------------

Scene packing_scene(NormalLaw law, double friction) {
  Scene scene = elastic_scene(3, law, friction);
  scene.cell.periodic.assign(3, true);
  if (law == NormalLaw::hertz)
    scene.material.young_modulus = 1e5;
  else
    scene.material.normal_stiffness = 2e3;
  scene.md.drag = 1;
  scene.loading.pressure = 1;
  scene.loading.kind = LoadingKind::drives;
  scene.loading.drives = {{"xx", std::nullopt, 1.0}, {"yy", std::nullopt, 1.0}, {"zz", std::nullopt, 1.0}};
  return scene;
}

Sample<3> sample_of(const Snapshot<3>& state) {
  Sample<3> sample;
  sample.resize(state.grains());
  sample.cell = *state.cell;
  sample.cell.rate.setZero();
  sample.position.assign(state.position.begin(), state.position.end());
  sample.radius.assign(state.radius.begin(), state.radius.end());
  sample.mass.assign(state.mass.begin(), state.mass.end());
  return sample;
}

struct ContactState {
  double deflection;
  Vec<3> force;
};
using Contacts = std::map<std::tuple<int, int, Image<3>>, ContactState>;

Contacts contacts_of(const Snapshot<3>& state) {
  Contacts contacts;
  const ContactColumns<3>& c = *state.contacts;
  for (std::size_t k = 0; k < c.size(); ++k) contacts[{c.i[k], c.j[k], c.image[k]}] = {-c.gap[k], c.force[k]};
  return contacts;
}

struct Difference {
  double change = 0;  ///< largest change of a deflection by the increment, over the mean deflection
  double worst = 0;   ///< largest difference of a deflection between the engines, over that change
  double force = 0;   ///< the same of forces
};

/// Spheres of kappa about 2000, packed without friction by md, then given friction and a deviatoric stress increment.
Difference compare_engines(NormalLaw law, double increment) {
  Scene scene = packing_scene(law, 0);
  const auto packed = make_engine<3>(EngineKind::md, scene, gas_sample<3>(3, 0.35, 0.1, 72, 0.1));
  packed->advance(std::lround(60 / packed->dt()));
  const Sample<3> start = sample_of(packed->snapshot());
  const Contacts before = contacts_of(packed->snapshot());

  Scene sheared = packing_scene(law, 0.5);
  sheared.loading.drives[0].stress = 1 + increment;
  sheared.loading.drives[2].stress = 1 - 0.5 * increment;
  const auto soft = make_engine<3>(EngineKind::md, sheared, start);
  soft->advance(std::lround(60 / soft->dt()));
  sheared.cd.dt = 0.2;
  const auto implicit = make_engine<3>(EngineKind::cd, sheared, start);
  implicit->advance(500);
  EXPECT_GT(0.2 / soft->dt(), 200) << "one implicit step in place of so many of md";

  const Contacts expected = contacts_of(soft->snapshot()), found = contacts_of(implicit->snapshot());
  EXPECT_EQ(found.size(), expected.size());
  EXPECT_EQ(before.size(), expected.size());
  Difference difference;
  double mean = 0, force_change = 0;
  for (const auto& [pair, state] : expected) {
    if (!found.contains(pair) || !before.contains(pair)) {
      ADD_FAILURE() << "the engines have different contacts";
      return difference;
    }
    const ContactState& other = found.at(pair);
    mean += state.deflection / static_cast<double>(expected.size());
    difference.worst = std::max(difference.worst, std::abs(other.deflection - state.deflection));
    difference.force = std::max(difference.force, (other.force - state.force).norm());
    difference.change = std::max(difference.change, std::abs(state.deflection - before.at(pair).deflection));
    force_change = std::max(force_change, (state.force - before.at(pair).force).norm());
  }
  difference.worst /= difference.change, difference.force /= force_change, difference.change /= mean;
  return difference;
}

TEST(ComplianceCd, PackingUnderAStressIncrementDeflectsAsInMd) {
  // Linear contacts that stick have one answer, up to the turning of contacts by some 1e-5 on the way to it. (In some
  // packings, of seed 71 for one, a weak contact slides while md oscillates into its equilibrium: the answer then
  // depends on the damping, by 1e-2, and not on md's time step.)
  const Difference linear = compare_engines(NormalLaw::linear, 0.004);
  EXPECT_GT(linear.change, 1e-3);
  EXPECT_LT(linear.worst, 1e-5);
  EXPECT_LT(linear.force, 1e-5);
  // Those of Hertz and Mindlin depend on the way: md oscillates into its equilibrium, and loses a share of F_T that is
  // of second order in the increment.
  const Difference large = compare_engines(NormalLaw::hertz, 0.004), small = compare_engines(NormalLaw::hertz, 0.0004);
  EXPECT_LT(large.force, 1e-2);
  EXPECT_LT(small.worst, 0.2 * large.worst);
  EXPECT_LT(small.force, 0.2 * large.force);
}

}  // namespace
}  // namespace galet::test::cd_compliance_test
