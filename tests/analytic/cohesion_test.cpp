// Cohesive forces of md (references.md, section 10; physics.md, section 1).
//   constant     F_N = F_el - F0 in contact, -F0 (1 - g / D0) across a gap 0 < g < D0; F_el = K h or k h^(3/2)
//   square_root  F_N = K h - sqrt(4 K F0 h)
// Coulomb's and the rolling bound refer to the repulsive part F_el. At rest without load F_el = F0 (constant) or 4 F0.
#include <gtest/gtest.h>

#include "tests/support/impact.hpp"

namespace galet::test::cohesion_test {
namespace {

constexpr double cohesion = 0.8;  // F0
constexpr double stiffness = 1e4;
constexpr Elastic matter{1e6, 0.3};

/// The laws that exist: square_root is for linear springs only.
struct Law {
  NormalLaw normal = NormalLaw::linear;
  CohesionLaw attraction = CohesionLaw::constant;

  std::string name() const {
    return to_string(normal) + (attraction == CohesionLaw::constant ? ", constant" : ", square root");
  }
  double coefficient(double reduced_radius) const {
    return normal == NormalLaw::linear ? stiffness : hertz_coefficient(contact_modulus(matter, matter), reduced_radius);
  }
  double elastic(double k, double h) const { return normal == NormalLaw::linear ? k * h : k * h * std::sqrt(h); }
  double force(double k, double h) const {
    return elastic(k, h) - (attraction == CohesionLaw::constant ? cohesion : std::sqrt(4 * k * cohesion * h));
  }
  /// Deflection under the elastic force f.
  double under(double k, double f) const { return normal == NormalLaw::linear ? f / k : std::pow(f / k, 2.0 / 3); }
  /// Elastic force when the total one is F: K h = F + 2 F0 + 2 sqrt(F0 (F0 + F)) for the square root.
  double elastic_at(double total) const {
    if (attraction == CohesionLaw::constant) return total + cohesion;
    return total + 2 * cohesion + 2 * std::sqrt(cohesion * (cohesion + total));
  }
};

const std::array all_laws{Law{NormalLaw::linear, CohesionLaw::constant}, Law{NormalLaw::hertz, CohesionLaw::constant},
                          Law{NormalLaw::linear, CohesionLaw::square_root}};

Scene cohesive_scene(const Law& law, int dim, double range = 0) {
  Scene scene = law.normal == NormalLaw::linear ? linear_scene(dim, 0, stiffness)
                                                : hertz_scene(dim, 0, matter.young, matter.poisson);
  scene.material.cohesion_law = law.attraction;
  scene.material.cohesion_force = cohesion;
  scene.material.cohesion_range = range;
  return scene;
}

template <int D>
void check_contact_force(const Law& law) {
  const Vec<D> n = generic_direction<D>();
  for (bool plane : {false, true})
    for (double h : {1e-6, 1e-5, 1e-4, 1e-3, 0.02}) {
      SCOPED_TRACE(law.name() + (plane ? ", plane" : ", pair") + ", h = " + std::to_string(h));
      const Sample<D> sample = plane ? ball_apart<D>(n, -h, 0.4, 1.5) : pair_apart<D>(n, -h, {0.3, 0.6}, {0.25, 2.0});
      const double k = law.coefficient(plane ? 0.4 : reduced(0.3, 0.6));
      const Probe<D> seen = probe<D>(cohesive_scene(law, D), sample, 1e-12);
      EXPECT_TRUE(seen.touches);
      EXPECT_NEAR(-seen.gap, h, 1e-14);  // rounding of positions of order 10
      const double expected = law.force(k, -seen.gap);
      // `gap` is computed apart from the contact pass: two ulps of a distance of order 1. With a plane the pass works
      // with the point of the plane next to the grain, rounded like any position of order 10 (2e-15 in each component).
      const double slope = (law.force(k, 1.001 * h) - law.force(k, h)) / (0.001 * h);
      const double rounding = (plane ? 4e-15 : 4e-16) * std::abs(slope);
      EXPECT_NEAR(seen.normal_force, expected, 1e-13 * (law.elastic(k, h) + cohesion) + rounding);
    }
}

TEST(Cohesion, ForceInContact) {
  for (const Law& law : all_laws) {
    check_contact_force<2>(law);
    check_contact_force<3>(law);
  }
}

template <int D>
void check_gap_force(NormalLaw normal, bool plane) {
  const double range = 0.3;
  const Vec<D> n = generic_direction<D>();
  const Scene scene = cohesive_scene({normal, CohesionLaw::constant}, D, range);
  const auto sample = [&](double gap) {
    return plane ? ball_apart<D>(n, gap, 0.4, 1.5) : pair_apart<D>(n, gap, {0.3, 0.6}, {0.25, 2.0});
  };
  for (double share : {1e-6, 0.01, 0.3, 0.7, 0.999}) {
    SCOPED_TRACE(to_string(normal) + " g / D0 = " + std::to_string(share));
    const Probe<D> seen = probe<D>(scene, sample(share * range), 1e-12);
    EXPECT_FALSE(seen.touches);
    EXPECT_NEAR(seen.gap, share * range, 1e-14);
    // Rounding of g, 1e-14, in a slope F0 / D0.
    EXPECT_NEAR(seen.normal_force, -cohesion * (1 - share), 1e-13);
    EXPECT_LT(seen.tangential_force.norm(), 1e-14);
  }
  Scene beyond = scene;
  set_dt(beyond, 1e-12);
  const auto engine = make_engine<D>(EngineKind::md, beyond, sample(1.001 * range));
  engine->advance(3);
  EXPECT_FALSE(in_contact<D>(engine->snapshot()));
  EXPECT_EQ(engine->energy().cohesive, 0);
}

TEST(Cohesion, ForceAcrossAGap) {
  for (NormalLaw normal : both_laws)
    for (bool plane : {false, true}) {
      check_gap_force<2>(normal, plane);
      check_gap_force<3>(normal, plane);
    }
}

template <int D>
void check_equilibrium(const Law& law) {
  SCOPED_TRACE(law.name() + ", D = " + std::to_string(D));
  const std::array radius{0.3, 0.6}, mass{0.25, 2.0};
  const double k = law.coefficient(reduced(radius[0], radius[1]));
  const double expected = law.under(k, law.attraction == CohesionLaw::constant ? cohesion : 4 * cohesion);
  Scene scene = cohesive_scene(law, D);
  scene.material.restitution.reset();
  scene.material.damping_ratio = 0.5;
  // K_N in Hertz: 1.5 k sqrt(h). Time 200 / w0: the slope of the total force is K_N (constant) or K_N / 2, so what is
  // out of balance decays by exp(-0.5 * 200 / 1.4) at least.
  const double slope = law.normal == NormalLaw::linear ? k : 1.5 * k * std::sqrt(expected);
  const double frequency = std::sqrt(slope / reduced(mass[0], mass[1]));
  set_dt(scene, 0.05 / frequency);
  const Sample<D> sample = pair_apart<D>(generic_direction<D>(), -1.4 * expected, radius, mass);
  const auto engine = make_engine<D>(EngineKind::md, scene, sample);
  engine->advance(4000);
  const Snapshot<D> state = engine->snapshot();
  ASSERT_EQ(state.contacts->size(), 1u);
  // Positions of order 10 stand still once they should move by less than 9e-16 in a step; the drift towards h0 is
  // 0.05 (h - h0) / (2 zeta) per step or half of that: 4e-14, and as much again for the rounding of h itself.
  EXPECT_NEAR(-state.contacts->gap[0], expected, 8e-14);
  EXPECT_LT(state.contacts->force[0].norm(), 8e-14 * slope);
}

TEST(Cohesion, EquilibriumDeflection) {
  for (const Law& law : all_laws) {
    check_equilibrium<2>(law);
    check_equilibrium<3>(law);
  }
}

/// A ball that hangs from a plane above it, at rest under its weight, or (above F0) under 99 % of F0. How far it has
/// come down after a time in which 1 % of F0 moves it by 50 deflections.
template <int D>
double descent(const Law& law, double weight) {
  Scene scene = cohesive_scene(law, D);
  scene.material.restitution = 0.5;
  const double mass = 1.3, k = law.coefficient(0.4);
  const double h = law.under(k, law.elastic_at(-std::min(weight, 0.99 * cohesion)));
  const Vec<D> g = -weight / mass * up<D>();
  scene.loading.gravity.assign(g.data(), g.data() + D);
  const Sample<D> sample = ball_apart<D>(up<D>(), -h, 0.4, mass);
  const double deepest = law.under(k, 4 * cohesion);
  const double duration = std::sqrt(2 * 50 * deepest * mass / (0.01 * cohesion));
  set_dt(scene, 0.05 * std::sqrt(mass * deepest / (4 * cohesion)));
  const auto engine = make_engine<D>(EngineKind::md, scene, sample);
  engine->advance(std::lround(duration / engine->dt()));
  return (sample.position[0] - engine->snapshot().position[0])[D - 1] / deepest;
}

TEST(Cohesion, PullOffForce) {
  for (const Law& law : all_laws) {
    SCOPED_TRACE(law.name());
    for (double share : {0.5, 0.98}) {
      // At rest: only rounding, 1e-14 of 1e-4, which the shallow end of the force law enlarges by 1 / (1 - share).
      EXPECT_NEAR(descent<2>(law, share * cohesion), 0, 1e-8);
      EXPECT_NEAR(descent<3>(law, share * cohesion), 0, 1e-8);
    }
    EXPECT_GT(descent<2>(law, 1.01 * cohesion), 10);
    EXPECT_GT(descent<3>(law, 1.01 * cohesion), 10);
  }
}

/// A pair (in a periodic cell also across its boundary) or a ball and a plane, coming from far. With y = D0 - g,
/// y'' = (F0 / (m* D0)) y: y = (v0 / s) sinh(s t) from the instant when g = D0. Dashpots do not act across gaps.
template <int D>
void check_approach(Sample<D> sample, double reduced_mass, double zeta) {
  const double range = 0.3, speed = 0.05, pull = 0.02, gap = 0.9;
  Scene scene = cohesive_scene({}, D, range);
  scene.material.cohesion_force = pull;
  scene.material.restitution.reset();
  scene.material.damping_ratio = zeta;
  for (int a = 0; a < D; ++a) scene.cell.periodic[a] = sample.cell.periodic[a];
  const double dt = 1e-3;
  set_dt(scene, dt);
  const Vec<D> n = generic_direction<D>();
  set_relative_velocity<D>(sample, -speed * n);
  const auto engine = make_engine<D>(EngineKind::md, scene, sample);
  const double arrival = (gap - range) / speed, rate = std::sqrt(pull / (reduced_mass * range));
  const double touching = arrival + std::asinh(range * rate / speed) / rate;
  engine->advance(std::lround(0.999 * arrival / dt));
  EXPECT_FALSE(in_contact<D>(engine->snapshot()));
  EXPECT_NEAR(relative_velocity<D>(engine->snapshot()).dot(n), -speed, 1e-15);
  for (double share : {0.05, 0.3, 0.6, 0.99}) {
    SCOPED_TRACE(share);
    const double target = arrival + share * (touching - arrival);
    engine->advance(std::lround((target - engine->time()) / dt));
    const Snapshot<D> state = engine->snapshot();
    const double inside = rate * (engine->time() - arrival);
    ASSERT_EQ(state.contacts->size(), 1u);
    EXPECT_FALSE(state.contacts->touches(0));
    // The force starts from zero at g = D0: second order, (rate dt)^2 = 1.4e-7 with a coefficient of order 1.
    EXPECT_NEAR(relative_velocity<D>(state).dot(n), -speed * std::cosh(inside), 1e-6 * speed);
    const double depth = speed / rate * std::sinh(inside);
    EXPECT_NEAR(state.contacts->gap[0], range - depth, 1e-6 * range);
    EXPECT_NEAR(state.contacts->force[0].dot(state.contacts->normal[0]), -pull * depth / range, 2e-6 * pull);
    EXPECT_NEAR(engine->energy().cohesive, -pull * depth * depth / (2 * range), 4e-6 * pull * range);
  }
}

template <int D>
void check_approach_everywhere() {
  const Vec<D> n = generic_direction<D>();
  for (double zeta : {0.0, 0.5}) {
    check_approach<D>(pair_apart<D>(n, 0.9, {0.5, 0.5}, {1, 1}), 0.5, zeta);
    check_approach<D>(pair_apart<D>(n, 0.9, {0.3, 0.6}, {0.25, 2.0}), reduced(0.25, 2.0), zeta);
    check_approach<D>(ball_apart<D>(n, 0.9, 0.5, 0.7), 0.7, zeta);
  }
}

TEST(Cohesion, ApproachFromAfarDisks) { check_approach_everywhere<2>(); }
TEST(Cohesion, ApproachFromAfarSpheres) { check_approach_everywhere<3>(); }

TEST(Cohesion, ApproachAcrossAPeriodicBoundary) {
  // The pair straddles a corner of the cell: relative_velocity does not care, the contact must know the image.
  Sample<2> sample = pair_apart<2>(generic_direction<2>(), 0.9, {0.5, 0.5}, {1, 1});
  sample.cell.periodic.fill(true);
  const Vec<2> shift = Vec<2>(20, 20) - (sample.position[0] + sample.position[1]) / 2;
  for (Vec<2>& position : sample.position) position += shift;
  sample.position[1] -= Vec<2>(20, 20);
  check_approach<2>(sample, 0.5, 0);
}

/// An undamped pair that flies through its well, is thrown back by the contact, and leaves as fast as it came. Returns
/// the largest error of the energy, in units of F0 times the deflection under F0, and that of the final speed.
struct Passage {
  double energy = 0, speed = 0;
};

Passage passage(const Law& law, double range, double dt_factor, double phase) {
  const double k = law.coefficient(0.25), h0 = law.under(k, cohesion), mass = 0.5;
  const double frequency = std::sqrt(cohesion / (mass * h0)), speed = 0.8 * h0 * frequency;
  Scene scene = cohesive_scene(law, 2, range);
  const double dt = dt_factor / frequency;
  set_dt(scene, dt);
  const Vec<2> n = generic_direction<2>();
  Sample<2> sample = pair_apart<2>(n, range + (1 + phase) * speed * dt, {0.5, 0.5}, {1, 1});
  set_relative_velocity<2>(sample, -speed * n);
  const auto engine = make_engine<2>(EngineKind::md, scene, sample);
  const double start = 0.5 * mass * speed * speed, unit = cohesion * h0;
  Passage result;
  const double longest = 2 * range / speed + 40 / frequency;
  bool inside = false;
  while (engine->time() < longest) {
    engine->advance(1);
    const EnergyParts parts = engine->energy();
    result.energy = std::max(result.energy, std::abs(parts.total() - start) / unit);
    const double gap = meeting<2>(engine->snapshot()).gap;
    if (gap < range) inside = true;
    if (inside && gap > range) break;
  }
  EXPECT_TRUE(inside);
  EXPECT_EQ(engine->energy().cohesive, 0) << "zero out of range";
  result.speed = std::abs(meeting<2>(engine->snapshot()).opening_speed / speed - 1);
  return result;
}

struct Well {
  Law law;
  double range;  ///< D0
  double order;  ///< of the errors of energy and speed
};

TEST(Cohesion, EnergyThroughCaptureAndEscape) {
  const double range = 2e-3;
  const std::array wells{Well{all_laws[0], range, 2}, Well{all_laws[1], range, 2}, Well{all_laws[0], 0, 1},
                         Well{all_laws[1], 0, 1}, Well{all_laws[2], 0, 1.5}};
  for (const Well& well : wells) {
    SCOPED_TRACE(well.law.name() + ", D0 = " + std::to_string(well.range));
    const std::array dt{0.1, 0.05, 0.025, 0.0125, 0.00625};
    std::array<double, 5> energy{}, speed{};
    const int phases = 8;
    for (std::size_t level = 0; level < 5; ++level)
      for (int p = 0; p < phases; ++p) {
        const Passage seen = passage(well.law, well.range, dt[level], (p + 0.37) / phases);
        energy[level] += seen.energy / phases, speed[level] += seen.speed / phases;
      }
    // Second order where the force is continuous. Without a range the force jumps by F0 (a step across misplaces up to
    // F0 v dt, i.e. 0.8 dt in these units, at either end) or starts as sqrt(h) ((v dt)^(3/2)). With one, the scheme's
    // ripple of some (w0 dt)^2 / 8 of the energy at the bottom, F0 (h0 + D0 / 2).
    EXPECT_GT(observed_order(dt, energy), well.order - 0.2) << energy[0] << " " << energy[4];
    EXPECT_GT(observed_order(dt, speed), well.order - 0.2) << speed[0] << " " << speed[4];
    const double depth = well.range / (2 * well.law.under(well.law.coefficient(0.25), cohesion));
    EXPECT_LT(energy[4], (2 + depth / 2) * std::pow(dt[4], well.order));
    EXPECT_LT(speed[4], 4 * std::pow(dt[4], well.order));
  }
}

TEST(Cohesion, EnergyPartsInContact) {
  for (const Law& law : all_laws)
    for (double range : {0.0, 0.05}) {
      if (law.attraction == CohesionLaw::square_root && range > 0) continue;  // has no range
      SCOPED_TRACE(law.name() + " D0 = " + std::to_string(range));
      const double h = 3e-4, k = law.coefficient(0.25);
      Scene scene = cohesive_scene(law, 2, range);
      set_dt(scene, 1e-12);
      const auto engine =
          make_engine<2>(EngineKind::md, scene, pair_apart<2>(generic_direction<2>(), -h, {0.5, 0.5}, {1, 1}));
      engine->advance(3);
      const EnergyParts parts = engine->energy();
      // The integrals of the forces from out of range to h; h is rounded by 1e-14, 1e-10 of itself.
      const double elastic = law.normal == NormalLaw::linear ? k * h * h / 2 : 0.4 * k * std::pow(h, 2.5);
      const double cohesive = law.attraction == CohesionLaw::constant
                                  ? -cohesion * (h + range / 2)
                                  : -4.0 / 3 * std::sqrt(k * cohesion) * std::pow(h, 1.5);
      EXPECT_NEAR(parts.elastic_normal, elastic, 1e-9 * elastic);
      EXPECT_NEAR(parts.cohesive, cohesive, -1e-9 * cohesive);
    }
}

/// With damping: q = h - h0 is a damped oscillator that starts from q = -h0 at speed v; the pair escapes iff q comes
/// back to -h0. Returns its speed then (in units of v), or 0.
double escape_speed(double zeta, double speed_over_h0_w0) {
  const double s = std::sqrt(1 - zeta * zeta), v = speed_over_h0_w0;
  const auto q = [&](double t) { return std::exp(-zeta * t) * (-std::cos(s * t) + (v - zeta) / s * std::sin(s * t)); };
  const auto rate = [&](double t) { return (q(t + 1e-6) - q(t - 1e-6)) / 2e-6; };
  for (double t = 1e-3; t < 2 * pi / s; t += 1e-4) {
    if (q(t) >= -1) continue;
    double low = t - 1e-4, high = t;
    for (int k = 0; k < 60; ++k) (q((low + high) / 2) > -1 ? low : high) = (low + high) / 2;
    return -rate(low) / v;
  }
  return 0;
}

TEST(Cohesion, DampedPairIsCapturedOrEscapes) {
  const double h0 = cohesion / stiffness, frequency = std::sqrt(stiffness / 0.5);
  for (double zeta : {0.05, 0.2})
    for (double ratio : {0.3, 0.7, 2.0, 5.0}) {
      SCOPED_TRACE("zeta = " + std::to_string(zeta) + " v / (h0 w0) = " + std::to_string(ratio));
      const double expected = escape_speed(zeta, ratio), speed = ratio * h0 * frequency, dt = 5e-4 / frequency;
      Scene scene = cohesive_scene({}, 2);
      scene.material.restitution.reset();
      scene.material.damping_ratio = zeta;
      set_dt(scene, dt);
      const Vec<2> n = generic_direction<2>();
      Sample<2> sample = pair_apart<2>(n, 1.37 * speed * dt, {0.5, 0.5}, {1, 1});
      set_relative_velocity<2>(sample, -speed * n);
      const auto engine = make_engine<2>(EngineKind::md, scene, sample);
      if (expected == 0) {
        // exp(-zeta w0 t) = 1e-6: at rest at h0 (the amplitude was a few h0).
        engine->advance(std::lround(14 / zeta / frequency / dt));
        EXPECT_NEAR(-meeting<2>(engine->snapshot()).gap / h0, 1, 1e-5);
      } else {
        run_until_apart<2>(*engine, 20 / frequency);
        // F0 and the damping force jump at both ends: half a step of (F0 + 2 zeta w0 m* v) / m* each, over v: first
        // order, (1 / ratio + 2 zeta) w0 dt, divided by the escape speed since it is the energy that is misplaced.
        EXPECT_NEAR(meeting<2>(engine->snapshot()).opening_speed / speed, expected,
                    (1 / ratio + 2 * zeta) * 5e-4 / expected);
      }
    }
  EXPECT_EQ(escape_speed(0.2, 0.7), 0);
  EXPECT_GT(escape_speed(0.05, 5), 0.5);
}

}  // namespace
}  // namespace galet::test::cohesion_test
