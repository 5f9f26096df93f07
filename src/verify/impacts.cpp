// Impacts of one or a few grains.
#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "src/verify/trial.hpp"

namespace galet::verify {

namespace {

// ---- rows of balls -----------------------------------------------------------------------------------------------

/// Balls in a row along x, d = m = 1, the first one moving at speed 1.
Scene row_scene(int balls, double gap, double e, double stiffness) {
  Scene scene = free_scene(2, 0, e, stiffness);
  for (int k = 0; k < balls; ++k) add_grain(scene, {k * (1 + gap), 0}, {k == 0 ? 1.0 : 0.0, 0});
  return scene;
}

/// Velocities after the impact of `balls` balls on linear springs that just touch, by Runge-Kutta (m = K = 1).
std::vector<double> spring_chain(int balls) {
  using State = std::vector<double>;  // positions, then velocities
  const int n = balls;
  const auto derivative = [n](const State& at) {
    State change(2 * n, 0.0);
    for (int k = 0; k < n; ++k) change[k] = at[n + k];
    for (int k = 0; k + 1 < n; ++k) {
      const double force = std::max(0.0, at[k] - at[k + 1]);
      change[n + k] -= force, change[n + k + 1] += force;
    }
    return change;
  };
  const auto plus = [](const State& a, double factor, const State& b) {
    State sum = a;
    for (std::size_t k = 0; k < a.size(); ++k) sum[k] += factor * b[k];
    return sum;
  };
  State state(2 * n, 0.0);
  state[n] = 1;
  const double h = 1e-3;
  for (int step = 0; step < 40000; ++step) {  // the balls have parted before t = 40
    const State a = derivative(state), b = derivative(plus(state, h / 2, a)), c = derivative(plus(state, h / 2, b)),
                d = derivative(plus(state, h, c));
    for (int k = 0; k < 2 * n; ++k) state[k] += h / 6 * (a[k] + 2 * b[k] + 2 * c[k] + d[k]);
  }
  return {state.begin() + n, state.end()};
}

void cradle(EngineKind kind, int balls, Report& report) {
  const bool rigid = kind == EngineKind::cd;
  constexpr double stiffness = 1e6;
  Scene scene = row_scene(balls, 0, 1, stiffness);
  scene.cd.dt = 1e-2, scene.cd.tolerance = 1e-13, scene.cd.max_sweeps = 100000;
  scene.md.dt = 1 / std::sqrt(stiffness) / 200;
  Trial<2> trial(report, kind, scene);
  if (rigid)
    trial.advance(1);
  else
    trial.run_to(40 / std::sqrt(stiffness));
  std::vector<double> exact(balls, 2.0 / balls);
  exact[0] -= 1;
  if (!rigid) exact = spring_chain(balls);
  double largest = 0;
  for (int k = 0; k < balls; ++k) largest = std::max(largest, std::abs(trial.velocity(k).x() - exact[k]));
  const double bound = rigid ? 1e-11 : 1e-4;
  const std::string reason = rigid ? "tolerance 1e-13 of the solver times the condition n^2"
                                   : "(w0 dt)^2 with a factor of 4: second order where contacts open";
  report.near("speed of the last ball", trial.velocity(balls - 1).x(), exact[balls - 1], bound, reason);
  report.small("largest error of a speed", largest, bound, reason);
  report.near("energy", 2 * kinetic_energy(trial), 1, bound, reason);
}

void cradle_with_gaps(EngineKind kind, Report& report) {
  Scene scene = row_scene(5, 0.05, 1, 1e6);
  scene.cd.dt = 1e-3, scene.cd.tolerance = 1e-13;
  scene.md.steps_per_contact = 200;
  Trial<2> trial(report, kind, scene);
  trial.run_to(1);
  const bool rigid = kind == EngineKind::cd;
  const double bound = rigid ? 1e-12 : 1e-5;
  const std::string reason = rigid ? "closed form in each impact" : "(w0 dt)^4 and the phases of 4 impacts";
  report.near("speed of the last ball", trial.velocity(4).x(), 1, bound, reason);
  double rest = 0;
  for (int k = 0; k < 4; ++k) rest = std::max(rest, std::abs(trial.velocity(k).x()));
  report.small("largest speed of the others", rest, rigid ? bound : 1e-3, rigid ? reason : "(w0 dt)^2 of an impact");
}

void inelastic_chain(EngineKind kind, Report& report) {
  constexpr int balls = 10;
  constexpr double e = 0.8;
  Scene scene = row_scene(balls, 0.05, e, 1e8);
  scene.cd.dt = 1e-3, scene.cd.tolerance = 1e-13;
  scene.md.steps_per_contact = 100;
  Trial<2> trial(report, kind, scene);
  trial.run_to(3);
  const bool rigid = kind == EngineKind::cd;
  report.relative("speed of the last ball", trial.velocity(balls - 1).x(), std::pow((1 + e) / 2, balls - 1),
                  rigid ? 1e-12 : 1e-3, rigid ? "closed form in each impact" : "(w0 dt)^2 = 1e-3 in e of 9 impacts");
  report.near("momentum", momentum<2>(trial.state()).x(), 1, 1e-12, "rounding");
}

/// All touching, e = 0: one step, and the row moves as one. Balls that keep colliding would be the inelastic collapse.
void dead_chain(EngineKind kind, Report& report) {
  constexpr int balls = 20;
  Scene scene = row_scene(balls, 0, 0, 1e6);
  scene.cd.dt = 1e-2, scene.cd.tolerance = 1e-12, scene.cd.max_sweeps = 100000;
  Trial<2> trial(report, kind, scene);
  trial.advance(100);
  double largest = 0;
  for (int k = 0; k < balls; ++k) largest = std::max(largest, std::abs(trial.velocity(k).x() - 1.0 / balls));
  const std::string reason = "tolerance 1e-12 of the solver times the condition n^2";
  report.near("common speed", trial.velocity(0).x(), 1.0 / balls, 4e-10, reason);
  report.small("largest error of a speed", largest, 4e-10, reason);
}

// ---- one ball on a floor -----------------------------------------------------------------------------------------

void bouncing_ball(EngineKind kind, Report& report) {
  const double e = 0.5, g = 9.81, low = 2e-3, first = std::sqrt(2 / g), dt = 1e-4;
  Scene scene = free_scene(2, 0, e, 1e8);
  add_floor(scene, g);
  add_grain(scene, {0, 1.5});
  scene.cd.dt = dt;
  scene.md.steps_per_contact = 200;
  Trial<2> trial(report, kind, scene);
  // Tops have heights e^(2k): the last one above `low`, and when the ball falls through `low` after it.
  int last = 0;
  double exact = first;
  while (std::pow(e, 2 * (last + 1)) > low) exact += 2 * std::pow(e, ++last) * first;
  exact -= first * std::pow(e, last);
  exact += std::sqrt(2 * (std::pow(e, 2 * last) - low) / g);
  const double stop = first * (1 + e) / (1 - e);
  const long steps = std::lround(1.05 * stop / trial.dt()), block = std::max(1L, std::lround(2e-5 / trial.dt()));
  double found = 0;
  for (long k = 0; k < steps; k += block) {
    trial.advance(block);
    if (trial.position(0).y() - 0.5 > low) found = trial.time();
  }
  const bool rigid = kind == EngineKind::cd;
  report.relative("time of the last fall through 2e-3", found, exact, 3e-3,
                  rigid ? "first order in dt: each flight errs by some dt (v/g of the step before), 1e-4 of 0.5"
                        : "contacts last 3e-4 each, and look every 2e-5");
  report.small("speed when all has died out", trial.fastest(), rigid ? 2 * g * dt : 1e-3,
               rigid ? "weight of one step" : "e^(2k) of the ringing contact");
  report.near("rests on the floor at", trial.position(0).y(), 0.5, 1e-4, rigid ? "penetration allowed" : "m g / K");
}

/// A thousand elastic bounces: the height of the top must not wander off.
void restitution_1(EngineKind kind, Report& report) {
  Scene scene = free_scene(2, 0, 1, 1e5);
  add_floor(scene);
  add_grain(scene, {0, 0.6});
  scene.cd.dt = 1e-3;
  Trial<2> trial(report, kind, scene);
  const double start = trial.engine().energy().total() - 0.5, period = 2 * std::sqrt(0.2);
  double worst = 0;
  for (int k = 0; k < 1000; ++k) {
    trial.run_to((k + 1) * period);
    worst = std::max(worst, std::abs(trial.engine().energy().total() - 0.5 - start) / start);
  }
  const double speed = std::sqrt(0.2);
  const bool rigid = kind == EngineKind::cd;
  report.small("largest relative error of the energy", worst, rigid ? 1e-3 * speed / 0.1 : 1e-3,
               rigid ? "m g v dt of one impact: nothing adds up" : "(w0 dt)^2 of a contact, either sign");
}

void restitution_0(EngineKind kind, Report& report) {
  Scene scene = free_scene(2, 0, 0, 1e6);
  add_floor(scene);
  add_grain(scene, {0, 0.6});
  scene.cd.dt = 1e-3;
  Trial<2> trial(report, kind, scene);
  trial.run_to(1);
  report.small("speed after the first impact", trial.fastest(), 1e-14, "closed form");
  report.near("height", trial.position(0).y(), 0.5, 1e-14, "stops within the step, on the floor");
}

// ---- oblique impacts ---------------------------------------------------------------------------------------------

/// A ball without spin meets a plane at (v_t, v_n = speed): Walton's law with e, e_T, mu. md with e = 1 and K_T/K_N = k
/// / (1 + k) swings along the plane as it does across: that is e_T = 1, sliding from end to end or sticking.
template <int D>
void oblique(EngineKind kind, Report& report) {
  constexpr double friction = 0.3, k = inertia_ratio<D>;
  const bool rigid = kind == EngineKind::cd;
  const double e = rigid ? 0.6 : 1, e_t = rigid ? 0.4 : 1, speed = 0.1;
  double across = 0, along = 0, turned = 0, slid = 0, exact_slid = 0;
  for (const double ratio : {0.1, 0.3, 0.6, 0.85, 1.3, 2.0, 3.0, 5.0, 10.0}) {
    Scene scene = free_scene(D, friction, e, 1e8);
    if (rigid) scene.material.tangential_restitution = e_t;
    scene.material.tangential_stiffness_ratio = k / (1 + k);
    std::vector<double> origin(D, 0.0), up(D, 0.0), centre(D, 0.0), velocity(D, 0.0);
    up.back() = 1, centre.back() = 0.5 + (rigid ? 0 : 1e-7);
    velocity.back() = -speed, velocity.front() = ratio * speed;
    add_plane(scene, origin, up);
    add_grain(scene, centre, velocity);
    scene.cd.dt = 1e-9;
    scene.md.steps_per_contact = 400;
    Trial<D> trial(report, kind, scene);
    if (rigid)
      trial.advance(1);
    else
      trial.run_to(1e-3);
    const double slip = ratio * speed, stick = (1 + e_t) * slip * k / (1 + k), slide = friction * (1 + e) * speed;
    const double impulse = std::min(stick, slide);  // m = 1
    const Vec<D> v = trial.velocity(0);
    // The rim moves against the friction: R w = impulse / (k m).
    double rim = 0;
    if constexpr (D == 2)
      rim = 0.5 * trial.state().spin[0];
    else
      rim = 0.5 * trial.state().spin[0].norm();
    across = std::max(across, std::abs(v[D - 1] / speed - e));
    along = std::max(along, std::abs(v[0] - slip + impulse) / speed);
    turned = std::max(turned, std::abs(std::abs(rim) - impulse / k) / speed);
    if (ratio == 5) slid = v[0] / speed, exact_slid = (slip - impulse) / speed;
  }
  const double bound = rigid ? 1e-11 : 1e-3;
  const std::string reason =
      rigid ? "one contact is solved in closed form" : "(w0 dt)^2 = 6e-5 and its phase, times v_t / v_n = 10";
  report.near("speed along, v_t/v_n = 5", slid, exact_slid, bound, reason);
  report.small("largest error of the speed across", across, bound, reason);
  report.small("largest error of the speed along", along, bound, reason);
  report.small("largest error of the rim's speed", turned, bound, reason);
}

/// Without friction a glancing impact leaves the speed along the plane alone.
void friction_0(EngineKind kind, Report& report) {
  Scene scene = free_scene(2, 0, 0.5, 1e6);
  add_plane(scene, {0, 0}, {0, 1});
  add_grain(scene, {0, 0.51}, {3, -1});
  scene.cd.dt = 1e-3;
  scene.md.steps_per_contact = 200;
  Trial<2> trial(report, kind, scene);
  trial.run_to(0.1);
  report.near("speed along", trial.velocity(0).x(), 3, 1e-14, "rounding");
  report.near("speed across", trial.velocity(0).y(), 0.5, kind == EngineKind::cd ? 1e-14 : 1e-4,
              kind == EngineKind::cd ? "closed form" : "(w0 dt)^2 = 2.5e-4, and its phase");
}

/// mu = 10: a sphere on a slope of tan 5 rolls without slip, a = g sin / (1 + k); spheres whose rims move alike part as
/// if there were no friction.
void friction_10(EngineKind kind, Report& report) {
  const double theta = std::atan(5.0);
  Scene scene = free_scene(3, 10, 0.3, 1e7);
  scene.material.tangential_damping_ratio = 0.3;
  add_floor(scene);
  scene.loading.gravity = {std::sin(theta), 0, -std::cos(theta)};
  add_grain(scene, {0, 0, 0.5});
  scene.cd.dt = 1e-3;
  Trial<3> trial(report, kind, scene);
  trial.run_to(1);
  const double before = trial.velocity(0).x(), start = trial.time();
  trial.run_to(6);
  const double found = (trial.velocity(0).x() - before) / (trial.time() - start);
  const bool rigid = kind == EngineKind::cd;
  report.relative("acceleration on a slope of tan 5", found, std::sin(theta) / 1.4, rigid ? 1e-12 : 1e-6,
                  rigid ? "impulses are exact" : "springs have come to rest at t = 1");
  report.relative("rim speed / speed", 0.5 * trial.state().spin[0].norm(), trial.velocity(0).x(), rigid ? 1e-12 : 1e-5,
                  rigid ? "no slip" : "elastic slip, F_T / K_T per time");
  Scene gears = free_scene(3, 10, 0.6, 1e6);
  add_grain(gears, {0, 0, 0}, {0.2, 0, 0});
  add_grain(gears, {1.01, 0, 0}, {-0.2, 0, 0});
  gears.grains.listed[0].spin = {0, 0, 3}, gears.grains.listed[1].spin = {0, 0, -3};
  gears.cd.dt = 1e-5;
  Trial<3> pair(report, kind, gears);
  pair.run_to(0.1);
  report.near("spin of gears that mesh (Chung and Ooi 2011, test 7)", pair.state().spin[0].z(), 3, rigid ? 1e-10 : 1e-3,
              rigid ? "nothing slips" : "the turn of the normal in a contact");
}

/// Two grains that meet while both move fast: the same impact as at rest, momentum and angular momentum kept.
void two_grains(EngineKind kind, Report& report) {
  const auto collide = [&](double drift) {
    Scene scene = free_scene(2, 0.3, 0.7, 1e6);
    add_grain(scene, {0, 0}, {drift + 0.5, 0.1});
    add_grain(scene, {0.9, 0.5}, {drift - 0.5, -0.1}, 0.8);
    scene.cd.dt = 1e-4, scene.cd.tolerance = 1e-13, scene.md.dt = 1e-5;
    Trial<2> trial(report, kind, scene);
    trial.run_to(0.5);
    const Snapshot<2> state = trial.state();
    double turning = 0;
    for (int i = 0; i < 2; ++i)
      turning += state.mass[i] * cross(state.position[i], state.velocity[i] - Vec<2>(drift, 0)) +
                 0.5 * state.mass[i] * state.radius[i] * state.radius[i] * state.spin[i];
    struct {
      Vec<2> velocity;
      double turning, spin;
    } result{state.velocity[0] - Vec<2>(drift, 0), turning, state.spin[0]};
    return result;
  };
  const auto rest = collide(0), moving = collide(1000);
  report.small("speeds differ between frames 1000 apart", (rest.velocity - moving.velocity).norm(), 1e-6,
               "rounding of velocities of 1000 and positions of 500, times the frequency of the contact");
  report.relative("spin in both frames", moving.spin, rest.spin, 1e-6, "the same");
  // Grain 2 has m = 0.64 and diameter 0.8 in units where the mean diameter, 0.9, has mass 1.
  const double m1 = 1 / 0.81, m2 = 0.64 / 0.81;
  const double before = m2 * (0.9 * -0.1 - 0.5 * -0.5) + m1 * 0;
  report.near("angular momentum", rest.turning, before, 1e-12, "kept to rounding by both schemes");
}

}  // namespace

std::vector<Case> impact_cases() {
  const auto cradle_case = [](int balls) {
    return Case{.name = fmt::format("cradle_{}", balls),
                .tags = {"impact", "cradle"},
                .scene = fmt::format("{} elastic balls in a row that touch, hit by the first", balls),
                .exact = "cd: Moreau's law, (2 - n)/n and 2/n (Moreau 1988); md: linear springs, by Runge-Kutta",
                .trouble = "energy gained, balls that stick",
                .run = [balls](EngineKind kind, Report& report) { cradle(kind, balls, report); }};
  };
  const std::string walton = "Walton's law: e, mu, e_T (Walton 1993)";
  return {
      cradle_case(3),
      cradle_case(5),
      {.name = "cradle_gaps",
       .tags = {"impact", "cradle"},
       .scene = "5 elastic balls in a row with gaps",
       .exact = "the last ball takes all, impact by impact",
       .trouble = "speeds spread over the row",
       .run = cradle_with_gaps},
      {.name = "inelastic_chain",
       .tags = {"impact"},
       .scene = "10 balls with gaps, e = 0.8",
       .exact = "speed of the last ball ((1 + e)/2)^9",
       .trouble = "a restitution that depends on the step",
       .run = inelastic_chain},
      {.name = "dead_chain",
       .tags = {"impact"},
       .scene = "20 balls in a row that touch, e = 0",
       .exact = "all move at 1/20",
       .trouble = "balls that part, or a solver that stops short",
       .run = dead_chain,
       .md = {Stance::refuses, "restitution > 0"}},
      {.name = "bouncing_ball",
       .tags = {"impact", "rest"},
       .effort = Effort::quick,
       .scene = "a ball dropped from 1 m, e = 0.5, until it rests after infinitely many bounces",
       .exact = "geometric series, sqrt(2h/g) (1 + e)/(1 - e)",
       .trouble = "a ball that never stops, or gains height",
       .run = bouncing_ball},
      {.name = "restitution_0",
       .tags = {"impact", "restitution"},
       .scene = "a ball dropped with e = 0",
       .exact = "stops",
       .trouble = "a rebound, a ball inside the floor",
       .run = restitution_0,
       .md = {Stance::refuses, "restitution > 0"}},
      {.name = "restitution_1",
       .tags = {"impact", "restitution"},
       .effort = Effort::quick,
       .scene = "a ball that bounces 1000 times with e = 1",
       .exact = "energy kept",
       .trouble = "an energy that grows or falls steadily",
       .run = restitution_1},
      {.name = "oblique_2d",
       .tags = {"impact", "friction"},
       .scene = "a disk meets a plane at 9 angles, mu = 0.3",
       .exact = walton,
       .trouble = "friction beyond its bound, wrong switch from sticking to sliding",
       .run = oblique<2>},
      {.name = "oblique_3d",
       .tags = {"impact", "friction"},
       .scene = "a sphere meets a plane at 9 angles, mu = 0.3",
       .exact = walton,
       .trouble = "the same",
       .run = oblique<3>},
      {.name = "friction_0",
       .tags = {"impact", "friction"},
       .scene = "a glancing impact, mu = 0",
       .exact = "the speed along the plane stays",
       .trouble = "a trace of friction",
       .run = friction_0},
      {.name = "friction_10",
       .tags = {"friction"},
       .effort = Effort::quick,
       .scene = "mu = 10: a sphere on a slope of tan 5, and two spheres like gears",
       .exact = "rolling, a = g sin / (1 + k)",
       .trouble = "slip, a solver that does not converge",
       .run = friction_10},
      {.name = "two_grains",
       .tags = {"impact", "invariance"},
       .scene = "two unlike disks collide, at rest and in a frame that moves at 1000",
       .exact = "Galilean invariance, angular momentum",
       .trouble = "an impact that depends on the frame",
       .run = two_grains},
  };
}

}  // namespace galet::verify
