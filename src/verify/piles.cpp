// Three equal cylinders, two on the floor and one on them, at the frictions where they begin to slide.
#include <array>

#include <Eigen/LU>
#include <fmt/format.h>

#include "src/verify/trial.hpp"

namespace galet::verify {

namespace {

/// tan 15 degrees: friction that the upper contacts need; the floor needs a third of it.
const double least_between = 2 - std::sqrt(3.0), least_floor = least_between / 3;

enum class Slips { between, floor };

/// phi'' of the pile while the lower cylinders move apart: phi is the angle of the lines of centres from the vertical,
/// x = d sin phi, y = d cos phi. Unknown: phi'', N and F of an upper contact (F along the slip of the upper cylinder),
/// f and P of the floor. Either the floor holds (the lower cylinders roll on it) and the upper contacts slide, or the
/// upper ones roll and the floor slides. d = m = g = 1.
double angular_acceleration(Slips slips, double friction, double phi, double rate) {
  const double s = std::sin(phi), c = std::cos(phi), w2 = rate * rate, inertia = 0.125, radius = 0.5;
  Eigen::Matrix<double, 5, 5> a = Eigen::Matrix<double, 5, 5>::Zero();
  Eigen::Matrix<double, 5, 1> b = Eigen::Matrix<double, 5, 1>::Zero();
  a.row(0) << c, -s, c, -1, 0;  // lower cylinder, along x
  b[0] = s * w2;
  a.row(1) << s, 2 * c, 2 * s, 0, 0;  // upper cylinder, down
  b[1] = 1 - c * w2;
  a.row(2) << 0, -c, -s, 0, 1;  // lower cylinder, up
  b[2] = 1;
  // Its rotation: I alpha = R (F + f).
  if (slips == Slips::between) {
    a.row(3) << -inertia / radius * c, 0, -radius, -radius, 0;
    b[3] = -inertia / radius * s * w2;
    a.row(4) << 0, -friction, 1, 0, 0;
  } else {
    a.row(3) << inertia / radius, 0, -radius, -radius, 0;
    a.row(4) << 0, 0, 0, 1, friction;
  }
  return (a.fullPivLu().solve(b))[0];
}

/// How far the upper cylinder has sunk after `time`: fourth-order Runge-Kutta.
double sunk_after(Slips slips, double friction, double time) {
  constexpr int steps = 20000;
  const double h = time / steps;
  double phi = pi / 6, rate = 0;
  const auto turn = [&](double at, double w) { return angular_acceleration(slips, friction, at, w); };
  for (int k = 0; k < steps; ++k) {
    const double a1 = turn(phi, rate);
    const double a2 = turn(phi + h / 2 * rate, rate + h / 2 * a1);
    const double a3 = turn(phi + h / 2 * rate + h * h / 4 * a1, rate + h / 2 * a2);
    const double a4 = turn(phi + h * rate + h * h / 2 * a2, rate + h * a3);
    phi += h * rate + h * h / 6 * (a1 + a2 + a3);
    rate += h / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
  }
  return std::cos(pi / 6) - std::cos(phi);
}

constexpr double duration = 2;

/// Depth by which the upper cylinder has sunk, and the largest speed, at the end.
std::array<double, 2> settle(EngineKind kind, double between, double floor, Report& report) {
  Scene scene = free_scene(2, between, kind == EngineKind::md ? 0.1 : 0, 1e9);
  OtherMaterial ground;
  ground.name = "ground";
  scene.other_materials = {ground};
  MaterialPair pair;
  pair.between = {"default", "ground"}, pair.friction = floor;
  scene.pairs = {pair};
  scene.material.tangential_damping_ratio = 0.5;
  add_floor(scene, 1, "ground");
  add_grain(scene, {-0.5, 0.5});
  add_grain(scene, {0.5, 0.5});
  add_grain(scene, {0, 0.5 + std::sqrt(0.75)});
  scene.cd.dt = 1e-3, scene.cd.tolerance = 1e-10, scene.cd.max_sweeps = 100000;
  Trial<2> trial(report, kind, scene);
  trial.run_to(duration);
  return {trial.start().position[2].y() - trial.position(2).y(), trial.fastest()};
}

void three_cylinders(EngineKind kind, Slips slips, Report& report) {
  const bool between = slips == Slips::between;
  const double limit = between ? least_between : least_floor;
  const auto at = [&](double share) {
    return between ? settle(kind, share * limit, 0.5, report) : settle(kind, 0.6, share * limit, report);
  };
  const std::array<double, 2> stands = at(1.01), falls = at(0.99);
  const bool rigid = kind == EngineKind::cd;
  report.small("speed at 1.01 of the limit", stands[1], rigid ? 1e-10 : 1e-7,
               rigid ? "tolerance 1e-10 of the solver" : "rounding times the contacts' frequency");
  report.relative("fall at 0.99 of the limit", falls[0], sunk_after(slips, 0.99 * limit, duration), rigid ? 0.01 : 0.05,
                  rigid ? "first order in dt, 1e-3" : "the shock of the start, g sqrt(m/K), grows with the fall");
}

}  // namespace

std::vector<Case> pile_cases() {
  const std::string exact =
      "limits by statics: tan 15 deg between cylinders, a third of it on the floor; the fall: the pile's one degree of "
      "freedom by Runge-Kutta";
  const std::string trouble = "creep below the limit, standing beyond it";
  return {
      {.name = "three_cylinders",
       .tags = {"statics", "pile", "threshold"},
       .effort = Effort::quick,
       .scene = "three cylinders, mu between them 1 % above and below tan 15 deg",
       .exact = exact,
       .trouble = trouble,
       .run = [](EngineKind kind, Report& report) { three_cylinders(kind, Slips::between, report); }},
      {.name = "three_cylinders_floor",
       .tags = {"statics", "pile", "threshold"},
       .effort = Effort::quick,
       .scene = "the same, mu on the floor 1 % above and below tan 15 deg / 3",
       .exact = exact,
       .trouble = trouble,
       .run = [](EngineKind kind, Report& report) { three_cylinders(kind, Slips::floor, report); }},
  };
}

}  // namespace galet::verify
