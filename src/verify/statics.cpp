// Grains at rest under their weight: columns, unlike masses, a groove, a wedge.
#include <algorithm>

#include <fmt/format.h>

#include "src/verify/trial.hpp"

namespace galet::verify {

namespace {

/// zeta of the linear law with the convention `elastic`.
double damping_of(double e) { return -std::log(e) / std::hypot(pi, std::log(e)); }

Scene column_scene(int count, double stiffness) {
  Scene scene = free_scene(2, 0.5, 0.1, stiffness);
  add_floor(scene);
  for (int k = 0; k < count; ++k) add_grain(scene, {0, 0.5 + k});
  scene.cd.dt = 1e-2;
  scene.cd.max_sweeps = 100000000;
  return scene;
}

/// Contact c from the bottom carries weight[c]: largest error over the weight on the floor, and the floor's force.
struct ColumnForces {
  double floor = 0, error = 0;
};

ColumnForces column_forces(const Snapshot<2>& state, const std::vector<double>& weight) {
  ColumnForces found;
  const int count = state.grains();
  std::vector<double> force(count, 0.0);
  for (std::size_t c = 0; c < state.contacts->size(); ++c) {
    const int i = state.contacts->i[c], j = state.contacts->j[c];
    force[j >= count ? 0 : std::max(i, j)] = std::abs(state.contacts->force[c].y());
  }
  for (int k = 0; k < count; ++k) found.error = std::max(found.error, std::abs(force[k] - weight[k]) / weight[0]);
  found.floor = force[0];
  return found;
}

/// Least eigenvalue of a chain of n grains on a floor, in units of 1 / m.
double least_eigenvalue(int n) { return std::pow(2 * std::sin(pi / (4 * n + 2)), 2); }

std::vector<double> weights(int n) {
  std::vector<double> weight(n);
  for (int k = 0; k < n; ++k) weight[k] = n - k;
  return weight;
}

/// Deflected as it must be in equilibrium: contact c by weight[c] / K.
void compress(const std::vector<double>& weight, double stiffness, Sample<2>& sample) {
  double sunk = 0;
  for (std::size_t k = 0; k < weight.size(); ++k) sample.position[k].y() -= (sunk += weight[k] / stiffness);
}

constexpr double column_bound = 1e-3;

void rigid_column(int n, Report& report) {
  Scene scene = column_scene(n, 1e5);
  // The residual is relative to |r| = sqrt(sum of k^2) m g dt, in blocks of mean diagonal 2 / m (disks).
  const double norm = std::sqrt(n * (n + 1.0) * (2 * n + 1.0) / 6);
  scene.cd.tolerance = column_bound * n / (2 / least_eigenvalue(n) * norm);
  Trial<2> trial(report, EngineKind::cd, scene);
  trial.advance(3);
  const ColumnForces found = column_forces(trial.state(), weights(n));
  const std::string reason =
      fmt::format("tolerance {:.1e} of the solver, amplified by 2/lambda_min", scene.cd.tolerance);
  report.relative("force on the floor", found.floor, n, column_bound, reason);
  report.small("largest error of a force / weight", found.error, column_bound, reason);
  report.small("solver: steps above the tolerance", static_cast<double>(trial.engine().solver_summary().missed), 0,
               "every step is solved");
}

/// From grains that just touch: the slowest mode, omega, is damped at the rate zeta sqrt(2) omega^2 / (2 omega_1).
void soft_column(int n, Report& report) {
  const double stiffness = 1e5, unit = std::sqrt(stiffness), omega2 = least_eigenvalue(n) * stiffness;
  const double rate = damping_of(0.1) * std::sqrt(2.0) * omega2 / (2 * unit);
  Trial<2> trial(report, EngineKind::md, column_scene(n, stiffness));
  trial.run_to(14 / rate);
  const ColumnForces found = column_forces(trial.state(), weights(n));
  const std::string reason = "the slowest mode is down to exp(-14)";
  report.relative("force on the floor", found.floor, n, 1e-5, reason);
  report.small("largest error of a force / weight", found.error, 1e-5, reason);
}

/// From its equilibrium (a chain of n grains needs some 260 n^2 steps to come to rest by its dashpots).
void soft_column_at_rest(int n, Report& report) {
  const double stiffness = 1e7;
  const Scene scene = column_scene(n, stiffness);
  Sample<2> start = initial_sample<2>(scene);
  compress(weights(n), stiffness, start);
  Trial<2> trial(report, EngineKind::md, scene, start);
  trial.advance(100000);
  const ColumnForces found = column_forces(trial.state(), weights(n));
  const std::string reason = "K times the rounding of heights (1e-13), with a factor of n^(1/2)";
  const double bound = 30 * stiffness * 1e-13 / n;
  report.relative("force on the floor", found.floor, n, bound, reason);
  report.small("largest error of a force / weight", found.error, bound, reason);
}

void column(EngineKind kind, int n, Report& report) {
  if (kind == EngineKind::cd) return rigid_column(n, report);
  if (n < 1000) return soft_column(n, report);
  soft_column_at_rest(n, report);
}

// ---- an unconverged solver -------------------------------------------------------------------------------------

/// Sum of the changes that `sweeps` sweeps with momentum make where each alone would make 1: the weights of Nesterov's
/// scheme with its cap.
double momentum_gain(int sweeps) {
  double change = 0, sum = 0, t = 1, beta = 0;
  for (int k = 0; k < sweeps; ++k) {
    sum += change = 1 + beta * change;
    const double next = 0.5 * (1 + std::sqrt(1 + 4 * t * t));
    beta = std::min((t - 1) / next, 0.9);
    t = next;
  }
  return sum;
}

/// A sweep of Gauss-Seidel in two colours changes a smooth field of impulses by -m u (twice Jacobi's m/2): with S such
/// changes in a step, dF/dt = -S m u / dt^2, a spring of stiffness S m / dt^2. The stiffness is that of the period of
/// the column's first mode, 2 sqrt(k/m) sin(pi / (4n + 2)), after its weight has grown by 1 %. Contacts overlap from
/// the start, so that none opens.
double stiffness_of_few_sweeps(int sweeps, Report& report) {
  constexpr int n = 100;
  constexpr double dt = 1e-2;
  Scene scene = column_scene(n, 1e5);
  scene.material.restitution = 0, scene.material.friction = 0;
  scene.cd.dt = dt, scene.cd.tolerance = 1e-12;
  scene.cd.penetration = 0.5;  // nothing is corrected
  Sample<2> start = initial_sample<2>(scene);
  compress(std::vector<double>(n, 1.0), 1e3, start);
  Trial<2> solved(report, EngineKind::cd, scene, start);
  solved.advance(5);
  Archive archive;
  solved.engine().save(archive);
  scene.cd.tolerance = 1e-14, scene.cd.max_sweeps = sweeps;
  Trial<2> trial(report, EngineKind::cd, scene, start);
  trial.engine().restore(archive);
  scene.loading.gravity = {0, -1.01};
  trial.change(scene);
  // The top's velocity changes sign at half the period: where, by the straight line between two steps. Its first step
  // begins at rest.
  double before = 0, half = 0;
  for (int step = 1; step < 1000 && half == 0; ++step) {
    trial.advance(1);
    const double now = trial.velocity(n - 1).y();
    if (step > 2 && now > 0) half = step - now / (now - before);
    before = now;
  }
  return std::pow(pi / half / (2 * std::sin(pi / (4 * n + 2))), 2);
}

void few_sweeps(EngineKind, Report& report) {
  for (const int sweeps : {1, 2, 5, 10, 20})
    report.relative(fmt::format("stiffness dt^2 / m of {} sweeps", sweeps), stiffness_of_few_sweeps(sweeps, report),
                    momentum_gain(sweeps), 0.02,
                    "leading order in 1 / n (the contact with the floor has another block), and in sweeps / n");
}

// ---- unlike masses -----------------------------------------------------------------------------------------------

void heavy_on_light(EngineKind kind, double ratio, Report& report) {
  const double stiffness = 1e4 * ratio, density = 4 / pi;
  Scene scene = free_scene(2, 0.3, 0.1, stiffness);
  scene.grains.density = density;
  OtherMaterial heavy;
  heavy.name = "heavy", heavy.density = density * ratio;
  scene.other_materials = {heavy};
  add_floor(scene);
  for (int k = 0; k < 3; ++k) add_grain(scene, {0, 0.5 + k}, {}, 1, k == 2 ? "heavy" : "");
  const std::vector<double> weight{ratio + 2, ratio + 1, ratio};
  scene.cd.dt = 1e-2;
  scene.cd.tolerance = 1e-5 / ratio;
  scene.cd.max_sweeps = 100000000;
  Sample<2> start = initial_sample<2>(scene);
  const bool rests = ratio > 1e4;  // where the dashpots would need 1e9 steps
  if (kind == EngineKind::md && rests) compress(weight, stiffness, start);
  Trial<2> trial(report, kind, scene, start);
  std::string reason = fmt::format("tolerance {:.0e} times the condition, some 6 M/m", scene.cd.tolerance);
  double bound = 1e-4;
  if (kind == EngineKind::cd) {
    trial.advance(10);
  } else if (rests) {
    trial.advance(1000000);
    bound = 1e-10, reason = "K times the rounding of heights over the weight";
  } else {
    // The heavy grain on three springs and dashpots in a row; the dashpot between light grains is the weakest.
    const double dashpot = 2 * damping_of(0.1) * std::sqrt(0.5 * stiffness);
    trial.run_to(14 * 6 * ratio / dashpot);
    bound = 1e-5, reason = "the heavy grain's mode is down to exp(-14)";
  }
  const ColumnForces found = column_forces(trial.state(), weight);
  report.relative("force on the floor", found.floor, weight[0], bound, reason);
  report.small("largest error of a force / weight", found.error, bound, reason);
}

// ---- groove and wedge --------------------------------------------------------------------------------------------

/// A disk between two planes at the angle `half` from the vertical, which meet below it.
Scene groove_scene(double half, double friction, double stiffness) {
  Scene scene = free_scene(2, friction, 0.1, stiffness);
  const double c = std::cos(half), s = std::sin(half);
  add_plane(scene, {0, 0}, {c, s});
  add_plane(scene, {0, 0}, {-c, s});
  scene.loading.gravity = {0, -1};
  add_grain(scene, {0, 0.5 / s});
  return scene;
}

/// Resultant of both contacts, the normal forces, and the largest |F_T| / F_N.
struct Held {
  Vec<2> force = Vec<2>::Zero();
  double normal = 0, asymmetry = 0, mobilised = 0;
};

Held held(const Snapshot<2>& state) {
  Held found;
  double sign = 1;
  for (std::size_t c = 0; c < state.contacts->size(); ++c) {
    const Vec<2>&n = state.contacts->normal[c], &f = state.contacts->force[c];
    found.force -= f;  // on the disk, which is i
    const double normal = f.dot(n);
    found.normal += normal / 2, found.asymmetry += sign * normal, sign = -1;
    found.mobilised = std::max(found.mobilised, std::abs(cross(n, f)) / normal);
  }
  return found;
}

void groove(EngineKind kind, Report& report) {
  constexpr double half = pi / 4, friction = 0.3;
  Scene scene = groove_scene(half, friction, 1e5);
  scene.cd.dt = 1e-2, scene.cd.tolerance = 1e-10, scene.cd.max_sweeps = 100000;
  Trial<2> trial(report, kind, scene);
  trial.run_to(5);
  const Held found = held(trial.state());
  const double least = 0.5 / (std::sin(half) + friction * std::cos(half));
  const double most = 0.5 / (std::sin(half) - friction * std::cos(half));
  const std::string reason = kind == EngineKind::cd ? "tolerance 1e-10 of the solver" : "rounding, K times 1e-14";
  report.near("normal force, nearest of the interval", found.normal, std::clamp(found.normal, least, most), 1e-8,
              reason);
  report.near("resultant on the disk", found.force.y(), 1, 1e-8, reason);
  report.small("sideways resultant", found.force.x(), 1e-8, reason);
  report.near("friction used, nearest of [0, mu]", found.mobilised, std::min(found.mobilised, friction), 1e-8, reason);
  report.small("velocity", trial.fastest(), 1e-8, reason);
}

/// A disk pressed into a wedge of half angle a < atan(mu): pressed slowly by its weight W its contacts slide, N = W /
/// (2 (sin a + mu cos a)); when the weight is taken away it stays, and N keeps the share 1 - sin a (mu + tan a) /
/// ((K_T/K_N) cos a + sin a tan a): stick, with springs along and across the walls.
void wedge(EngineKind kind, Report& report) {
  constexpr double half = 5 * pi / 180, friction = 0.3, stiffness = 1e5, ratio = 0.5;
  Scene scene = groove_scene(half, friction, stiffness);
  scene.material.convention = DampingConvention::total;
  // md rings along the walls unless a dashpot acts there; the implicit steps of cd do not.
  if (kind == EngineKind::md) scene.material.tangential_damping_ratio = 0.3;
  scene.cd.compliance = kind == EngineKind::cd;
  scene.cd.dt = 0.05, scene.cd.tolerance = 1e-11, scene.cd.max_sweeps = 100000;
  const double c = std::cos(half), s = std::sin(half), t = std::tan(half);
  constexpr int parts = 400;
  const auto weigh = [&](Trial<2>& trial, double weight) {
    Scene now = scene;
    now.loading.gravity = {0, -weight};
    trial.change(now);
    trial.run_to(trial.time() + 0.1);
  };
  scene.loading.gravity = {0, -1.0 / parts};
  Trial<2> trial(report, kind, scene);
  for (int k = 1; k <= parts; ++k) weigh(trial, static_cast<double>(k) / parts);
  const double pressed = held(trial.state()).normal;
  for (int k = parts - 1; k >= 0; --k) weigh(trial, static_cast<double>(k) / parts);
  trial.run_to(trial.time() + 2);
  const Held left = held(trial.state());
  const double exact = 0.5 / (s + friction * c), kept = 1 - s * (friction + t) / (ratio * c + s * t);
  const std::string reason = "loaded in 400 parts; each one's shock is 1/400 of the load at most";
  report.relative("normal force under the weight", pressed, exact, 2.5e-3, reason);
  report.relative("share that stays without weight", left.normal / pressed, kept, 2.5e-3, reason);
  report.small("resultant that is left", left.force.norm(), 1e-6, "at rest");
}

}  // namespace

std::vector<Case> statics_cases() {
  const auto column_case = [](int n, Effort effort, const std::string& more) {
    return Case{.name = fmt::format("column_{}", n),
                .tags = {"statics", "column"},
                .effort = effort,
                .scene = fmt::format("{} disks one above the other under gravity{}", n, more),
                .exact = "force = weight above",
                .trouble = "forces short of the weight (the solver gave up), ringing that grows, a column that buckles",
                .run = [n](EngineKind kind, Report& report) { column(kind, n, report); }};
  };
  const auto mass_case = [](const std::string& name, double ratio) {
    return Case{.name = name,
                .tags = {"statics", "masses"},
                .effort = Effort::quick,
                .scene = fmt::format("a disk {:.0e} times as heavy as the two below it", ratio),
                .exact = "force = weight above",
                .trouble = "the light grains are squeezed out of the solution: forces far below the weight",
                .run = [ratio](EngineKind kind, Report& report) { heavy_on_light(kind, ratio, report); }};
  };
  return {
      column_case(10, Effort::brief, ""),
      column_case(100, Effort::full, ""),
      column_case(1000, Effort::full, "; md starts from its equilibrium"),
      {.name = "few_sweeps",
       .tags = {"statics", "column", "solver"},
       .effort = Effort::quick,
       .scene = "a column of 100 disks whose contact problems get 1 to 20 sweeps per step",
       .exact =
           "stiffness S m / dt^2, S sweeps weighted by momentum (after Unger et al. 2002, whose law has no momentum)",
       .trouble = "grains that sink without end, or a stiffness of another law",
       .run = few_sweeps,
       .md = {Stance::absent, "md solves no contact problem"}},
      mass_case("mass_ratio_1e3", 1e3),
      mass_case("mass_ratio_1e6", 1e6),
      {.name = "groove",
       .tags = {"statics", "hyperstatic"},
       .scene = "a disk in a groove of 90 degrees, mu = 0.3",
       .exact = "N within W / (2 (sin a +- mu cos a))",
       .trouble = "forces outside the interval, or that wander from step to step",
       .run = groove},
      {.name = "wedge",
       .tags = {"statics", "hyperstatic"},
       .effort = Effort::quick,
       .scene = "a disk pressed into a wedge of 10 degrees and left there, mu = 0.3 (cd with compliance)",
       .exact = "statics with sticking springs (closed form in src/verify/statics.cpp)",
       .trouble = "the disk is spat out, or keeps no force",
       .run = wedge},
  };
}

}  // namespace galet::verify
