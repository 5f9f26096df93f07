// Impacts of rigid bodies against the impulses of rigid impact theory; cd in one step, md as its contacts stiffen.
#include <Eigen/LU>
#include <gtest/gtest.h>

#include "tests/support/rigid_bodies.hpp"

namespace galet::test::rigid_impact_test {
namespace {

/// A dumbbell along y in free space, and a grain that meets its upper grain with the relative velocity `approach`;
/// `normal` from the body to the grain.
template <int D>
Sample<D> impact_sample(const Vec<D>& normal, const Vec<D>& velocity) {
  Sample<D> sample = dumbbell_sample<D>(Vec<D>::Unit(1));
  add_grain<D>(sample, sample.position[1] + (1 + 1e-13) * normal, velocity);
  return sample;
}

/// Velocities after an impact with restitution e at which the contact point sticks (stick) or slips without friction.
template <int D>
struct Impact {
  Vec<D> grain, body;
  Spin<D> grain_spin, body_spin;

  Impact(const Vec<D>& normal, const Vec<D>& velocity, double restitution, bool stick) {
    // Responses of the contact point to a unit impulse along each axis, by the laws of motion of each body.
    const double inertia = D == 2 ? 0.75 : 0.7, line = D == 2 ? 0.75 : 0.2, own = inertia_ratio<D> / 4;
    const Vec<D> lever = 0.5 * Vec<D>::Unit(1) + 0.5 * normal, lever_grain = -0.5 * normal;
    const auto spun = [&](const Spin<D>& turn) {
      if constexpr (D == 2)
        return turn / inertia;
      else
        return Vec<3>(turn.x() / inertia, turn.y() / line, turn.z() / inertia);
    };
    Mat<D> response;
    for (int a = 0; a < D; ++a) {
      const Vec<D> p = Vec<D>::Unit(a);
      response.col(a) =
          p / 2.0 + cross(spun(cross(lever, p)), lever) + p + cross(Spin<D>(cross(lever_grain, p) / own), lever_grain);
    }
    // What the motion at the contact must change by: all of it, or the normal part alone.
    Vec<D> p;
    if (stick) {
      const Vec<D> wanted = -restitution * velocity.dot(normal) * normal;
      p = response.inverse() * (wanted - velocity);
    } else {
      p = -(1 + restitution) * velocity.dot(normal) / normal.dot(response * normal) * normal;
    }
    grain = velocity + p, body = -p / 2;
    grain_spin = cross(lever_grain, p) / own, body_spin = -spun(cross(lever, p));
  }

