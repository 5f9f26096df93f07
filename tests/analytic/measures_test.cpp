// Measures on states that the engines have made, against statics: stress and forces on the walls of a box, mobilised
// friction of a heap and of a sliding disk, moduli of a network and the stress that a small strain brings about.
#include <gtest/gtest.h>

#include "common/measure/balance.hpp"
#include "common/measure/coordination.hpp"
#include "common/measure/elastic_moduli.hpp"
#include "common/measure/mobilisation.hpp"
#include "common/measure/stress.hpp"
#include "tests/support/scenes.hpp"

namespace galet::test::measures_test {
namespace {

/// A loosened triangular crystal of unlike disks between four smooth planes: left, right, floor, lid.
Sample<2> boxed(int cells, double spacing, double room) {
  Sample<2> sample = crystal_sample<2>(cells, spacing);
  vary_sizes<2>(sample, 0.1, 5);
  sample.cell.periodic.fill(false);
  const Vec<2> low = Vec<2>::Constant(0.25 * spacing - 0.5 - room);
  const Vec<2> high = sample.cell.box.diagonal() - Vec<2>(0.25 * spacing, 0.25 * std::sqrt(3.0) * spacing) +
                      Vec<2>::Constant(0.5 + room);
  sample.planes = {{Vec<2>(low.x(), 0), Vec<2>::UnitX(), Vec<2>::Zero()},
                   {Vec<2>(high.x(), 0), -Vec<2>::UnitX(), Vec<2>::Zero()},
                   {Vec<2>(0, low.y()), Vec<2>::UnitY(), Vec<2>::Zero()},
                   {Vec<2>(0, high.y()), -Vec<2>::UnitY(), Vec<2>::Zero()}};
  sample.plane_material.assign(4, 1);
  return sample;
}

Vec<2> force_on_plane(const Snapshot<2>& snapshot, int plane) {
  Vec<2> sum = Vec<2>::Zero();
  for (std::size_t c = 0; c < snapshot.contacts->size(); ++c)
    if (snapshot.contacts->j[c] == snapshot.grains() + plane) sum += snapshot.contacts->force[c];
  return sum;
}

/// In equilibrium V sigma = sum over planes of F (x) x. For the normal stresses of a box: force times distance of
/// planes.
void expect_stress_of_walls(const Snapshot<2>& snapshot, double tolerance) {
  ASSERT_LT(unbalance(snapshot, rattlers(snapshot, true)).force, tolerance);
  const Mat<2> virial = stress(snapshot).contact * snapshot.cell->volume();
  const double width = snapshot.planes[1].point.x() - snapshot.planes[0].point.x();
  const double height = snapshot.planes[3].point.y() - snapshot.planes[2].point.y();
  const double scale = virial.trace();
  ASSERT_GT(scale, 0);
  // Each grain out of balance by `tolerance` of a contact force at some place in the box: a few times its size.
  const double error = 10 * tolerance * scale;
  EXPECT_NEAR(virial(0, 0), force_on_plane(snapshot, 1).x() * width, error);
  EXPECT_NEAR(virial(0, 0), -force_on_plane(snapshot, 0).x() * width, error);
  EXPECT_NEAR(virial(1, 1), force_on_plane(snapshot, 3).y() * height, error);
  EXPECT_NEAR(virial(1, 1), -force_on_plane(snapshot, 2).y() * height, error);
}

TEST(MeasuresMd, StressIsTheForceOnTheWalls) {
  Scene scene = free_scene(2, 0.3, 0.3, 1e3);
  scene.other_materials = {{.name = "smooth", .friction = 0.0}};
  scene.md.drag = 1;
  const Sample<2> sample = boxed(4, 1.0, -0.02);
  const auto engine = make_engine<2>(EngineKind::md, scene, sample);
  engine->advance(60000);
  expect_stress_of_walls(engine->snapshot(), 1e-6);
}

TEST(MeasuresCd, StressIsTheForceOnTheWalls) {
  Scene scene = free_scene(2, 0.3, 0, 1e3);
  scene.other_materials = {{.name = "smooth", .friction = 0.0}};
  scene.cd.dt = 0.01;
  scene.cd.tolerance = 1e-8;
  Sample<2> sample = boxed(4, 1.12, 0.05);
  sample.planes[1].inverse_mass = sample.planes[3].inverse_mass = 0.1;
  sample.planes[1].force = 3;
  sample.planes[3].force = 4;
  const auto engine = make_engine<2>(EngineKind::cd, scene, sample);
  engine->advance(6000);  // time 60, twice what grains and pistons need to come to rest
  const Snapshot<2> state = engine->snapshot();
  expect_stress_of_walls(state, 1e-5);
  EXPECT_NEAR(force_on_plane(state, 1).x(), 3, 1e-4);
  EXPECT_NEAR(force_on_plane(state, 3).y(), 4, 1e-4);
}

// Two disks on a floor, a distance s > d apart, carry a third: at the angle alpha, sin alpha = s / 2d, the ratio F_T /
// F_N is tan(alpha/2) between disks and a third of it on the floor (T7 with alpha = 30 degrees).
double heap_mobilisation(EngineKind kind, double mu, double apart) {
  Scene scene = free_scene(2, mu, 0.1, 1e5);
  scene.loading.gravity = {0, -1};
  scene.cd.dt = 1e-2;
  scene.cd.tolerance = 1e-10;
  scene.cd.max_sweeps = 100000;
  Sample<2> sample = ball_on_plane<2>(up<2>(), 0.0);
  const Vec<2> left = sample.position[0];
  const auto planes = sample.planes;
  sample.resize(3);
  sample.planes = planes;
  sample.position = {left, left + Vec<2>(apart, 0), left + Vec<2>(apart / 2, std::sqrt(1 - apart * apart / 4))};
  const auto engine = make_engine<2>(kind, scene, sample);
  engine->advance(kind == EngineKind::md ? 400000 : 50);
  const Mobilisation used = mobilisation(engine->snapshot());
  EXPECT_EQ(used.contacts, 4);
  EXPECT_EQ(used.sliding, 0);
  return used.mean;
}

TEST(Measures, MobilisedFrictionOfAHeap) {
  const double mu = 0.6, apart = 1.1, alpha = std::asin(apart / 2);
  const double expected = (2 * std::tan(alpha / 2) + 2 * std::tan(alpha / 2) / 3) / 4 / mu;
  // md: deflections of 1e-5 d turn the contacts by as much; cd: its tolerance, and the drift of 50 steps.
  for (const EngineKind kind : both_engines) EXPECT_NEAR(heap_mobilisation(kind, mu, apart), expected, 1e-3);
}

// A disk that slides on a plane (T2): friction is mobilised until it rolls, at t = v_0 / (3 mu g), and then not.
TEST(Measures, ASlidingDiskMobilisesAllFriction) {
  for (const EngineKind kind : both_engines) {
    Scene scene = free_scene(2, 0.2, 0.1, 1e4);
    scene.loading.gravity = {0, -1};
    scene.material.tangential_damping_ratio = kind == EngineKind::md ? 0.1 : 0;
    scene.cd.dt = 1e-3;
    Sample<2> sample = ball_on_plane<2>(up<2>(), kind == EngineKind::md ? -1e-4 : 0.0);
    sample.velocity[0] = Vec<2>(0.6, 0);
    const auto engine = make_engine<2>(kind, scene, sample);
    const double rolls = 0.6 / (3 * 0.2);
    engine->advance(std::lround(0.5 * rolls / engine->dt()));
    EXPECT_EQ(mobilisation(engine->snapshot()).sliding, 1);
    engine->advance(std::lround(2 * rolls / engine->dt()));
    EXPECT_EQ(mobilisation(engine->snapshot()).sliding, 0);
    EXPECT_LT(mobilisation(engine->snapshot()).mean, 1e-3);
  }
}

/// A pressed crystal of soft and hard disks, stretched by `stretch` along its axes and relaxed.
Mat<2> relaxed_stress(const Scene& scene, Sample<2> sample, const Vec<2>& stretch, Snapshot<2>* state = nullptr,
                      std::unique_ptr<Engine<2>>* keep = nullptr) {
  sample.cell.box = stretch.asDiagonal() * sample.cell.box;
  for (Vec<2>& x : sample.position) x = x.cwiseProduct(stretch);
  auto engine = make_engine<2>(EngineKind::md, scene, sample);
  engine->advance(40000);
  const Snapshot<2> snapshot = engine->snapshot();
  const Mat<2> sigma = stress(snapshot).contact;
  if (state != nullptr) *state = snapshot, *keep = std::move(engine);
  return sigma;
}

// Moduli of a network that does not deform affinely, against the stress that the engine answers a strain with. The
// difference, by first-order terms of the prestress, is of the order of P / K = 2e-3 of the moduli.
TEST(MeasuresMd, ModuliAreTheStressOfASmallStrain) {
  Scene scene = periodic_scene(2, 0, 0.3, 1e3);
  scene.other_materials = {{.name = "soft", .normal_stiffness = 200}};
  scene.md.drag = 2;
  Sample<2> sample = crystal_sample<2>(4, 0.998);
  for (int i = 0; i < sample.count(); ++i) sample.material[i] = RandomStream(8, i).uniform() < 0.5 ? 1 : 0;
  Snapshot<2> state;
  std::unique_ptr<Engine<2>> engine;
  const Mat<2> before = relaxed_stress(scene, sample, Vec<2>(1, 1), &state, &engine);
  ASSERT_EQ(state.contacts->size(), 3u * sample.count());
  const Derived derived = derive_for<2>(scene, sample);
  const auto springs = contact_stiffness(state, derived.laws, sample.material, {});
  const auto moduli = elastic_moduli(state, springs, {false, true});
  ASSERT_TRUE(moduli);
  EXPECT_LT(moduli->bulk, 0.9 * moduli->affine_bulk);  // so that the test tells the two apart
  const double strain = 1e-5;
  const Mat<2> along = (relaxed_stress(scene, sample, Vec<2>(1 - strain, 1)) - before) / strain;
  const double scale = moduli->stiffness(0, 0);
  EXPECT_NEAR(along(0, 0), moduli->stiffness(0, 0), 0.01 * scale);
  EXPECT_NEAR(along(1, 1), moduli->stiffness(0, 1), 0.01 * scale);
}

}  // namespace
}  // namespace galet::test::measures_test
