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
    const SpringTerms<Lane> terms{stiffness, limit, 0.0, false, dt / 2, dt / 2};
    const auto ahead = [&] { return SpringAhead<Lane>{limit, 1.0}; };
    Mask<1> slides;
    const Vec<3> force =
        from_lanes(spring_force<kernel>({true}, terms, ahead, to_lanes(shear / dt), spring, 0, slides, losses));
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
        const SpringTerms<Lane> terms{stiffness, limit, 30.0, total, dt / 2, dt / 2};
        const auto ahead = [&] { return SpringAhead<Lane>{limit, 1.0}; };
        Mask<1> slides;
        const Vec<3> force =
            from_lanes(spring_force<kernel>({true}, terms, ahead, to_lanes(shear / dt), spring, 0, slides, losses));
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

/// How many of the springs that have slid, and whose pairs then rest, go on sliding.
template <Kernel K>
int sliding_at_rest() {
  constexpr double dt = 0.01;
  int sliding = 0;
  for (int number = 0; number < 2000; ++number) {
    RandomStream random(12, number);
    const double stiffness = random.uniform(1, 10), limit = random.uniform(0.1, 1), longest = limit / stiffness;
    const SpringTerms<Lane> terms{stiffness, limit, 0.0, false, dt / 2, dt / 2, 1 / stiffness, 2.0};
    const auto ahead = [&] { return SpringAhead<Lane>{limit, 1.0}; };
    LaneVector spring{0.0, 0.0, 0.0};
    Vec<3> rate = 20 * longest / dt * Vec<3>(random.uniform(-1, 1), random.uniform(-1, 1), 1);
    for (int step = 0; step < 4; ++step) {
      Mask<1> slides;
      Losses<Lane> losses;
      const Vec<3> force = from_lanes(spring_force<K>({true}, terms, ahead, to_lanes(rate), spring, 0, slides, losses));
      EXPECT_NEAR(force.norm(), limit, 1e-14 * limit);  // a few roundings
      EXPECT_TRUE(step > 0 || slides.on);
      if (step > 0 && slides.on) ++sliding;
      rate.setZero();
    }
  }
  return sliding;
}

TEST(ContactSpring, StopsSlidingWhereThePairRests) {
  EXPECT_EQ((sliding_at_rest<Kernel{true, false, true}>()), 0);
  EXPECT_EQ((sliding_at_rest<Kernel{false, false, false}>()), 0);
}

/// The force of a pair at unit distance that turns rigidly by `turn` in a step that ends with the normal `next`.
Vec<3> turned(const Vec<3>& force, const Vec<3>& next, const Vec<3>& turn) {
  return from_lanes(carried<Lane>(to_lanes(force), to_lanes(next), 1.0, to_lanes(Vec<3>(turn.cross(next))),
                                  to_lanes(Vec<3>(2 * turn)), 0.5));
}

/// A loaded contact carried through 1e5 (with sanitizers: 1e4) random rotations keeps its force in the frame that turns
/// with it.
TEST(ContactRotation, KeepsForceInTheMovingFrame) {
  const int steps = galet::test::sanitized ? 10000 : 100000;
  for (const double angle : {1e-4, 1e-3, 1e-2}) {  // largest turn per step, by component
    SCOPED_TRACE(angle);
    RandomStream random(12, 1);
    Eigen::Quaterniond frame = Eigen::Quaterniond::Identity();
    const Vec<3> normal_at_start = Vec<3>(2, 3, 6).normalized();
    const Vec<3> force_at_start = normal_at_start.cross(Vec<3>(0.3, -0.5, 0.9));
    Vec<3> force = force_at_start;
    for (int step = 0; step < steps; ++step) {
      const Vec<3> turn = angle * Vec<3>(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
      const double norm = turn.norm();
      frame = (Eigen::Quaterniond(Eigen::AngleAxisd(norm, turn / norm)) * frame).normalized();
      const Vec<3> normal = frame * normal_at_start;
      force = turned(force, normal, turn);
      ASSERT_LT(std::abs(force.dot(normal)), 1e-15);
    }
    // A step errs by w_n w_T^2 / 4 at most, (angle^3) / 4 for components of that size, in directions at random:
    // three times the walk of so many steps. To it comes that of rounding, 300 times 2e-16, with a margin of a
    // thousand.
    const double error = 3 * std::sqrt(steps) * std::pow(angle, 3) / 4 + 1e-10;
    EXPECT_NEAR(force.norm(), force_at_start.norm(), error);
    EXPECT_LT((force - frame * force_at_start).norm(), error);
  }
}

/// A steady turn about an axis across the normal: of a force in the plane of the turn a share theta^4 / 24 is lost per
/// step, one along the axis keeps its norm.
TEST(ContactRotation, SteadyTurnOfTheNormal) {
  const double angle = 1e-2;
  const int steps = 10000;
  const Vec<3> turn(0, 0, angle);
  Vec<3> along = Vec<3>::UnitY(), across = Vec<3>::UnitZ();
  for (int step = 1; step <= steps; ++step) {
    const Vec<3> normal(std::cos(step * angle), std::sin(step * angle), 0);
    along = turned(along, normal, turn), across = turned(across, normal, turn);
  }
  EXPECT_NEAR((1 - along.norm()) / (steps * std::pow(angle, 4) / 24), 1, 1e-3);  // terms of theta^6
  EXPECT_NEAR(across.norm(), 1, 1e-12);
}

/// A steady turn about the normal keeps the norm to rounding, and errs by psi^3 / 12 in the angle.
TEST(ContactRotation, SteadyTurnAboutTheNormal) {
  const double angle = 1e-2;
  const int steps = 10000;
  Vec<3> force = Vec<3>::UnitY();
  for (int step = 0; step < steps; ++step) force = turned(force, Vec<3>::UnitX(), Vec<3>(angle, 0, 0));
  EXPECT_NEAR(force.norm(), 1, 1e-12);  // rounding, 1e-16 per step
  const double lag = steps * std::pow(angle, 3) / 12, expected = steps * angle - lag;
  const Vec<3> direction(0, std::cos(expected), std::sin(expected));
  EXPECT_LT((force - direction).norm(), 1e-2 * lag);
}

}  // namespace
}  // namespace galet::md::test::contact_cycle_test