  double difference(const Snapshot<D>& state) const {
    return (state.velocity[2] - grain).norm() + (state.bodies[0].velocity - body).norm() +
           spin_norm(Spin<D>(state.spin[2] - grain_spin)) + spin_norm(Spin<D>(state.bodies[0].spin - body_spin));
  }
};

template <int D>
void check_rigid(double friction, double restitution, const Vec<D>& normal, const Vec<D>& velocity) {
  SCOPED_TRACE("D = " + std::to_string(D) + ", mu = " + std::to_string(friction));
  Scene scene = free_scene(D, friction, restitution, 1e4);
  scene.bodies = {free_body(D, "target")};
  set_dt(scene, 1e-6);  // the gyroscopic part of the step's end stays below 1e-5 of the velocities
  scene.cd.tolerance = 1e-12;
  const auto engine = make_engine<D>(EngineKind::cd, scene, impact_sample<D>(normal, velocity));
  engine->advance(1);
  EXPECT_LT((Impact<D>(normal, velocity, restitution, friction > 0).difference(engine->snapshot())), 1e-5);
  EXPECT_LE(engine->solver_summary().sweeps, 2) << "one contact is solved exactly";
}

TEST(RigidImpact, OffCentreBlowIsThatOfRigidImpactTheoryCd) {
  check_rigid<2>(0, 0.6, Vec<2>(1, 0), Vec<2>(-1, 0));
  check_rigid<2>(0, 1, generic_direction<2>(), Vec<2>(-1, -0.5));
  check_rigid<2>(50, 0.6, Vec<2>(1, 0), Vec<2>(-1, 0));
  check_rigid<2>(50, 0.3, generic_direction<2>(), Vec<2>(-1, -0.5));
  check_rigid<3>(0, 0.6, Vec<3>(1, 0, 0), Vec<3>(-1, 0, 0));
  check_rigid<3>(0, 1, generic_direction<3>(), Vec<3>(-0.3, -1, -0.5));
  check_rigid<3>(50, 0.6, Vec<3>(1, 0, 0), Vec<3>(-1, 0, 0.2));
  check_rigid<3>(50, 0.3, generic_direction<3>(), Vec<3>(-0.3, -1, -0.5));
}

TEST(RigidImpact, TangentialMotionReboundsByItsOwnCoefficientCd) {
  // u_T+ = -e_T u_T- and u_N+ = -e u_N- at a contact that sticks.
  Scene scene = free_scene(2, 50, 0.5, 1e4);
  scene.material.tangential_restitution = 0.4;
  scene.bodies = {free_body(2, "target")};
  set_dt(scene, 1e-6);
  scene.cd.tolerance = 1e-12;
  const auto engine = make_engine<2>(EngineKind::cd, scene, impact_sample<2>(Vec<2>(1, 0), Vec<2>(-1, 0.3)));
  engine->advance(1);
  const Snapshot<2> state = engine->snapshot();
  const Vec<2> point = state.bodies[0].velocity + cross(state.bodies[0].spin, Vec<2>(0.5, 0.5));
  const Vec<2> u = state.velocity[2] + cross(state.spin[2], Vec<2>(-0.5, 0)) - point;
  EXPECT_NEAR(u.x(), 0.5, 1e-5);
  EXPECT_NEAR(u.y(), -0.4 * 0.3, 1e-5);
}

/// md without damping: its impacts tend to those of rigid bodies with e = 1, as K grows.
template <int D>
void check_limit() {
  const Vec<D> normal = generic_direction<D>();
  Vec<D> velocity = -normal;
  velocity[0] -= 0.3;
  std::vector<double> duration, error;
  for (const double stiffness : {1e6, 1.6e7, 2.56e8}) {
    Scene scene = free_scene(D, 0, 1, stiffness);
    scene.bodies = {free_body(D, "target")};
    const auto engine = make_engine<D>(EngineKind::md, scene, impact_sample<D>(normal, velocity));
    const double time = 4 / std::sqrt(stiffness);
    engine->advance(std::lround(time / engine->dt()));
    ASSERT_FALSE(in_contact(engine->snapshot()));
    duration.push_back(time);
    error.push_back(Impact<D>(normal, velocity, 1, false).difference(engine->snapshot()));
  }
  EXPECT_LT(error.back(), 1e-3);
  // Bodies turn by some w tau during the impact.
  EXPECT_NEAR(observed_order(duration, error), 1, 0.2);
}

TEST(RigidImpact, SoftImpactTendsToTheRigidOne) {
  check_limit<2>();
  check_limit<3>();
}

/// Both engines, an impact that sticks: md's tangential springs give back what they hold, so that only a contact that
/// slides throughout has a rigid limit with friction. Then r_T = mu r_N against the sliding, which does not turn in 2D.
TEST(RigidImpact, SlidingImpactTendsToTheRigidOne) {
  const Vec<2> normal(1, 0), velocity(-1, 3);
  const auto run = [&](EngineKind kind, double stiffness) {
    Scene scene = free_scene(2, 0.1, 1, stiffness);
    scene.bodies = {free_body(2, "target")};
    scene.cd.dt = 1e-6;
    scene.cd.tolerance = 1e-12;
    auto engine = make_engine<2>(kind, scene, impact_sample<2>(normal, velocity));
    engine->advance(kind == EngineKind::cd ? 1 : std::lround(4 / std::sqrt(stiffness) / engine->dt()));
    return engine;
  };
  const auto rigid = run(EngineKind::cd, 1e6), soft = run(EngineKind::md, 1e9);
  const Snapshot<2> a = rigid->snapshot(), b = soft->snapshot();
  // tau = 1e-4: what turns meanwhile.
  EXPECT_LT((a.velocity[2] - b.velocity[2]).norm(), 1e-3);
  EXPECT_NEAR(a.bodies[0].spin, b.bodies[0].spin, 1e-3);
  EXPECT_GT(std::abs(a.spin[2]), 0.1) << "friction acted";
}

}  // namespace
}  // namespace galet::test::rigid_impact_test
