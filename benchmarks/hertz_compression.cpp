// Isotropic compression of frictionless Hertz spheres (glass): the packing at 10 kPa and how its coordination grows
// with the pressure, that is with falling stiffness level.
//
//   hertz_compression [N] [SEED] > table.csv        N = 4000
//
// A gas of solid fraction 0.3 is compressed by a mean stress of 10 kPa (kappa = 39000), then on from there to each
// higher pressure. Each stage lasts 60 inertial times under the contacts' own damping alone; then damping proportional
// to the accelerations brings it to equilibrium: it takes the same share of energy out of each period of every mode,
// while the soft modes of a nearly isostatic packing hardly move its contacts, so that these hardly damp them, and a
// drag makes them creep. Weak damping (0.3): a stronger one slows the last densification, and Phi and z* come out too
// low. N = 4000 takes a thousand inertial times to come to rest at 10 kPa, half an hour on one core; N = 500 seconds.
// Columns: kappa, P in kPa, Phi, z, z* and share of rattlers, all at rest; the largest deflection over d; kinetic
// energy per grain over P d^3; steps and processor seconds of the relaxation. References: Agnolin and Roux 2007 (state
// A): Phi = 0.637, z* = 6.07, rattlers 1.3 %; z* about 5 % higher at kappa = 2000 (chapter). What it can't tell: the
// scatter from packing to packing, for which SEED is there.
#include <cstdio>
#include <cstdlib>

#include <fmt/format.h>

#include "src/simulation.hpp"

namespace galet {
namespace {

constexpr double first_pressure = 1e4, diameter = 1e-3;
constexpr double young_modulus = 70e9, poisson_ratio = 0.3;

/// P at which glass has the stiffness level kappa.
double pressure_at(double kappa) { return young_modulus / (1 - poisson_ratio * poisson_ratio) / std::pow(kappa, 1.5); }

double inertial_time(double pressure) { return std::sqrt(2500 * grain_volume<3>(diameter) / (pressure * diameter)); }

Scene glass(int count, std::uint64_t seed, double pressure) {
  Scene scene;
  scene.dimension = 3;
  scene.reduced_units = false;
  scene.seed = seed;
  scene.grains.count = count;
  scene.grains.diameter.mean = diameter;
  scene.grains.density = 2500;
  scene.material.normal_law = NormalLaw::hertz;
  scene.material.young_modulus = young_modulus;
  scene.material.poisson_ratio = poisson_ratio;
  scene.material.restitution = 0.2;
  scene.initial.solid_fraction = 0.3;
  scene.cell.periodic.assign(3, true);
  scene.loading.kind = LoadingKind::isotropic;
  scene.loading.pressure = pressure;
  scene.md.steps_per_contact = 30;
  scene.run.duration = 60 * inertial_time(pressure);
  scene.run.samples = 100;
  return scene;
}

/// The same until it is at rest: kinetic energy per grain below 5e-8 P d^3, as with Agnolin and Roux.
Scene relaxing(Scene scene) {
  const double time = inertial_time(*scene.loading.pressure);
  scene.md.acceleration_damping = 0.3;
  scene.run.duration = 1500 * time;
  scene.run.equilibrium = 5e-8;
  scene.run.samples = 15000;
  return scene;
}

void print_row(const RunResult& result, double kappa, double pressure) {
  const auto last = [&](Observable observable) { return result.last[observable]; };
  fmt::print("{:.0f},{:.4g},{:.5f},{:.4f},{:.4f},{:.4f},{:.5f},{:.3g},{},{:.0f},{}\n", kappa, pressure / 1e3,
             last(Observable::solid_fraction), last(Observable::z), last(Observable::z_star),
             last(Observable::rattler_fraction), last(Observable::largest_overlap),
             last(Observable::kinetic_per_grain) / (pressure * std::pow(diameter, 3)), result.steps, result.cpu_seconds,
             result.ending == Ending::equilibrium ? "equilibrium" : "NOT SETTLED");
  std::fflush(stdout);
}

int compress(int count, std::uint64_t seed) {
  std::setvbuf(stdout, nullptr, _IOLBF, 0);
  fmt::print("kappa,P_kPa,Phi,z,z_star,rattlers,largest_overlap,kinetic,relaxation_steps,relaxation_seconds,ending\n");
  std::optional<Sample<3>> packing;
  bool settled = true;
  for (const double kappa : {39000.0, 20000.0, 10000.0, 5000.0, 2000.0}) {
    const double pressure = kappa == 39000.0 ? first_pressure : pressure_at(kappa);
    const Scene scene = glass(count, seed, pressure);
    Simulation<3> loading =
        packing ? Simulation<3>(scene, EngineKind::md, *packing) : Simulation<3>(scene, EngineKind::md);
    loading.run();
    Simulation<3> simulation(relaxing(scene), EngineKind::md, loading.rest_sample());
    const RunResult result = simulation.run();
    for (const std::string& note : result.notes) fmt::print(stderr, "note: {}\n", note);
    print_row(result, kappa, pressure);
    settled = settled && result.ending == Ending::equilibrium;
    packing = simulation.rest_sample();
  }
  return settled ? 0 : 1;
}

}  // namespace
}  // namespace galet

int main(int argc, char** argv) {
  const int count = argc > 1 ? std::atoi(argv[1]) : 4000;
  const std::uint64_t seed = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 1;
  return galet::compress(count, seed);
}
