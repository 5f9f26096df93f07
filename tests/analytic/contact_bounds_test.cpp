// Bounds of friction and of rolling resistance when contacts stick together or are damped (references.md, C5, C10):
// both refer to the repulsive part of F_N, K h (or k h^(3/2)); with the `total` convention to max(0, K h - alpha u_N),
// to which cohesion only adds -F0.
//   constant     norm(F_T) <= mu (F_N + F0); at F_N = 0: mu F0, and a torque of mu_R F0
//   square_root  norm(F_T) <= mu K h = mu F_N H(F0 / F_N), H(x) = 1 + 2x + 2 sqrt(x + x^2); at F_N = 0: 4 mu F0
// Very heavy grains keep their places and spins; their spins make them slip or roll on each other.
#include <gtest/gtest.h>

#include "tests/support/impact.hpp"

namespace galet::test::contact_bounds_test {
namespace {

constexpr double stiffness = 1, cohesion = 0.01;  // h0 = 0.01 (constant), 0.04 (square root)
constexpr Elastic matter{10, 0.2};
constexpr double friction = 0.4, rolling_friction = 0.02, pivoting_friction = 0.03;
constexpr double heavy = 1e20;  // forces of 0.05 move it by 1e-15 in a time of 1000

struct Law {
  NormalLaw normal = NormalLaw::linear;
  CohesionLaw attraction = CohesionLaw::constant;
  DampingConvention convention = DampingConvention::elastic;

