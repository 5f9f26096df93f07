// Elastic frictionless grains keep their energy: md up to an error of order dt^2 that does not grow steadily, cd up
// to the solver's tolerance.
#include <gtest/gtest.h>

#include "tests/support/scenes.hpp"

namespace galet::test::energy_test {
namespace {

struct Drift {
  double rms = 0;      ///< of the relative energy error over the run
  double secular = 0;  ///< rise of the fitted straight line over the run
};

/// Relative energy error of a run, sampled `samples` times over `duration`.
template <int D>
Drift energy_drift(Engine<D>& engine, double duration, int samples) {
  const double start = engine.energy().total();
  const long steps = std::lround(duration / engine.dt() / samples);
  double sum = 0, square = 0, moment = 0, position = 0;
  for (int k = 0; k < samples; ++k) {
    engine.advance(steps);
    const double error = engine.energy().total() / start - 1;
    const double x = (k + 0.5) / samples - 0.5;
    sum += error, square += error * error, moment += x * error, position += x * x;
  }
  return {std::sqrt(square / samples), moment / position};
}

/// A ball that bounces elastically on a plane under gravity: `bounces` collisions of one kind, one after the other.
std::unique_ptr<Engine<2>> bouncing_ball(double dt) {
  Scene scene = free_scene(2, 0, 1, 1e4);
  scene.loading.gravity = {0, -1};
  set_dt(scene, dt);
  Sample<2> sample = ball_on_plane<2>(up<2>(), 0.02);
  // Energy is counted from y = 0; the plane is put there so that m g y is no large number.
  sample.planes[0].point.y() = 1;
  sample.position[0].y() = 1.52;
  return make_engine<2>(EngineKind::md, scene, sample);
}

TEST(EnergyMd, ElasticBallDoesNotDrift) {
  // Contacts last pi / sqrt(K/m) = 0.0314, flights 0.4: 700 bounces. A step that straddles the opening of the contact
  // misplaces an energy of up to K (v dt)^2 / 8 = (w0 dt)^2 / 4 of the kinetic energy (at most m g 0.02 of the
  // 1.52 m g here); the errors of closing and opening cancel on average. 4 of these, in rms, are far less than a
  // drift of one such error per bounce would give (175 in rms, 600 in rise).
  const double dt = 0.0314 / 50.3;
  const double single = 1e4 * dt * dt / 4 * 0.02 / 1.52;
  const auto engine = bouncing_ball(dt);
  const Drift drift = energy_drift<2>(*engine, 300, 300);
  EXPECT_LT(drift.rms, 20 * single);
  EXPECT_LT(std::abs(drift.secular), 20 * single);
}

/// Rms energy error after one elastic collision of a pair, over the impact phases.
double pair_energy_error(double dt) {
  Scene scene = free_scene(2, 0, 1, 1e4);
  scene.md.allow_unsafe_dt = true;
  set_dt(scene, dt);
  const double speed = 0.1;
  double sum = 0;
  const int phases = 24;
  for (int k = 0; k < phases; ++k) {
    Sample<2> sample = pair_sample<2>(generic_direction<2>(), (1 + (k + 0.3) / phases) * speed * dt);
    set_relative_velocity<2>(sample, -speed * generic_direction<2>());
    const auto engine = make_engine<2>(EngineKind::md, scene, sample);
    const double start = engine->energy().total();
    engine->advance(std::lround(0.03 / dt));  // the contact lasts 0.0222
    EXPECT_EQ(engine->energy().elastic_normal, 0);
    sum += std::pow(engine->energy().total() / start - 1, 2);
  }
  return std::sqrt(sum / phases);
}

TEST(EnergyMd, ErrorOfACollisionIsOfFourthOrder) {
  const std::array dt{0.0222 / 20.7, 0.0222 / 41.3, 0.0222 / 82.7, 0.0222 / 165.3};
  std::array<double, 4> error;
  for (std::size_t k = 0; k < 4; ++k) error[k] = pair_energy_error(dt[k]);
  // Velocity Verlet of a harmonic contact keeps a modified energy exactly; what it errs by comes from closing and
  // opening, at second order without their corrections (md/laws/crossing.hpp) and at fourth with them.
  EXPECT_GT(observed_order(dt, error), 3.5);
  EXPECT_LT(observed_order(dt, error), 4.5);
  EXPECT_LT(error[1], 3.4e-5);  // (w0 dt)^4 at 41 steps per contact
}

template <int D>
Drift gas_drift(double steps_per_contact) {
  Scene scene = periodic_scene(D, 0, 1, 1e4);
  scene.md.steps_per_contact = steps_per_contact;
  const Sample<D> sample = gas_sample<D>(D == 2 ? 8 : 4, 0.3, 0.2, 5, 0.1);
  const auto engine = make_engine<D>(EngineKind::md, scene, sample);
  return energy_drift<D>(*engine, 60, 200);
}

TEST(EnergyMd, ElasticGasDoesNotDrift) {
  // Some hundred collisions, each with a relative error of a few (w0 dt)^2 of the energy of two out of 64 grains and
  // with either sign: a random walk of at most 0.004 * (2/64) * sqrt(400) = 0.0025 at 50 steps per contact.
  for (const Drift drift : {gas_drift<2>(50), gas_drift<3>(50)}) {
    EXPECT_LT(drift.rms, 2.5e-3);
    EXPECT_LT(std::abs(drift.secular), 2.5e-3);
  }
  // A quarter of the step: a sixteenth of the error; a random walk need not scale to better than a factor 2.
  EXPECT_LT(gas_drift<2>(200).rms, 2.5e-3 / 8);
}

TEST(EnergyMd, FrictionAndDampingOnlyTakeEnergy) {
  // Damping, sliding and the loss of stretched springs all dissipate. Between two looks the energy may rise only by
  // the integrator's error, here 1e-4 of the start energy (1/10 of what the elastic gas is allowed, per look).
  Scene scene = periodic_scene(3, 0.5, 0.7, 1e4);
  const Sample<3> sample = gas_sample<3>(4, 0.28, 0.2, 6, 0.1);
  const auto engine = make_engine<3>(EngineKind::md, scene, sample);
  const double start = engine->energy().total();
  double last = start;
  for (int look = 0; look < 200; ++look) {
    engine->advance(100);
    const double now = engine->energy().total();
    EXPECT_LT(now - last, 1e-4 * start);
    last = now;
  }
  EXPECT_LT(last, 0.9 * start);
}

/// Runs an elastic rigid gas: no step may change its energy, also not when a grain collides twice in it.
template <int D>
void check_rigid_gas(double dt, double duration) {
  Scene scene = periodic_scene(D, 0, 1, 1e4);
  scene.cd.tolerance = 1e-12;
  scene.cd.max_sweeps = 20000;
  scene.cd.dt = dt;
  const auto engine = make_engine<D>(EngineKind::cd, scene, gas_sample<D>(D == 2 ? 8 : 4, D == 2 ? 0.5 : 0.28, 0.2, 7));
  const double start = engine->energy().total();
  double last = start, exchanged = 0;
  std::vector<Vec<D>> velocity(engine->snapshot().velocity.begin(), engine->snapshot().velocity.end());
  while (engine->time() < duration) {
    engine->advance(1);
    const double now = engine->energy().total();
    // Impulses are right to 1e-12 of themselves; 64 grains at most collide in a step.
    ASSERT_NEAR(now, last, 1e-11 * start) << "time " << engine->time();
    last = now;
  }
  const Snapshot<D> end = engine->snapshot();
  for (std::size_t i = 0; i < velocity.size(); ++i) exchanged += (end.velocity[i] - velocity[i]).squaredNorm();
  EXPECT_GT(exchanged, 0.5 * start) << "the grains did collide";
  EXPECT_EQ(engine->solver_summary().missed, 0);
  EXPECT_NEAR(last, start, 1e-9 * start);  // the same over some thousand steps
}

TEST(EnergyCd, ElasticGasKeepsItsEnergy) {
  check_rigid_gas<2>(4e-3, 8);
  check_rigid_gas<2>(1e-3, 4);
  check_rigid_gas<3>(1e-3, 4);
}

TEST(EnergyCd, FrictionAndRestitutionOnlyTakeEnergy) {
  Scene scene = periodic_scene(2, 0.5, 0.7, 1e4);
  scene.cd.tolerance = 1e-10;
  scene.cd.max_sweeps = 20000;
  scene.cd.dt = 5e-3;
  const auto engine = make_engine<2>(EngineKind::cd, scene, gas_sample<2>(8, 0.5, 0.2, 8, 1));
  const double start = engine->energy().total();
  double last = start;
  for (int step = 0; step < 500; ++step) {
    engine->advance(1);
    const double now = engine->energy().total();
    EXPECT_LT(now - last, 1e-8 * start) << step;  // the tolerance, with a factor for 64 contacts
    last = now;
  }
  EXPECT_LT(last, 0.7 * start);
}

}  // namespace
}  // namespace galet::test::energy_test
