// Flows with gradients of stress, both engines:
//
//   gradient_flows slope               stop and flow on a rough inclined plane: table as CSV
//   gradient_flows annulus [SEEDS]     the local law of annular shear beside homogeneous shear (default: 4 samples)
//
// slope: 300 disks (+-20 %, mu = 0.4, e = 0.1, K_N = 1e5 m g / d) fall as a gas onto a floor of glued grains 20 d long,
// inclined by theta: a layer about 12 d deep, which stops or goes on. `kinetic`: energy per grain in m g d, mean over
// the last tenth of 600 sqrt(d / g) with its block error; `still_from`: the time from which it stays below 1e-4 m g d,
// which is a speed of 0.014 sqrt(g d), a fall of a ten-thousandth of a diameter.
//
// annulus: as scenes/annular_shear_2d.toml, the inner ring's surface moving at sqrt(P / m) = 1: in
// each ring of width d, at least 2.5 d from either boundary, mu* = |sigma_r,theta| / sigma_rr, Phi and I = rate
// sqrt(m / sigma_rr), as means over samples of different seeds with the standard error among these. Beside them mu*
// and Phi of homogeneous shear of 400 disks at the ring's I, with block errors over a strain of 30 (15 at I < 0.03).
// Rings with I below 0.005 are left out: they creep. `deviation`: difference of mu* over its standard error.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "common/core/error.hpp"
#include "common/io/scene_file.hpp"
#include "common/measure/block_average.hpp"
#include "src/simulation.hpp"

namespace {

using namespace galet;

RunResult run(const std::string& text, EngineKind kind) {
  const RunResult result = Simulation<2>(parse_scene(text, "benchmark"), kind).run();
  if (result.ending == Ending::failed) throw RunError(result.failure);
  return result;
}

const char* name_of(EngineKind kind) { return kind == EngineKind::md ? "md" : "cd"; }

std::string slope_scene(double angle, double duration) {
  return fmt::format(R"(
grains = {{count = 300, diameter = {{distribution = "uniform", mean = 1, spread = 0.2}}}}
material = {{friction = 0.4, restitution = 0.1, normal_stiffness = 1e5}}
initial.kind = "gas"
cell = {{size = [20, 40], periodic = [true, false]}}
body = [{{name = "floor", shape = "wall", at = 0.5}}]
loading = {{gravity = [0, -1], inclination = {}}}
md.steps_per_contact = 30
cd = {{dt = 0.02, tolerance = 1e-3}}
run = {{duration = {}, samples = 600}}
)",
                     angle, duration);
}

void slope() {
  constexpr double duration = 600, still = 1e-4;
  fmt::print("engine,theta,tan_theta,kinetic,kinetic_error,still_from,verdict\n");
  for (const EngineKind kind : {EngineKind::md, EngineKind::cd})
    for (const double angle : {12.0, 14.0, 16.0, 17.0, 18.0, 20.0}) {
      const RunResult result = run(slope_scene(angle, duration), kind);
      const Estimate kinetic = block_average(result.series.column(Observable::kinetic_per_grain, 0.9 * duration));
      double still_from = 0;
      for (const Measurement& row : result.series.rows)
        if (row[Observable::kinetic_per_grain] > still) still_from = row[Observable::time];
      const bool stopped = still_from < 0.9 * duration;
      fmt::print("{},{},{:.4f},{:.3g},{:.1g},{},{}\n", name_of(kind), angle, std::tan(angle * 3.14159265358979 / 180),
                 kinetic.value, kinetic.error, stopped ? fmt::format("{:.0f}", still_from) : "",
                 stopped ? "stops" : "flows");
      std::fflush(stdout);
    }
}

