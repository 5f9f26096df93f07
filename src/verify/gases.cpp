// Gases: elastic ones keep their energy and have the pressure of hard grains; inelastic ones cool by Haff's law.
#include <fmt/format.h>

#include "common/measure/block_average.hpp"
#include "common/measure/stress.hpp"
#include "common/measure/temperature.hpp"
#include "src/verify/trial.hpp"

namespace galet::verify {

namespace {

/// Contact value of the pair distribution: Henderson 1975 (disks), Carnahan and Starling 1969 (spheres).
template <int D>
double contact_value(double phi) {
  if constexpr (D == 2)
    return (1 - 7 * phi / 16) / ((1 - phi) * (1 - phi));
  else
    return (1 - phi / 2) / std::pow(1 - phi, 3);
}

template <int D>
Scene gas_scene(int count, double phi, double e, double stiffness) {
  Scene scene = periodic_scene(D, count, 0, e, stiffness);
  scene.initial.solid_fraction = phi;
  scene.initial.speed = 1;
  scene.seed = 3;
  scene.cd.dt = 1e-3, scene.cd.tolerance = 1e-10, scene.cd.max_sweeps = 20000;
  return scene;
}

template <int D>
void elastic_gas(EngineKind kind, int count, double phi, double duration, Report& report) {
  Scene scene = gas_scene<D>(count, phi, 1, 1e6);
  Trial<D> trial(report, kind, scene);
  const double start = trial.engine().energy().total(),
               temperature = granular_temperature<D>(trial.state()).translational;
  trial.run_to(2);
  std::vector<double> pressure;
  const long every = kind == EngineKind::cd ? 1 : 8;  // a contact of md lasts 50 steps
  double worst = 0;
  while (trial.time() < duration) {
    double sum = 0;
    constexpr int looks = 200;
    for (int look = 0; look < looks; ++look) {
      trial.advance(every);
      sum += stress<D>(trial.state()).total().trace() / D / looks;
    }
    pressure.push_back(sum);
    worst = std::max(worst, std::abs(trial.engine().energy().total() / start - 1));
  }
  const Estimate mean = block_average(pressure, 8);
  const double n = count / trial.state().cell->volume();
  const double exact = n * temperature * (1 + (D == 2 ? 2 : 4) * phi * contact_value<D>(phi));
  report.small("largest relative error of the energy", worst, kind == EngineKind::cd ? 1e-8 : 2e-3,
               kind == EngineKind::cd ? "tolerance 1e-10 of the solver in each step"
                                      : "(w0 dt)^4 of a contact, a random walk of some thousand");
  report.relative("pressure", mean.value, exact, 3 * mean.error / mean.value + 0.01,
                  fmt::format("3 standard errors of the mean ({:.1e}), and 1 % for contact duration or step, and g",
                              mean.error / mean.value));
  report.small("momentum per grain", momentum<D>(trial.state()).norm() / count, 1e-12, "rounding");
}

/// 1 / tau from sqrt(T0 / T) = 1 + t / tau.
template <int D>
void haff(EngineKind kind, int count, double phi, double duration, Report& report) {
  constexpr double e = 0.9;
  Scene scene = gas_scene<D>(count, phi, e, 1e6);
  scene.md.steps_per_contact = 30;
  Trial<D> trial(report, kind, scene);
  const double hot = granular_temperature<D>(trial.state()).translational;
  trial.run_to(duration);
  const double cold = granular_temperature<D>(trial.state()).translational;
  const double n = count / trial.state().cell->volume(), g = contact_value<D>(phi);
  const double exact = (D == 2 ? 0.5 : 2.0 / 3) * (1 - e * e) * n * g * std::sqrt(pi * hot);
  const double found = (std::sqrt(hot / cold) - 1) / trial.time();
  report.relative("1 / tau", found, exact, 0.05,
                  "measured decays lie up to 5 % below Enskog's (Kawahara and Nakanishi 2004)");
  report.small("momentum per grain", momentum<D>(trial.state()).norm() / count, 1e-12, "rounding");
}

}  // namespace

std::vector<Case> gas_cases() {
  const std::string pressure = "energy kept; P = n T (1 + 2^(D-1) phi g), g of Henderson or Carnahan-Starling";
  const std::string cooling = "Haff's law with Enskog's collision rate (Haff 1983)";
  return {
      {.name = "elastic_gas_2d",
       .tags = {"gas", "restitution"},
       .effort = Effort::full,
       .scene = "400 elastic disks at Phi = 0.3, until time 20",
       .exact = pressure,
       .trouble = "a gas that heats or cools, collisions missed (pressure too low)",
       .run = [](EngineKind kind, Report& report) { elastic_gas<2>(kind, 400, 0.3, 20, report); }},
      {.name = "elastic_gas_3d",
       .tags = {"gas", "restitution"},
       .effort = Effort::full,
       .scene = "400 elastic spheres at Phi = 0.2, until time 20",
       .exact = pressure,
       .trouble = "the same",
       .run = [](EngineKind kind, Report& report) { elastic_gas<3>(kind, 400, 0.2, 20, report); }},
      {.name = "haff_2d",
       .tags = {"gas", "cooling"},
       .effort = Effort::full,
       .scene = "500 disks at Phi = 0.2, e = 0.9, until time 15",
       .exact = cooling,
       .trouble = "cooling of another rate (missed collisions), a gas that heats",
       .run = [](EngineKind kind, Report& report) { haff<2>(kind, 500, 0.2, 15, report); }},
      {.name = "haff_3d",
       .tags = {"gas", "cooling"},
       .effort = Effort::full,
       .scene = "500 spheres at Phi = 0.1, e = 0.9, until time 15",
       .exact = cooling,
       .trouble = "the same",
       .run = [](EngineKind kind, Report& report) { haff<3>(kind, 500, 0.1, 15, report); }},
      {.name = "elastic_gas_small",
       .tags = {"gas", "restitution"},
       .effort = Effort::quick,
       .scene = "100 elastic disks at Phi = 0.3, until time 10",
       .exact = pressure,
       .trouble = "the same",
       .run = [](EngineKind kind, Report& report) { elastic_gas<2>(kind, 100, 0.3, 10, report); }},
  };
}

}  // namespace galet::verify
