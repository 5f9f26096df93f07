// No closed loading cycle yields work, and a rigid rotation changes nothing: the tangential laws by themselves, driven
// through the same functions as the engine.
#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "common/core/random.hpp"
#include "md/laws/normal.hpp"
#include "md/laws/spring.hpp"
#include "md/pair_terms.hpp"
#include "tests/support/sanitized.hpp"

namespace galet::md::test::contact_cycle_test {
namespace {

constexpr Kernel kernel{true, false, true};

// The engine's functions, one lane wide.
using Lane = Lanes<1>;
using LaneVector = Space<Lane>;
LaneVector to_lanes(const Vec<3>& v) { return {v.x(), v.y(), v.z()}; }
Vec<3> from_lanes(const LaneVector& v) { return {v.x.v, v.y.v, v.z.v}; }

/// A point of a loading path: deflection and tangential displacement.
struct Point {
  double deflection;
  Vec<3> shear;
};

/// A closed polygon of 3 to 8 random corners, and the friction met on it.
struct Cycle {
  std::vector<Point> corners;
  double friction;
};

constexpr double coefficient = 1e4;
constexpr double depth = 1e-3;  // deflections are between a tenth of this and this

Cycle random_cycle(std::uint64_t number) {
  RandomStream random(11, number);
  Cycle cycle;
  cycle.corners.resize(3 + static_cast<int>(random.uniform(0, 6)));
  for (Point& corner : cycle.corners)
    corner = {depth * random.uniform(0.1, 1), depth * Vec<3>(random.uniform(-1, 1), random.uniform(-1, 1), 0)};
  // From always sliding to never sliding.
  cycle.friction = std::pow(10.0, random.uniform(-1.5, 1.5));
  return cycle;
}

/// Goes once around the cycle, each edge in 20 steps of which each changes first h, then delta (so that the work is the
/// sum of F.d(delta), without error of quadrature). `visit(h, d(delta))` is called for every step.
template <class Visit>
void walk(const Cycle& cycle, Visit visit) {
  const std::size_t count = cycle.corners.size();
  for (std::size_t k = 0; k < count; ++k) {
    const Point &from = cycle.corners[k], &to = cycle.corners[(k + 1) % count];
    for (int step = 1; step <= 20; ++step)
      visit(from.deflection + (to.deflection - from.deflection) * step / 20.0, Vec<3>((to.shear - from.shear) / 20.0));
  }
}

PairTerms<Lane> law_of() {
  PairTerms<Lane> law;
  law.tangential_ratio = 0.8;
  return law;
}

NormalForce<Lane> normal_force_of(bool hertz, double deflection) {
  return normal_force<kernel, Lane>({hertz, false, false}, law_of(), coefficient, 0.0, deflection, 0.0);
}

/// Energy that a contact of h = delta = depth stores: the scale of the cycles' work.
double scale(bool hertz) { return elastic_energy({hertz, false, false}, coefficient, depth); }

/// Work done on the contact by the law of the engine over the cycle, and what is left in its spring.
struct Balance {
  double work = 0, stored = 0, lost = 0;
};

Balance around(const Cycle& cycle, bool hertz) {
  LaneVector spring{0.0, 0.0, 0.0};
  Balance balance;
  double before = 0, stiffness = 0;
  const double dt = 0.01;
  walk(cycle, [&](double h, const Vec<3>& shear) {
    const NormalForce<Lane> normal = normal_force_of(hertz, h);
    stiffness = (law_of().tangential_ratio * normal.stiffness).v;
    Losses<Lane> losses;
    if (before > 0 && hertz) adapt_spring<kernel, Lane>(before, stiffness, dt, spring, losses);
    const double limit = cycle.friction * normal.bound.v;
    const SpringTerms<Lane> terms{stiffness, limit, limit, 1.0, 0.0, false, dt / 2, dt / 2};
    Mask<1> slides;
    const Vec<3> force =
        from_lanes(spring_force<kernel>({true}, terms, to_lanes(shear / dt), spring, 0, slides, losses));
    EXPECT_LE(force.norm(), limit * (1 + 1e-12));
    balance.work += force.dot(shear);
    balance.lost += dt * (losses.plastic + losses.unloading + losses.viscous).v;
    EXPECT_GE(losses.plastic.v, -1e-12 * scale(hertz) / dt);
    EXPECT_GE(losses.unloading.v, -1e-12 * scale(hertz) / dt);
    before = stiffness;
  });
  balance.stored = 0.5 * stiffness * squared(spring).v;
  return balance;
}

/// The naive hertzian increment: dF = K_T(h) d(delta), F kept while h changes.
double naive_work(const Cycle& cycle) {
  Vec<3> force = Vec<3>::Zero();
  double work = 0;
  walk(cycle, [&](double h, const Vec<3>& shear) {
    const NormalForce<Lane> normal = normal_force_of(true, h);
    const Vec<3> start = force;
    force += (law_of().tangential_ratio * normal.stiffness).v * shear;
    const double limit = cycle.friction * normal.bound.v;
    if (force.norm() > limit) force *= limit / force.norm();
    work += 0.5 * (start + force).dot(shear);
  });
  return work;
}

constexpr int cycles = galet::test::sanitized ? 2000 : 100000;

TEST(ContactCycle, NeverYieldsWork) {
  for (const bool hertz : {false, true}) {
    SCOPED_TRACE(hertz ? "Mindlin" : "linear");
    double least = INFINITY;
    int dissipative = 0;
    for (int k = 0; k < cycles; ++k) {
      const Balance balance = around(random_cycle(k), hertz);
      // Rounding of up to 160 terms of the size of `scale`.
      ASSERT_GE(balance.work, -1e-12 * scale(hertz)) << "cycle " << k;
      ASSERT_NEAR(balance.work, balance.stored + balance.lost, 1e-11 * (scale(hertz) + balance.work)) << "cycle " << k;
      least = std::min(least, balance.work);
      dissipative += balance.work > 1e-3 * scale(hertz);
    }
    // The cycles are no trivial ones: most of them cost work; for the linear law some never slide and give all back.
    EXPECT_GT(dissipative, cycles / 2);
    if (!hertz) {
      EXPECT_LT(least, 1e-12 * scale(hertz));
    }
  }
}

TEST(ContactCycle, NaiveIncrementYieldsWork) {
  int yields = 0;
  for (int k = 0; k < cycles; ++k) yields += naive_work(random_cycle(k)) < -1e-3 * scale(true);
  // The test above can fail: among the same cycles this law has many that pay.
  EXPECT_GT(yields, cycles / 100);
}

/// A dashpot beside the spring takes energy only, in both conventions.
TEST(ContactCycle, ViscosityOnlyDissipates) {
  for (const bool total : {false, true})
    for (int k = 0; k < 2000; ++k) {
      const Cycle cycle = random_cycle(k);
      const double stiffness = 8000, dt = 0.01, limit = cycle.friction * coefficient * depth;
      LaneVector spring{0.0, 0.0, 0.0};
      double work = 0, lost = 0;
      walk(cycle, [&](double, const Vec<3>& shear) {
        Losses<Lane> losses;
        const SpringTerms<Lane> terms{stiffness, limit, limit, 1.0, 30.0, total, dt / 2, dt / 2};
        Mask<1> slides;
        const Vec<3> force =
            from_lanes(spring_force<kernel>({true}, terms, to_lanes(shear / dt), spring, 0, slides, losses));
        if (total) {
          EXPECT_LE(force.norm(), limit * (1 + 1e-12));
        }
        work += force.dot(shear);
        lost += dt * (losses.plastic + losses.viscous).v;
        EXPECT_GE(losses.plastic.v, -1e-12 * scale(false) / dt);
        EXPECT_GE(losses.viscous.v, 0);
      });
      ASSERT_NEAR(work, lost + 0.5 * stiffness * squared(spring).v, 1e-11 * (scale(false) + work)) << "cycle " << k;
    }
}

/// A loaded contact carried through 1e5 (with sanitizers: 1e4) random rotations keeps its force in the frame that turns
/// with it.
TEST(ContactRotation, KeepsForceInTheMovingFrame) {
  for (const double angle : {1e-4, 1e-3, 1e-2}) {  // largest turn per step
    SCOPED_TRACE(angle);
    RandomStream random(12, 1);
    Eigen::Quaterniond frame = Eigen::Quaterniond::Identity();
    const Vec<3> normal_at_start = Vec<3>(2, 3, 6).normalized();
    const Vec<3> force_at_start = normal_at_start.cross(Vec<3>(0.3, -0.5, 0.9));
    Vec<3> normal = normal_at_start, force = force_at_start;
    for (int step = 0; step < (galet::test::sanitized ? 10000 : 100000); ++step) {
      const Vec<3> turn = angle * Vec<3>(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
      const double norm = turn.norm();
      frame = (Eigen::Quaterniond(Eigen::AngleAxisd(norm, turn / norm)) * frame).normalized();
      const Vec<3> next = frame * normal_at_start;
      const LaneVector turned = twisted<Lane>(to_lanes(force), to_lanes(normal), to_lanes(turn), 1.0);
      force = from_lanes(carried(turned, to_lanes(normal), to_lanes(next)));
      normal = next;
    }
    // Rounding of 1e5 steps adds up like a random walk: 300 times 2e-16, and a margin of ten in each of both sides.
    EXPECT_NEAR(force.norm(), force_at_start.norm(), 1e-11);
    EXPECT_LT((force - frame * force_at_start).norm(), 1e-10);
    EXPECT_LT(std::abs(force.dot(normal)), 1e-15);
  }
}

}  // namespace
}  // namespace galet::md::test::contact_cycle_test