std::string annulus_scene(int seed) {
  return fmt::format(R"(
seed = {}
grains = {{count = 1230, diameter = {{distribution = "uniform", mean = 1, spread = 0.2}}}}
material = {{friction = 0.4, restitution = 0.1, stiffness_level = 1e3, tangential_stiffness_ratio = 0.5}}
initial.kind = "dense"
cell = {{size = [52, 52], periodic = [false, false]}}
loading.pressure = 1
md.steps_per_contact = 30
cd = {{dt = 0.02, tolerance = 1e-3}}
run = {{duration = 200, average_from = 0.3, samples = 2000}}
output = {{measures = ["profile"], profile_layers = 12, profile_centre = [26, 26], profile_radii = [12, 24]}}
[[body]]
name = "inner"
shape = "ring"
centre = [26, 26]
radius = 12
grains = "outside"
spin = 0.0833333
[[body]]
name = "outer"
shape = "ring"
centre = [26, 26]
radius = 24
segments = 24
pressure = 1
mass = 20
)",
                     seed);
}

std::string homogeneous_scene(double inertial_number) {
  return fmt::format(R"(
seed = 3
grains = {{count = 400, diameter = {{distribution = "uniform", mean = 1, spread = 0.2}}}}
material = {{friction = 0.4, restitution = 0.1, stiffness_level = 1e3, tangential_stiffness_ratio = 0.5}}
initial = {{kind = "gas", solid_fraction = 0.5}}
loading = {{kind = "plane_shear", pressure = 1, inertial_number = {}}}
md.steps_per_contact = 30
cd = {{dt = 0.02, tolerance = 1e-3}}
run = {{strain = {}, average_from = 0.25, samples = 4000}}
)",
                     inertial_number, inertial_number < 0.03 ? 20 : 40);
}

/// Mean over samples and its standard error.
Estimate of_samples(const std::vector<double>& values) {
  double mean = 0, square = 0;
  const double n = static_cast<double>(values.size());
  for (const double value : values) mean += value / n;
  for (const double value : values) square += (value - mean) * (value - mean);
  return {mean, std::sqrt(square / (n - 1) / n)};
}

void annulus(int seeds) {
  constexpr double inner = 12, outer = 24, away = 2.5, creep = 0.005;
  fmt::print(
      "engine,r,I,I_error,mu_star,mu_star_error,Phi,Phi_error,mu_star_homogeneous,mu_star_homogeneous_error,"
      "Phi_homogeneous,Phi_homogeneous_error,deviation\n");
  for (const EngineKind kind : {EngineKind::md, EngineKind::cd}) {
    std::vector<std::vector<ProfileRow>> samples;
    for (int seed = 1; seed <= seeds; ++seed) samples.push_back(run(annulus_scene(seed), kind).measures.profile);
    for (std::size_t ring = 0; ring < samples[0].size(); ++ring) {
      const double r = samples[0][ring].position;
      if (r < inner + away || r > outer - away) continue;
      const auto mean = [&](auto of) {
        std::vector<double> values;
        for (const auto& rings : samples) values.push_back(of(rings[ring]));
        return of_samples(values);
      };
      const Estimate number =
          mean([](const ProfileRow& row) { return std::abs(row.shear_rate.y()) / std::sqrt(row.stress(0, 0)); });
      if (number.value < creep) continue;
      const Estimate mu = mean([](const ProfileRow& row) { return std::abs(row.stress(1, 0)) / row.stress(0, 0); });
      const Estimate fraction = mean([](const ProfileRow& row) { return row.solid_fraction; });
      const RunResult result = run(homogeneous_scene(number.value), kind);
      const Estimate mu_there = result.averages[Observable::mu_star],
                     fraction_there = result.averages[Observable::solid_fraction];
      fmt::print("{},{:.1f},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:.1f}\n",
                 name_of(kind), r, number.value, number.error, mu.value, mu.error, fraction.value, fraction.error,
                 mu_there.value, mu_there.error, fraction_there.value, fraction_there.error,
                 (mu.value - mu_there.value) / std::hypot(mu.error, mu_there.error));
      std::fflush(stdout);
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const std::string what = argc > 1 ? argv[1] : "";
    const int seeds = argc > 2 ? std::atoi(argv[2]) : 4;
    if (what == "slope" && argc == 2)
      slope();
    else if (what == "annulus" && argc <= 3 && seeds >= 2)
      annulus(seeds);
    else
      throw InputError("gradient_flows slope | annulus [SEEDS, 2 at least]");
    return 0;
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 2;
  }
}
