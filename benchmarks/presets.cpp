// Every ready scene with both engines, side by side: a row per scene (or stage) and engine.
//   presets FOLDER_OF_SCENES [NAME...] [FIELD=VALUE...]      table as CSV on standard output
//
// FIELD=VALUE changes the scenes named, as `galet run --set` does; the column `changes` says so.
// sigma, mu*, Phi, z: of the last stage means as the run's summary has them, or its last sample where it ends at rest;
// of stages before their last sample.
// `held`: each stress and rate that the loading asks for at the end of the stage, with what was there, as "sigma_yy 1:
// 0.999+-0.02": mean and standard deviation of the rows of the last third of the stage (of a stress that changes, the
// last row, a mean over the last hundredth of the way). `budget`: md: what its energy budget doesn't account for, over
// the energy dissipated; cd: energy that contacts made over what they dissipated. `missed`: steps
// of cd whose contact problem was not solved to the tolerance; `penetration`: the largest of cd, over d.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <numbers>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "common/core/error.hpp"
#include "common/io/scene_file.hpp"
#include "common/scene/loading.hpp"
#include "common/scene/stages.hpp"
#include "src/simulation.hpp"

namespace {

using namespace galet;

/// As the head of this file says.
std::string budget_residual(const RunResult& result) {
  const Measurement& last = result.last;
  if (result.engine == EngineKind::cd)
    return result.solver.dissipated > 0 ? fmt::format("{:.1e}", result.solver.gained / result.solver.dissipated) : "";
  double dissipated = std::abs(last[Observable::energy_residual]);
  for (const Observable channel :
       {Observable::dissipated_viscous, Observable::dissipated_sliding, Observable::dissipated_unloading,
        Observable::dissipated_rolling, Observable::dissipated_pivoting, Observable::dissipated_relaxation})
    if (std::isfinite(last[channel])) dissipated += last[channel];
  return dissipated > 0 ? fmt::format("{:.1e}", std::abs(last[Observable::energy_residual]) / dissipated) : "";
}

/// The mean normal stress, or one component, of a row.
double stress_of(const Measurement& row, const std::string& component) {
  constexpr std::array<std::pair<const char*, Observable>, 6> names = {{{"xx", Observable::sigma_xx},
                                                                        {"yy", Observable::sigma_yy},
                                                                        {"zz", Observable::sigma_zz},
                                                                        {"xy", Observable::sigma_xy},
                                                                        {"xz", Observable::sigma_xz},
                                                                        {"yz", Observable::sigma_yz}}};
  for (const auto& [name, observable] : names)
    if (component == name) return row[observable];
  return row[Observable::pressure];
}

/// The rate of a component between the first and the last row; "isotropic": of each diagonal component.
double rate_of(const std::vector<Measurement>& rows, const std::string& component) {
  constexpr std::array<std::pair<const char*, Observable>, 4> names = {
      {{"xx", Observable::eps_xx}, {"yy", Observable::eps_yy}, {"zz", Observable::eps_zz}, {"xy", Observable::strain}}};
  if (component == "isotropic") {
    double mean = 0, count = 0;
    for (int k = 0; k < 3; ++k)
      if (const double one = rate_of(rows, names[k].first); std::isfinite(one)) mean += one, ++count;
    return mean / count;
  }
  for (const auto& [name, observable] : names) {
    if (component != name) continue;
    const double change = rows.back()[observable] - rows.front()[observable];
    const double rate = change / (rows.back()[Observable::time] - rows.front()[Observable::time]);
    return component == "xy" ? rate : -rate;  // eps is positive in compression, L in extension
  }
  return std::nan("");
}

/// A bed at rest: the vertical stress of each layer over the weight of the grains above its middle (mean mass 1).
std::string held_by_the_floor(const Scene& scene, const std::vector<ProfileRow>& rows) {
  double above = 0, mean = 0, square = 0, count = 0;
  for (std::size_t k = rows.size(); k-- > 1;) {  // the lowest layer has the floor's grains
    const double weight = (above + 0.5 * rows[k].grains) * -scene.loading.gravity.back() / scene.cell.size[0];
    above += rows[k].grains;
    if (rows[k].solid_fraction < 0.75) continue;
    const double ratio = rows[k].stress(1, 1) / weight;
    mean += ratio, square += ratio * ratio, ++count;
  }
  mean /= count;
  return fmt::format("sigma_yy over the weight above 1: {:.4g}+-{:.1g}", mean,
                     std::sqrt(std::max(0.0, square / count - mean * mean)));
}

/// Between rings: the radial stress, and the moment sigma_r,theta r^2 of single rings over its mean, of the rings that
/// lie between the boundaries' grains.
std::string held_between_rings(const Scene& scene, const std::vector<ProfileRow>& rows) {
  const auto mean_and_scatter = [&](auto of) {
    double mean = 0, square = 0, count = 0;
    for (std::size_t k = 1; k + 1 < rows.size(); ++k) mean += of(rows[k]), square += std::pow(of(rows[k]), 2), ++count;
    mean /= count;
    return std::pair(mean, std::sqrt(std::max(0.0, square / count - mean * mean)));
  };
  const auto radial = mean_and_scatter([](const ProfileRow& row) { return row.stress(0, 0); });
  const auto moment =
      mean_and_scatter([](const ProfileRow& row) { return row.stress(1, 0) * row.position * row.position; });
  return fmt::format("sigma_rr {:.4g}: {:.4g}+-{:.1g}; sigma_r.theta r^2 over its mean 1: 1+-{:.1g}",
                     scene.loading.pressure.value_or(0), radial.first, radial.second,
                     std::abs(moment.second / moment.first));
}

/// Between walls, or down a slope, where no cell is driven: what the middle half of the profile shows.
std::string held_across(const Scene& scene, const RunResult& result) {
  const std::vector<ProfileRow>& rows = result.measures.profile;
  if (rows.empty()) return "";
  if (result.measures.profile_by_rings) return held_between_rings(scene, rows);
  if (!scene.loading.gravity.empty() && !scene.loading.inclination) return held_by_the_floor(scene, rows);
  std::vector<double> normal, ratio;
  for (const ProfileRow& row : rows) {
    if (row.solid_fraction < 0.5 * rows[rows.size() / 4].solid_fraction) continue;  // above the surface
    normal.push_back(row.stress(1, 1)), ratio.push_back(std::abs(row.stress(0, 1)) / row.stress(1, 1));
  }
  const auto middle = [](const std::vector<double>& all) {
    const std::vector<double> part(all.begin() + all.size() / 4, all.end() - all.size() / 4);
    double mean = 0, square = 0;
    for (const double value : part) mean += value / part.size();
    for (const double value : part) square += (value - mean) * (value - mean) / part.size();
    return fmt::format("{:.4g}+-{:.1g}", mean, std::sqrt(square));
  };
  if (scene.loading.inclination)
    return fmt::format("mu* {:.4g}: {}", std::tan(*scene.loading.inclination * std::numbers::pi / 180), middle(ratio));
  if (scene.loading.pressure) return fmt::format("sigma_yy {:.4g}: {}", *scene.loading.pressure, middle(normal));
  return "";
}

/// What is asked for and what was there.
std::string held(const Scene& stage, const Derived& derived, const std::vector<Measurement>& rows) {
  std::string text;
  for (const CellDrive& drive : loading_drives(stage, derived)) {
    if (drive.rate && path_parts(stage) == 1 && *drive.rate != 0)
      text += fmt::format("{}rate_{} {:.4g}: {:.4g}", text.empty() ? "" : "; ", drive.component, *drive.rate,
                          rate_of(rows, drive.component));
    if (!drive.stress) continue;
    const bool changes = drive.stress_to.has_value();
    const std::size_t first = changes ? rows.size() - 1 : rows.size() - (rows.size() + 2) / 3;
    double mean = 0, square = 0;
    const double count = static_cast<double>(rows.size() - first);
    for (std::size_t k = first; k < rows.size(); ++k) mean += stress_of(rows[k], drive.component) / count;
    for (std::size_t k = first; k < rows.size(); ++k)
      square += std::pow(stress_of(rows[k], drive.component) - mean, 2) / count;
    text += fmt::format("{}sigma_{} {:.4g}: {:.4g}", text.empty() ? "" : "; ", drive.component,
                        changes ? *drive.stress_to : *drive.stress, mean);
    if (!changes) text += fmt::format("+-{:.1g}", std::sqrt(square));
  }
  return text;
}

/// Means over the averaged part; the last sample of a run that ends at rest: what was on its way there is no state.
Measurement averages_of(const RunResult& result) {
  Measurement mean = result.last;
  if (result.ending == Ending::equilibrium) return mean;
  for (int k = 0; k < observable_count; ++k) {
    const double value = result.averages[static_cast<Observable>(k)].value;
    if (std::isfinite(value)) mean.values[k] = value;
  }
  return mean;
}

struct Row {
  std::string stage;
  Ending ending = Ending::finished;
  double time = 0;
  Measurement m;
  std::string held;
};

void print_row(const std::string& name, const RunResult& result, const Row& row, bool last,
               const std::string& changes) {
  const Measurement& m = row.m;
  fmt::print("{},{},{},{},{:.5g},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:.3f},{:.3f},{}", name,
             result.engine == EngineKind::md ? "md" : "cd", row.stage, to_string(row.ending), row.time,
             m[Observable::sigma_xx], m[Observable::sigma_yy], m[Observable::sigma_xy], m[Observable::mu_star],
             m[Observable::solid_fraction], m[Observable::z], m[Observable::z_star], row.held);
  if (!last) {
    fmt::print(",,,,,{}\n", changes);
    return;
  }
  const bool rigid = result.engine == EngineKind::cd;
  fmt::print(",{},{},{},{:.0f},{}\n", budget_residual(result),
             rigid ? fmt::format("{} of {}", result.solver.missed, result.solver.steps) : "",
             rigid ? fmt::format("{:.1e}", result.solver.penetration) : "", result.cpu_seconds, changes);
  std::fflush(stdout);
}

template <int D>
void run(const std::string& name, Scene scene, const std::string& changes) {
  scene.md.energy_budget = true;
  for (const EngineKind kind : {EngineKind::md, EngineKind::cd}) {
    scene.engine = kind;
    Simulation<D> simulation(scene, kind);
    const RunResult result = simulation.run();
    if (result.ending == Ending::failed) {
      fmt::print("{},{},,failed: {},,,,,,,,,,,,,,{}\n", name, kind == EngineKind::md ? "md" : "cd", result.failure,
                 changes);
      continue;
    }
    const std::vector<Scene> stages = stage_scenes(scene);
    const std::vector<Derived> derived = derive_stages(scene, grain_facts<D>(scene, simulation.present_sample()));
    std::vector<Row> rows;
    for (const StageReport& stage : result.stages)
      rows.push_back({stage.name, stage.ending, stage.time, stage.last, ""});
    if (rows.empty()) rows.push_back({"", result.ending, result.time, {}, ""});
    rows.back().m = averages_of(result);
    double from = 0;
    for (std::size_t k = 0; k < rows.size(); ++k) {
      std::vector<Measurement> of_stage;
      for (const Measurement& row : result.series.rows)
        if (row[Observable::time] > from && row[Observable::time] <= rows[k].time) of_stage.push_back(row);
      from = rows[k].time;
      if (of_stage.size() > 1) rows[k].held = held(stages[k], derived[k], of_stage);
      if (k + 1 == rows.size() && rows[k].held.empty()) rows[k].held = held_across(scene, result);
      print_row(name, result, rows[k], k + 1 == rows.size(), changes);
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  try {
    if (argc < 2) throw InputError("presets FOLDER_OF_SCENES [NAME...] [FIELD=VALUE...]");
    std::vector<std::string> names;
    std::vector<Override> overrides;
    std::string changes;
    for (int k = 2; k < argc; ++k) {
      const std::string word = argv[k];
      const std::size_t equals = word.find('=');
      if (equals == std::string::npos) {
        names.push_back(word);
        continue;
      }
      overrides.push_back({word.substr(0, equals), word.substr(equals + 1)});
      changes += (changes.empty() ? "" : "; ") + word;
      std::replace(changes.begin(), changes.end(), ',', ' ');  // of the table's cells
    }
    if (names.empty())
      for (const auto& entry : std::filesystem::directory_iterator(argv[1]))
        names.push_back(entry.path().stem().string());
    std::sort(names.begin(), names.end());
    fmt::print(
        "scene,engine,stage,ending,time,sigma_xx,sigma_yy,sigma_xy,mu_star,Phi,z,z_star,held,budget,missed,"
        "penetration,cpu_seconds,changes\n");
    for (const std::string& name : names) {
      const Scene scene = read_scene(std::string(argv[1]) + "/" + name + ".toml", overrides);
      scene.dimension == 2 ? run<2>(name, scene, changes) : run<3>(name, scene, changes);
    }
    return 0;
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 2;
  }
}
