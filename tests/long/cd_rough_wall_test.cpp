// Plane shear between two rough walls, the upper one pressed by a force, against the periodic cell at the inertial
// number that the flow between the walls has.
#include <gtest/gtest.h>

#include "common/measure/stress.hpp"
#include "tests/support/scenes.hpp"

namespace galet::test::cd_rough_wall_test {
namespace {

constexpr double friction = 0.4, pressure = 1, dt = 0.02;
constexpr int columns = 12, rows = 26;

Scene flow_scene() {
  Scene scene = periodic_scene(2, friction, 0.1, 1e4);
  scene.cd.dt = dt;
  scene.cd.tolerance = 1e-3;
  return scene;
}

struct Flow {
  double mu = 0;        ///< shear over normal stress
  double inertial = 0;  ///< I
};

/// Walls: the lowest and the highest row of a square lattice. `speed` of the upper wall.
Flow between_walls(double speed) {
  Scene scene = flow_scene();
  scene.cell.periodic = {true, false};
  scene.bodies = {
      {.name = "floor"},
      {.name = "lid", .velocity = {speed, 0}, .free = {false, true}, .force = {0, -pressure * columns * 1.2}}};
  Sample<2> sample;
  sample.resize(columns * rows);
  sample.cell.box = Vec<2>(columns * 1.2, 3 * rows).asDiagonal();
  sample.cell.periodic = {true, false};
  for (int k = 0; k < sample.count(); ++k)
    sample.position[k] = Vec<2>((k % columns + 0.5) * 1.2, (k / columns + 1) * 1.2 + rows / 2.0);
  vary_sizes<2>(sample, 0.2, 61);
  sample.body.assign(sample.count(), -1);
  for (int k = 0; k < columns; ++k) sample.body[k] = 0, sample.body[sample.count() - 1 - k] = 1;
  const auto engine = make_engine<2>(EngineKind::cd, scene, sample);
  engine->advance(std::lround(250 / dt));
  Flow flow;
  constexpr int looks = 5000;
  double shear = 0, normal = 0, slope = 0;
  for (int look = 0; look < looks; ++look) {
    engine->advance(1);  // every step: impulses of impacts are rare and large
    const Snapshot<2> state = engine->snapshot();
    // Forces on the lid's grains.
    for (std::size_t c = 0; c < state.contacts->size(); ++c) {
      const bool lid_j = state.contacts->j[c] >= sample.count() - columns,
                 lid_i = state.contacts->i[c] >= sample.count() - columns;
      if (lid_i == lid_j) continue;
      const Vec<2> force = lid_j ? state.contacts->force[c] : Vec<2>(-state.contacts->force[c]);
      shear -= force.x(), normal += force.y();
    }
    // Shear rate in the middle half: least squares of v_x against y.
    const double low = state.position[0].y(), high = state.position[sample.count() - 1].y();
    double n = 0, y = 0, v = 0, yy = 0, yv = 0;
    for (int k = columns; k < sample.count() - columns; ++k) {
      const double at = state.position[k].y();
      if (at < low + 0.25 * (high - low) || at > low + 0.75 * (high - low)) continue;
      n += 1, y += at, v += state.velocity[k].x(), yy += at * at, yv += at * state.velocity[k].x();
    }
    slope += (n * yv - y * v) / (n * yy - y * y) / looks;
  }
  flow.mu = shear / normal;
  flow.inertial = slope;  // d = m = P = 1
  // On the mean the lid is not accelerated: a mass of 12 with a velocity of some tenths, over a time of 100.
  EXPECT_NEAR(normal / looks, pressure * columns * 1.2, 0.1);
  return flow;
}

Flow in_a_cell(double rate) {
  Scene scene = flow_scene();
  scene.loading.kind = LoadingKind::plane_shear;
  scene.loading.shear_rate = rate;
  scene.loading.pressure = pressure;
  const auto engine = make_engine<2>(EngineKind::cd, scene, gas_sample<2>(12, 0.54, 0.2, 62, 0.1));
  engine->advance(std::lround(100 / dt));
  Mat<2> sum = Mat<2>::Zero();
  for (int look = 0; look < 2000; ++look) {
    engine->advance(2);
    sum += stress<2>(engine->snapshot()).total();
  }
  return {-sum(0, 1) / sum(1, 1), rate};
}

TEST(RoughWallFlowCd, HasTheFrictionLawOfThePeriodicCell) {
  const Flow walls = between_walls(2.5);
  const Flow cell = in_a_cell(walls.inertial);
  RecordProperty("permille_mu_walls", static_cast<int>(1000 * walls.mu));
  RecordProperty("permille_mu_cell", static_cast<int>(1000 * cell.mu));
  RecordProperty("permille_inertial_number", static_cast<int>(1000 * walls.inertial));
  EXPECT_GT(walls.inertial, 0.03);
  EXPECT_LT(walls.inertial, 0.2);
  // 144 to 312 grains, over strains of some 10: standard errors of about 2 %, 3 % of their difference; two and a half
  // of these.
  EXPECT_NEAR(walls.mu, cell.mu, 0.075 * cell.mu);
}

}  // namespace
}  // namespace galet::test::cd_rough_wall_test
