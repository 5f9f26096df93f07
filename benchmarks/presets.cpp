// Every ready scene with both engines, side by side: a row per scene (or stage) and engine, with the stresses reached,
// Phi, z, mu*, the residual of the energy budget (md) and the time that it took.
//   presets FOLDER_OF_SCENES [NAME...]      table as CSV on standard output
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "common/core/error.hpp"
#include "common/io/scene_file.hpp"
#include "common/scene/stages.hpp"
#include "src/simulation.hpp"

namespace {

using namespace galet;

/// What of the budget is not accounted for, in units of all energy that came in.
std::string budget_residual(const RunResult& result, const Measurement& last) {
  const double in = std::abs(last[Observable::work]) + std::abs(last[Observable::energy_residual]);
  if (result.engine != EngineKind::md || !(in > 0)) return "";
  return fmt::format("{:.1e}", std::abs(last[Observable::energy_residual]) / in);
}

void print_row(const std::string& name, const RunResult& result, const std::string& stage, Ending ending,
               const Measurement& m, double seconds, double time) {
  fmt::print("{},{},{},{},{:.5g},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:.3f},{:.3f},{},{:.1f}\n", name,
             result.engine == EngineKind::md ? "md" : "cd", stage, to_string(ending), time, m[Observable::sigma_xx],
             m[Observable::sigma_yy], m[Observable::sigma_xy], m[Observable::mu_star], m[Observable::solid_fraction],
             m[Observable::z], m[Observable::z_star], budget_residual(result, m), seconds);
}

/// Means over the averaged part where the scene averages, else the last sample.
Measurement averages_of(const RunResult& result) {
  Measurement mean = result.last;
  for (int k = 0; k < observable_count; ++k) {
    const double value = result.averages[static_cast<Observable>(k)].value;
    if (std::isfinite(value)) mean.values[k] = value;
  }
  return mean;
}

template <int D>
void run(const std::string& name, Scene scene) {
  scene.md.energy_budget = true;
  for (const EngineKind kind : {EngineKind::md, EngineKind::cd}) {
    scene.engine = kind;
    Simulation<D> simulation(scene, kind);
    const RunResult result = simulation.run();
    if (result.ending == Ending::failed) {
      fmt::print("{},{},,failed: {}\n", name, kind == EngineKind::md ? "md" : "cd", result.failure);
      continue;
    }
    for (std::size_t k = 0; k + 1 < result.stages.size(); ++k) {
      const StageReport& stage = result.stages[k];
      print_row(name, result, stage.name, stage.ending, stage.last, 0, stage.time);
    }
    Measurement mean = averages_of(result);
    mean[Observable::work] = result.last[Observable::work];
    mean[Observable::energy_residual] = result.last[Observable::energy_residual];
    print_row(name, result, result.stages.empty() ? "" : result.stages.back().name, result.ending, mean,
              result.cpu_seconds, result.time);
    std::fflush(stdout);
  }
}

}  // namespace

int main(int argc, char** argv) {
  try {
    if (argc < 2) throw InputError("presets FOLDER_OF_SCENES [NAME...]");
    std::vector<std::string> names(argv + 2, argv + argc);
    if (names.empty())
      for (const auto& entry : std::filesystem::directory_iterator(argv[1]))
        names.push_back(entry.path().stem().string());
    std::sort(names.begin(), names.end());
    fmt::print(
        "scene,engine,stage,ending,time,sigma_xx,sigma_yy,sigma_xy,mu_star,Phi,z,z_star,budget_residual,"
        "cpu_seconds\n");
    for (const std::string& name : names) {
      const Scene scene = read_scene(std::string(argv[1]) + "/" + name + ".toml");
      scene.dimension == 2 ? run<2>(name, scene) : run<3>(name, scene);
    }
    return 0;
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 2;
  }
}
