// Smooth cylinders as boundaries, both engines, disks and spheres: impact, rest, rolling, a turning drum.
#include <gtest/gtest.h>

#include "tests/support/scenes.hpp"
#include "tests/unit/scene_mistakes.hpp"

namespace galet::test::cylinder_test {
namespace {

constexpr double wall = 5, ball = 0.5;  // R_c, R

/// A ball in or around a cylinder whose axis goes through the middle of a large cell, at a gap along `out` (a unit
/// vector across the axis).
template <int D>
Sample<D> ball_at_cylinder(bool inside, const Vec<D>& out, double gap, const Vec<D>& axis) {
  Sample<D> sample;
  sample.cell = cube<D>(40, false);
  sample.resize(1);
  Plane<D> surface;
  surface.point = Vec<D>::Constant(20);
  surface.radius = wall, surface.inside = inside;
  surface.axis = axis;
  sample.planes = {surface};
  // Anywhere along the axis.
  const Vec<D> along = D == 3 ? Vec<D>(2.5 * axis) : Vec<D>(Vec<D>::Zero());
  sample.position[0] = surface.point + along + (inside ? wall - ball - gap : wall + ball + gap) * out;
  return sample;
}

template <int D>
Vec<D> some_axis() {
  return generic_direction<D>();
}

/// The unit vector across the axis that is `angle` away from straight down; the axis is level (y in 3D).
template <int D>
Vec<D> down(double angle) {
  Vec<D> out = Vec<D>::Zero();
  out[0] = std::sin(angle), out[D - 1] = -std::cos(angle);
  return out;
}
template <int D>
Vec<D> level_axis() {
  return Vec<D>::Unit(1);  // of no effect on disks
}

template <int D>
void check_impact(EngineKind kind, bool inside) {
  constexpr double e = 0.6, speed = 1;
  Scene scene = free_scene(D, 0.3, e, 1e5);
  scene.md.steps_per_contact = 400;
  scene.cd.dt = 1e-3;
  scene.cd.tolerance = 1e-12;
  const Vec<D> axis = some_axis<D>();
  const Vec<D> out = D == 2 ? Vec<D>(generic_direction<D>()) : Vec<D>(generic_tangent<D>(axis));
  Sample<D> sample = ball_at_cylinder<D>(inside, out, 0.05, axis);
  const Vec<D> towards = inside ? out : Vec<D>(-out);
  sample.velocity[0] = speed * towards;
  const auto engine = make_engine<D>(kind, scene, sample);
  engine->advance(std::lround(0.2 / engine->dt()));
  // md: second order in 1/400 of a contact, within a factor of some ten. cd: Newton's law, to the solver's tolerance.
  EXPECT_LT((engine->snapshot().velocity[0] + e * speed * towards).norm(), kind == EngineKind::md ? 1e-3 : 1e-10)
      << to_string(kind) << " D = " << D << " inside " << inside;
}

TEST(Cylinder, ReboundsWithItsRestitution) {
  for (const EngineKind kind : both_engines)
    for (const bool inside : {true, false}) check_impact<2>(kind, inside), check_impact<3>(kind, inside);
}

template <int D>
void check_rest(EngineKind kind) {
  Scene scene = free_scene(D, 0.3, 0.05, 1e4);
  scene.loading.gravity.assign(D, 0);
  scene.loading.gravity.back() = -1;
  scene.cd.tolerance = 1e-12;
  const auto engine = make_engine<D>(kind, scene, ball_at_cylinder<D>(true, down<D>(0), 0, level_axis<D>()));
  engine->advance(std::lround(1 / engine->dt()));
  const Snapshot<D> state = engine->snapshot();
  ASSERT_EQ(state.contacts->size(), 1u);
  // md: a bounce from gap 0 of depth m g / K is damped by exp(-zeta w t), w = 100.
  EXPECT_NEAR(state.contacts->force[0][D - 1], -1, 1e-9) << "weight on the wall";
  EXPECT_NEAR(state.contacts->gap[0], kind == EngineKind::md ? -1e-4 : 0, 1e-12);
  EXPECT_EQ(state.contacts->j[0], 1);
}

TEST(Cylinder, CarriesABallAtRest) {
  for (const EngineKind kind : both_engines) check_rest<2>(kind), check_rest<3>(kind);
}

/// Period of small oscillations about the bottom, from where x passes the middle.
template <int D>
double period(EngineKind kind, double friction) {
  Scene scene = free_scene(D, friction, 0.05, 1e5);
  scene.loading.gravity.assign(D, 0);
  scene.loading.gravity.back() = -1;
  scene.cd.dt = 1e-3;
  scene.cd.tolerance = 1e-10;
  const auto engine = make_engine<D>(kind, scene, ball_at_cylinder<D>(true, down<D>(0.05), 0, level_axis<D>()));
  std::vector<double> passes;
  double before = engine->snapshot().position[0][0] - 20;
  const long steps = std::max(1L, std::lround(1e-3 / engine->dt()));
  while (passes.size() < 3 && engine->time() < 100) {
    engine->advance(steps);
    const double x = engine->snapshot().position[0][0] - 20;
    if (before * x < 0) passes.push_back(engine->time() - steps * engine->dt() * x / (x - before));
    before = x;
  }
  return passes.size() == 3 ? passes[2] - passes[0] : 0;
}

/// T = 2 pi sqrt((1 + k) (R_c - R) / g): k = I / (m R^2) where it rolls, 0 where it slides freely.
template <int D>
void check_period(EngineKind kind) {
  const double k = inertia_ratio<D>, free = 2 * pi * std::sqrt(wall - ball);
  // The amplitude lengthens it by phi^2 / 16 = 1.6e-4; cd takes off a share v dt / (R_c - R) of speed per length, of no
  // effect on the period at first order; tangential springs lengthen it by about g / (K (R_c - R)).
  EXPECT_NEAR(period<D>(kind, 0) / free, 1, 4e-4) << to_string(kind) << " D = " << D << " sliding";
  EXPECT_NEAR(period<D>(kind, 1) / free, std::sqrt(1 + k), 4e-4) << to_string(kind) << " D = " << D << " rolling";
}

TEST(Cylinder, BallOscillatesAtItsPeriodMd) { check_period<2>(EngineKind::md), check_period<3>(EngineKind::md); }
TEST(Cylinder, BallOscillatesAtItsPeriodCd) { check_period<2>(EngineKind::cd), check_period<3>(EngineKind::cd); }

template <int D>
Spin<D> about_level_axis(double spin) {
  if constexpr (D == 2)
    return spin;
  else
    return -spin * Vec<3>::UnitY();  // x towards z, as a disk's from x towards y
}

/// In a turning drum a ball whose surface goes with the drum's, w R = Omega R_c, stays at the bottom for ever.
template <int D>
void check_rolling_in_place(EngineKind kind) {
  Scene scene = free_scene(D, 0.5, 0.05, 1e5);
  scene.loading.gravity.assign(D, 0);
  scene.loading.gravity.back() = -1;
  scene.cd.dt = 1e-3;
  scene.cd.tolerance = 1e-12;
  constexpr double drum = 0.3;
  Sample<D> sample = ball_at_cylinder<D>(true, down<D>(0), D == 2 ? -1e-5 : -1e-5, level_axis<D>());
  if (kind == EngineKind::cd) sample.position[0] += 1e-5 * down<D>(0) * -1;
  sample.planes[0].spin = about_level_axis<D>(drum);
  sample.spin[0] = about_level_axis<D>(drum * wall / ball);
  const Vec<D> start = sample.position[0];
  const auto engine = make_engine<D>(kind, scene, sample);
  engine->advance(std::lround(2 / engine->dt()));
  // md: lever arms are shorter by the deflection, 1e-5 of 0.5: the torque-free state has w R' = Omega R_c.
  EXPECT_LT((engine->snapshot().position[0] - start).norm(), 1e-4) << to_string(kind) << " D = " << D;
  EXPECT_NEAR(spin_norm(engine->snapshot().spin[0]) / (drum * wall / ball), 1, 1e-4) << to_string(kind) << " D = " << D;
  EXPECT_LT(engine->snapshot().velocity[0].norm(), 1e-4);
}

TEST(Cylinder, BallRollsInPlaceInATurningDrum) {
  for (const EngineKind kind : both_engines) check_rolling_in_place<2>(kind), check_rolling_in_place<3>(kind);
}

/// A ball at rest is put into a drum that turns: first it slides, with the whole friction, m k R dw/dt = mu N; on the
/// way it is carried up the side. Its first motion: a = mu g along the wall's, R dw/dt = mu g / k.
template <int D>
void check_first_slide(EngineKind kind, bool inside) {
  constexpr double friction = 0.2, drum = 2, time = 0.05;
  Scene scene = free_scene(D, friction, 0.05, 1e6);
  scene.loading.gravity.assign(D, 0);
  scene.loading.gravity.back() = -1;
  scene.cd.dt = 1e-4;
  scene.cd.tolerance = 1e-10;
  Sample<D> sample = ball_at_cylinder<D>(inside, inside ? down<D>(0) : Vec<D>(-down<D>(0)), 0, level_axis<D>());
  sample.planes[0].spin = about_level_axis<D>(drum);
  const auto engine = make_engine<D>(kind, scene, sample);
  engine->advance(std::lround(time / engine->dt()));
  // At the bottom (inside) the drum's surface moves towards +x, at the top (outside) towards -x.
  const double side = inside ? 1 : -1, expected = friction * time;
  // md: the normal force swings about m g at first, for a time of 1 / (zeta w) = 1.5e-3; N = m (g -+ v^2 / R): 1e-5.
  const double tolerance = kind == EngineKind::md ? 0.05 * expected : 2e-3 * expected;
  EXPECT_NEAR(engine->snapshot().velocity[0][0], side * expected, tolerance) << to_string(kind) << D << inside;
  EXPECT_NEAR(spin_norm(engine->snapshot().spin[0]) * ball, expected / inertia_ratio<D>, tolerance / inertia_ratio<D>);
}

TEST(Cylinder, DrumDragsABallThatSlides) {
  for (const EngineKind kind : both_engines)
    for (const bool inside : {true, false}) check_first_slide<2>(kind, inside), check_first_slide<3>(kind, inside);
}

/// md: what the drum gives is kinetic energy, heat and height. Second order in the step.
TEST(Cylinder, EnergyBudgetOfATurningDrumCloses) {
  const auto residual = [](double steps_per_contact) {
    Scene scene = free_scene(2, 0.3, 0.4, 1e4);
    scene.loading.gravity = {0, -1};
    scene.md.energy_budget = true;
    scene.md.steps_per_contact = steps_per_contact;
    Sample<2> sample = ball_at_cylinder<2>(true, down<2>(0.3), 0.02, level_axis<2>());
    sample.planes[0].spin = 1.5;
    const auto engine = make_engine<2>(EngineKind::md, scene, sample);
    const double start = engine->energy().total();
    engine->advance(std::lround(6 / engine->dt()));
    const EnergyFlows flows = engine->energy_flows();
    EXPECT_GT(flows.work, 0.5) << "the drum works";
    return std::abs(engine->energy().total() - start - flows.work + flows.viscous + flows.sliding + flows.unloading) /
           flows.work;
  };
  // Impacts straddle steps at random: errors of 1 / steps^2, some of which don't cancel.
  EXPECT_LT(residual(50), 1e-3);
  EXPECT_LT(residual(400), 1e-4);
}

/// Hertz' law: R* at a cylinder is the geometric mean of the curvatures' radii.
TEST(Cylinder, HertzDeflectionFollowsTheCurvature) {
  EXPECT_NEAR(reduced_radius_at(Plane<3>{}, 0.5), 0.5, 1e-15);
  Plane<3> cylinder;
  cylinder.radius = 5;
  EXPECT_NEAR(reduced_radius_at(cylinder, 0.5), 0.5 / std::sqrt(0.9), 1e-15);
  cylinder.inside = false;
  EXPECT_NEAR(reduced_radius_at(cylinder, 0.5), 0.5 / std::sqrt(1.1), 1e-15);
}

TEST(Cylinder, BadOnesAreRefused) {
  using Mistakes = std::vector<std::string>;
  const std::string scene = R"(material = {restitution = 0.5, normal_stiffness = 1e4}
run.duration = 1
grains.count = 4
cell = {size = [9, 9], periodic = [false, false]}
)";
  const auto refused = [&](const std::string& cylinder) {
    return mistakes_of(scene + "cylinder = [{" + cylinder + "}]\n");
  };
  EXPECT_EQ(refused("point = [4, 4], radius = 4"), Mistakes{});
  EXPECT_EQ(refused("point = [4, 4]"), (Mistakes{"5:13: cylinder[0].radius is needed: a length > 0"}));
  EXPECT_EQ(refused("point = [4, 4, 4], radius = 4"),
            (Mistakes{"5:22: cylinder[0].point: 2D needs 2 components, got 3"}));
  EXPECT_EQ(refused("point = [4, 4], radius = 4, spin = 1"),
            (Mistakes{"5:49: cylinder[0].spin needs material.friction > 0: a smooth surface that turns has no effect "
                      "without"}));
  EXPECT_EQ(refused("point = [4, 4], radius = 4, axis = \"x\""),
            (Mistakes{"5:49: cylinder[0].axis needs dimension = 3: in 2D the axis is the third direction"}));
  EXPECT_EQ(refused("point = [4, 4], radius = 0.5"),
            (Mistakes{"5:39: cylinder[0].radius: 0.5 is too narrow for grains of diameter 1 inside"}));
  EXPECT_EQ(mistakes_of("material = {restitution = 0.5, normal_stiffness = 1e4}\nrun.duration = 1\ngrains.count = 4\n"
                        "cell.size = [9, 9]\ncylinder = [{point = [4, 4], radius = 4}]\n")
                .size(),
            2u)
      << "it crosses two periodic directions";
}

}  // namespace
}  // namespace galet::test::cylinder_test