  std::string name() const {
    return to_string(normal) + (attraction == CohesionLaw::constant ? ", constant, " : ", square root, ") +
           to_string(convention);
  }
  double coefficient() const {
    return normal == NormalLaw::linear ? stiffness : hertz_coefficient(contact_modulus(matter, matter), 0.25);
  }
  double deflection(double elastic) const {
    return normal == NormalLaw::linear ? elastic / stiffness : std::pow(elastic / coefficient(), 2.0 / 3);
  }
  double tangent(double h) const {
    return normal == NormalLaw::linear ? stiffness : 1.5 * coefficient() * std::sqrt(h);
  }
  double tangential_ratio() const {
    return normal == NormalLaw::linear ? 0.5 : (2 - 2 * matter.poisson) / (2 - matter.poisson);
  }
};

std::vector<Law> all_laws() {
  std::vector<Law> laws;
  for (DampingConvention convention : both_conventions) {
    laws.push_back({NormalLaw::linear, CohesionLaw::constant, convention});
    laws.push_back({NormalLaw::hertz, CohesionLaw::constant, convention});
    laws.push_back({NormalLaw::linear, CohesionLaw::square_root, convention});
  }
  return laws;
}

Scene sticky_scene(const Law& law, int dim) {
  Scene scene = law.normal == NormalLaw::linear ? linear_scene(dim, friction, stiffness)
                                                : hertz_scene(dim, friction, matter.young, matter.poisson);
  scene.material.cohesion_law = law.attraction;
  scene.material.cohesion_force = cohesion;
  scene.material.convention = law.convention;
  scene.material.rolling_friction = rolling_friction;
  if (dim == 3) scene.material.pivoting_friction = pivoting_friction;
  return scene;
}

/// Two heavy grains whose contact carries the elastic force `elastic`.
template <int D>
Sample<D> heavy_pair(const Law& law, double elastic) {
  return pair_apart<D>(generic_direction<D>(), -law.deflection(elastic), {0.5, 0.5}, {heavy, heavy});
}

/// The spin axis that makes grains slip along the tangent.
template <int D>
Spin<D> slip_axis() {
  return cross(generic_direction<D>(), generic_tangent<D>(generic_direction<D>()));
}

struct Force {
  double normal, tangential;
};

template <int D>
Force force_of(const Snapshot<D>& state) {
  const Vec<D> force = state.contacts->force.at(0), n = state.contacts->normal.at(0);
  return {force.dot(n), (force - force.dot(n) * n).norm()};
}

template <int D>
void check_friction_bound(const Law& law, double normal_force, double elastic) {
  SCOPED_TRACE(law.name() + ", D = " + std::to_string(D) + ", F_N / F0 = " + std::to_string(normal_force / cohesion));
  const double h = law.deflection(elastic), lever = 1 - h;
  const double stiffness_t = law.tangential_ratio() * law.tangent(h), bound = friction * elastic;
  const double slip_speed = 1e-3, yield_time = bound / (stiffness_t * slip_speed);
  Sample<D> sample = heavy_pair<D>(law, elastic);
  // Equal spins: the surfaces slip at (l_0 + l_1) w, but nothing rolls.
  for (Spin<D>& spin : sample.spin) spin = slip_speed / lever * slip_axis<D>();
  Scene scene = sticky_scene(law, D);
  set_dt(scene, yield_time / 200);
  const auto engine = make_engine<D>(EngineKind::md, scene, sample);
  engine->advance(100);
  // Half of the bound; the first step may be counted by half or not.
  EXPECT_NEAR(force_of<D>(engine->snapshot()).tangential / bound, 0.5, 1.01 / 200);
  engine->advance(110);
  for (int look = 0; look < 20; ++look) {
    engine->advance(10);
    const Force now = force_of<D>(engine->snapshot());
    // Rounding: of positions of order 10, 1e-14 / 0.01; the normal force of F_N = 0 is a difference of forces F0.
    EXPECT_NEAR(now.normal, normal_force, 1e-11 * cohesion);
    EXPECT_NEAR(now.tangential / bound, 1, 1e-11);
  }
  const Snapshot<D> state = engine->snapshot();
  EXPECT_LT(spin_norm(state.contacts->torque.at(0)), 1e-12 * rolling_friction * cohesion);
}

TEST(ContactBounds, FrictionOfConstantCohesion) {
  for (const Law& law : all_laws()) {
    if (law.attraction != CohesionLaw::constant) continue;
    for (double over : {-0.9, -0.5, 0.0, 1.0, 4.0}) {
      const double normal = over * cohesion;
      check_friction_bound<2>(law, normal, normal + cohesion);
      check_friction_bound<3>(law, normal, normal + cohesion);
    }
  }
}

TEST(ContactBounds, FrictionOfSquareRootCohesion) {
  for (const Law& law : all_laws()) {
    if (law.attraction != CohesionLaw::square_root) continue;
    check_friction_bound<2>(law, 0, 4 * cohesion);
    check_friction_bound<3>(law, 0, 4 * cohesion);
    check_friction_bound<2>(law, -cohesion, cohesion);  // the largest traction, at K h = F0
    for (double over : {0.5, 1.0, 3.0}) {
      const double x = 1 / over, amplified = 1 + 2 * x + 2 * std::sqrt(x + x * x);
      check_friction_bound<2>(law, over * cohesion, over * cohesion * amplified);
      check_friction_bound<3>(law, over * cohesion, over * cohesion * amplified);
    }
  }
}

/// C10. Opposite spins: the surfaces roll on each other (and, in 3D, pivot) without slip.
template <int D>
void check_rolling_bound(const Law& law, double elastic) {
  SCOPED_TRACE(law.name() + ", D = " + std::to_string(D));
  const Vec<D> n = generic_direction<D>();
  const double h = law.deflection(elastic), kn = law.tangent(h);
  // Both springs yield at the same time: theta = mu_R F_el / (K_N mu_R^2).
  const double time = 200, rolling = elastic / (kn * rolling_friction) / time;
  const double pivoting = elastic / (kn * pivoting_friction) / time;
  Spin<D> relative = rolling * slip_axis<D>();
  if constexpr (D == 3) relative += pivoting * n;
  Sample<D> sample = heavy_pair<D>(law, elastic);
  sample.spin[0] = -0.5 * relative, sample.spin[1] = 0.5 * relative;
  Scene scene = sticky_scene(law, D);
  set_dt(scene, 1);
  const auto engine = make_engine<D>(EngineKind::md, scene, sample);
  for (long steps : {100, 200}) {
    engine->advance(steps);
    const Snapshot<D> state = engine->snapshot();
    const Spin<D> torque = state.contacts->torque.at(0);
    // Opposed to the relative rotation. Half of the bound after half of the yield time (give or take a step), then
    // at the bound to rounding.
    const double share = steps == 100 ? 0.5 : 1.0, tolerance = steps == 100 ? 1.01 / 200 : 1e-11;
    if constexpr (D == 2) {
      EXPECT_NEAR(-torque / (slip_axis<2>() * rolling_friction * elastic), share, tolerance);
    } else {
      EXPECT_NEAR(-torque.dot(slip_axis<3>()) / (rolling_friction * elastic), share, tolerance);
      EXPECT_NEAR(-torque.dot(n) / (pivoting_friction * elastic), share, tolerance);
      EXPECT_LT(torque.cross(n).cross(n).cross(slip_axis<3>()).norm(), 1e-12 * elastic);
    }
    EXPECT_LT(force_of<D>(state).tangential, 1e-12 * cohesion);
  }
}

TEST(ContactBounds, RollingCapacityOfAnUnloadedContact) {
  for (const Law& law : all_laws()) {
    const double elastic = law.attraction == CohesionLaw::constant ? cohesion : 4 * cohesion;
    check_rolling_bound<2>(law, elastic);
    check_rolling_bound<3>(law, elastic);
  }
}

TEST(ContactBounds, RollingCapacityUnderLoad) {
  for (const Law& law : all_laws()) {
    check_rolling_bound<2>(law, 3 * cohesion);
    check_rolling_bound<3>(law, 3 * cohesion);
  }
}

// ---- dashpots: forces on light grains at a given instant ----

/// Pairs of unequal grains, with u_N and u_T given, seen after 3 steps so short that no spring loads.
struct Dashpot {
  Law law;
  double opening_speed, slip_speed;
  double friction = 0.4;
  double zeta = 0.3, zeta_t = 0.2;
};

template <int D>
Probe<D> dashpot_probe(const Dashpot& given, double h) {
  const Vec<D> n = generic_direction<D>();
  Sample<D> sample = pair_apart<D>(n, -h, {0.3, 0.6}, {0.25, 2.0});
  set_relative_velocity<D>(sample, given.opening_speed * n);
  // l_0 w of slip: u_T = -l_0 w along the tangent that the axis belongs to.
  sample.spin[0] = given.slip_speed / (0.3 * (1 - h / 0.9)) * slip_axis<D>();
  Scene scene = sticky_scene(given.law, D);
  scene.material.rolling_friction = 0;
  scene.material.pivoting_friction = 0;
  scene.material.friction = given.friction;
  scene.material.restitution.reset();
  scene.material.damping_ratio = given.zeta;
  scene.material.tangential_damping_ratio = given.zeta_t;
  return probe<D>(scene, sample, 1e-12);
}

struct Constants {
  double elastic, alpha, alpha_t;
};

template <int D>
Constants constants(const Dashpot& given, double h) {
  const bool hertz = given.law.normal == NormalLaw::hertz;
  const double k = hertz ? hertz_coefficient(contact_modulus(matter, matter), reduced(0.3, 0.6)) : stiffness;
  const double kn = hertz ? 1.5 * k * std::sqrt(h) : k, kt = given.law.tangential_ratio() * kn;
  const double mass = reduced(0.25, 2.0), mass_t = mass / (1 + 1 / inertia_ratio<D>);
  return {hertz ? k * h * std::sqrt(h) : k * h, given.zeta * 2 * std::sqrt(mass * kn),
          given.zeta_t * 2 * std::sqrt(mass_t * kt)};
}

template <int D>
void check_dashpots(const Law& law) {
  const double h = 0.02;
  for (double opening : {-0.2, 0.005, 0.3})
    for (double mu : {0.05, 50.0}) {
      SCOPED_TRACE(law.name() + ", D = " + std::to_string(D) + ", u_N = " + std::to_string(opening) +
                   ", mu = " + std::to_string(mu));
      const Dashpot given{law, opening, 0.1, mu};
      const Constants c = constants<D>(given, h);
      const Probe<D> seen = dashpot_probe<D>(given, h);
      const double attraction =
          law.attraction == CohesionLaw::constant ? cohesion : std::sqrt(4 * stiffness * cohesion * h);
      const bool total = law.convention == DampingConvention::total;
      const double damped = c.elastic - c.alpha * opening;
      const double repulsive = total ? std::max(0.0, damped) : c.elastic;
      // 1e-10: velocities at half steps differ by 1e-12 * F / m, positions are rounded by 1e-14 in h = 0.02.
      EXPECT_NEAR(seen.normal_force, (total ? repulsive : damped) - attraction, 1e-10);
      // `elastic`: the unloaded spring sticks, and its dashpot is not bounded. `total`: bounded with the spring.
      const double viscous = c.alpha_t * 0.1;
      EXPECT_NEAR(seen.tangential_force.norm(), total ? std::min(viscous, mu * repulsive) : viscous, 1e-10);
    }
}

TEST(ContactBounds, DashpotsAndTheirConventions) {
  for (const Law& law : all_laws()) {
    check_dashpots<2>(law);
    check_dashpots<3>(law);
  }
}

TEST(ContactBounds, SlidingHasNoDashpotInTheElasticConvention) {
  // Heavy grains that slip steadily, with a tangential dashpot worth many times the bound: F_T stays mu K h.
  for (NormalLaw normal : both_laws)
    for (DampingConvention convention : both_conventions) {
      const Law law{normal, CohesionLaw::constant, convention};
      SCOPED_TRACE(law.name());
      const double elastic = 2 * cohesion, h = law.deflection(elastic);
      Sample<3> sample = heavy_pair<3>(law, elastic);
      for (Vec<3>& spin : sample.spin) spin = 1e-3 / (1 - h) * slip_axis<3>();
      Scene scene = sticky_scene(law, 3);
      scene.material.tangential_damping_ratio = 0.2;  // alpha_T = 0.4 sqrt(K_T m_T), about 1e9
      set_dt(scene, 1);
      const auto engine = make_engine<3>(EngineKind::md, scene, sample);
      // Yields after t = mu F_el / (K_T 1e-3) = 16 at most (`elastic`), at once (`total`).
      engine->advance(convention == DampingConvention::elastic ? 40 : 4);
      EXPECT_NEAR(force_of<3>(engine->snapshot()).tangential / (friction * elastic), 1, 1e-11);
    }
}

/// Steady slip and rolling at once while the contact closes or opens so slowly that nothing moves, yet with a damping
/// force that counts: alpha u_N = share F_el, alpha = zeta 2 sqrt(m* K_N) = 1e9.
void check_damped_bounds(const Law& law, double share) {
  SCOPED_TRACE(law.name() + ", alpha u_N / F_el = " + std::to_string(share));
  const double elastic = 2 * cohesion, h = law.deflection(elastic), zeta = 0.1;
  const double alpha = zeta * 2 * std::sqrt(heavy / 2 * law.tangent(h)), opening = share * elastic / alpha;
  Sample<3> sample = heavy_pair<3>(law, elastic);
  set_relative_velocity<3>(sample, opening * generic_direction<3>());
  // Grain 0 alone spins: both slip, and rolling and pivoting against each other.
  sample.spin[0] = 1e-3 * slip_axis<3>() + 1e-3 * generic_direction<3>();
  Scene scene = sticky_scene(law, 3);
  scene.material.restitution.reset();
  scene.material.damping_ratio = zeta;
  // Springs yield by t = bound / (stiffness * 1e-3): 2 F_el / (K_N mu_R 1e-3) = 2000 at most.
  set_dt(scene, 10);
  const auto engine = make_engine<3>(EngineKind::md, scene, sample);
  engine->advance(300);
  const Snapshot<3> state = engine->snapshot();
  const bool total = law.convention == DampingConvention::total;
  const double repulsive = total ? std::max(0.0, 1 - share) : 1;  // over F_el
  const double normal = (total ? repulsive : 1 - share) * elastic - cohesion;
  // u_N = 1e-11 (and forces of 0.02 over masses of 1e20, less) move the grains by 3e-8 in 3000, over h = 0.02.
  const double tolerance = 1e-5;
  const Force now = force_of<3>(state);
  const Vec<3> torque = state.contacts->torque.at(0), n = state.contacts->normal.at(0);
  EXPECT_NEAR(now.normal / elastic, normal / elastic, tolerance);
  EXPECT_NEAR(now.tangential / (friction * elastic), repulsive, tolerance);
  EXPECT_NEAR((torque - torque.dot(n) * n).norm() / (rolling_friction * elastic), repulsive, tolerance);
  EXPECT_NEAR(torque.dot(n) / (pivoting_friction * elastic), repulsive, tolerance);
}

TEST(ContactBounds, DampingEntersTheBoundsInTheTotalConventionOnly) {
  for (NormalLaw normal : both_laws)
    for (DampingConvention convention : both_conventions)
      for (double share : {-0.6, 0.5, 1.7}) check_damped_bounds({normal, CohesionLaw::constant, convention}, share);
}

}  // namespace
}  // namespace galet::test::contact_bounds_test
