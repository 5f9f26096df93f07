// A grain on a slope just below and just above what friction or rolling resistance holds, over a million steps.
#include <fmt/format.h>

#include "src/verify/trial.hpp"

namespace galet::verify {

namespace {

constexpr long steps = 1000000;
constexpr double radius = 0.5, stiffness = 1e5;

template <int D>
Scene slope_scene(double friction, double rolling, double share) {
  const double theta = std::atan(share * std::min(friction, rolling / radius));
  Scene scene = free_scene(D, friction, 0.3, stiffness);
  scene.material.rolling_friction = rolling;
  scene.material.tangential_damping_ratio = 0.3;
  add_floor(scene);
  scene.loading.gravity.front() = std::sin(theta), scene.loading.gravity.back() = -std::cos(theta);
  std::vector<double> centre(D, 0.0);
  centre.back() = radius;
  add_grain(scene, centre);
  scene.cd.dt = 1e-3;
  return scene;
}

template <int D>
void slope(EngineKind kind, double friction, double rolling, Report& report) {
  const bool rigid = kind == EngineKind::cd, slides = friction < rolling / radius;
  // md has no dashpot for rolling: a grain that rolls without slip rocks on its spring K_R = K mu_R^2 for good, within
  // the 1 % that is left to the limit.
  const bool rocks = !rigid && !slides;
  const double angle = 0.01 * rolling / (stiffness * rolling * rolling);
  const double frequency = rolling * std::sqrt(stiffness / (1 + inertia_ratio<D>)) / radius;
  {
    Trial<D> trial(report, kind, slope_scene<D>(friction, rolling, 0.99));
    trial.advance(steps / 10);
    const Vec<D> before = trial.position(0);
    trial.advance(steps - steps / 10);
    report.small(
        "creep at 0.99 of the limit, last 9e5 steps", (trial.position(0) - before).norm(),
        rocks ? 2 * radius * angle : 1e-10,
        rocks ? "rocks on the rolling spring, within 1 % of its limit" : "rounding of each step, 1e-16, with one sign");
    report.small("speed at 0.99 of the limit", trial.fastest(),
                 rigid   ? 1e-15
                 : rocks ? radius * angle * frequency
                         : 1e-9,
                 rigid   ? "rounding"
                 : rocks ? "the same, times its frequency"
                         : "rounding of the position times the contact's frequency");
  }
  const double share = 1.01;
  Trial<D> trial(report, kind, slope_scene<D>(friction, rolling, share));
  trial.advance(steps / 10);
  const double before = trial.velocity(0)[0], start = trial.time();
  trial.advance(steps - steps / 10);
  const double found = (trial.velocity(0)[0] - before) / (trial.time() - start);
  const double limit = std::min(friction, rolling / radius), theta = std::atan(share * limit);
  // The lever of a soft grain is shorter by its deflection, which counts where forces balance to 1 %.
  const double lever = radius - (rigid ? 0 : std::cos(theta) / stiffness);
  const double exact = slides ? std::sin(theta) - friction * std::cos(theta)
                              : (std::sin(theta) - rolling / lever * std::cos(theta)) /
                                    (1 + inertia_ratio<D> * radius * radius / (lever * lever));
  report.relative("acceleration at 1.01 of the limit", found, exact, rigid ? 1e-9 : 1e-5,
                  rigid ? "rounding of forces that balance to 1 %" : "what the start's ringing leaves");
}

}  // namespace

std::vector<Case> slope_cases() {
  const std::string trouble = "creep below the limit, a grain that sticks or gains speed beyond it";
  return {
      {.name = "slope_sliding",
       .tags = {"slope", "friction", "threshold", "drift"},
       .effort = Effort::quick,
       .scene = "a disk on a slope at 0.99 and 1.01 of its friction angle, 1e6 steps each (mu = 0.3, mu_R = 0.2 d)",
       .exact = "rest; a = g (sin - mu cos)",
       .trouble = trouble,
       .run = [](EngineKind kind, Report& report) { slope<2>(kind, 0.3, 0.2, report); }},
      {.name = "slope_rolling",
       .tags = {"slope", "rolling", "threshold", "drift"},
       .effort = Effort::quick,
       .scene = "a sphere on a slope at 0.99 and 1.01 of its rolling limit, 1e6 steps each (mu = 0.5, mu_R = 0.05 d)",
       .exact = "rest; a = g (sin - (mu_R/R) cos) / (1 + k)",
       .trouble = trouble,
       .run = [](EngineKind kind, Report& report) { slope<3>(kind, 0.5, 0.05, report); }},
  };
}

}  // namespace galet::verify
