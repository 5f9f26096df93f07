// Clumps pressed in a cell: both engines bring them to rest under the pressure that was asked for.
#include <gtest/gtest.h>

#include "common/measure/stress.hpp"
#include "tests/support/rigid_bodies.hpp"

namespace galet::test::clump_cell_test {
namespace {

/// Momentum of fluctuations obeys dP/dt = -L P: none stays none.
template <int D>
void check_pressed(EngineKind kind) {
  SCOPED_TRACE(to_string(kind) + " D = " + std::to_string(D));
  auto [scene, sample] = clump_gas<D>(D == 2 ? 4 : 2, 0.3, 85);
  scene.material.restitution = 0.1;
  scene.loading.kind = LoadingKind::isotropic;
  scene.loading.pressure = 1;
  scene.cd.dt = 0.01;
  scene.cd.tolerance = 1e-6;
  scene.cd.max_sweeps = 10000;
  const int clumps = static_cast<int>(scene.bodies.size());
  Vec<D> momentum = Vec<D>::Zero();
  for (int b = 0; b < clumps; ++b)
    momentum += 2.4 * Eigen::Map<const Vec<D>>(scene.bodies[b].velocity.data()) + sample.velocity[4 * b + 3];
  for (BodySpec& body : scene.bodies)
    for (int a = 0; a < D; ++a) body.velocity[a] -= momentum[a] / (3.4 * clumps);
  for (int b = 0; b < clumps; ++b) sample.velocity[4 * b + 3] -= momentum / (3.4 * clumps);
  const auto engine = make_engine<D>(kind, scene, sample);
  engine->advance(std::lround(30 / engine->dt()));
  double speed = 0;
  // Mean over some steps: what is left of the motion of the cell makes the stress sway about its target.
  Mat<D> sum = Mat<D>::Zero();
  for (int look = 0; look < 100; ++look) {
    engine->advance(kind == EngineKind::md ? 20 : 2);
    sum += stress<D>(engine->snapshot()).total() / 100;
  }
  const BodyMomenta<D> momenta = body_momenta<D>(engine->snapshot(), sample.body, Vec<D>::Zero());
  for (const Vec<D>& v : engine->snapshot().velocity) speed = std::max(speed, v.norm());
  EXPECT_LT(momenta.linear.norm(), 1e-10);
  EXPECT_NEAR(sum.trace() / D, 1, 0.01);
  EXPECT_LT(speed, 0.05);
  // At rest no torque is left on any body: the stress of its branches is symmetric, where that of the grains' is not.
  EXPECT_NEAR(sum(0, 1), sum(1, 0), 0.01);
}

TEST(ClumpsInACell, CarryThePressure) {
  for (EngineKind kind : both_engines) check_pressed<2>(kind), check_pressed<3>(kind);
}

}  // namespace
}  // namespace galet::test::clump_cell_test
