// Stop and flow on a rough inclined plane, both engines: table as CSV on standard output. The law of what flows there,
// and annular shear, are studies (inclined-plane, annular-shear).
//
// 300 disks (+-20 %, mu = 0.4, e = 0.1, K_N = 1e5 m g / d) fall as a gas onto a floor of glued grains 20 d long,
// inclined by theta: a layer about 12 d deep, which stops or goes on. `kinetic`: energy per grain in m g d, mean over
// the last tenth of 600 sqrt(d / g) with its block error; `still_from`: the time from which it stays below 1e-4 m g d,
// which is a speed of 0.014 sqrt(g d), a fall of a ten-thousandth of a diameter.
#include <cmath>
#include <cstdio>
#include <string>

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

}  // namespace

int main() {
  try {
    slope();
    return 0;
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 2;
  }
}
