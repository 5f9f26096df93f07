// The files that a comparison leaves.
#include <cmath>
#include <filesystem>

#include <fmt/format.h>

#include "common/io/files.hpp"
#include "src/compare_report.hpp"
#include "src/engines.hpp"
#include "src/picture_files.hpp"

namespace galet {

namespace {

std::string series_label(EngineKind engine, const std::optional<double>& inertial_number) {
  const std::string name = engine == EngineKind::md ? "md (soft)" : "cd (rigid)";
  return inertial_number ? fmt::format("{}, I = {:g}", name, *inertial_number) : name;
}

/// One series per state and engine: |deviation from the rigid limit| against cost.
Figure error_cost_figure(const Comparison& comparison) {
  const Judged quantity = judged(comparison);
  Figure figure;
  figure.title = comparison.shortened ? "Error against cost (shortened comparison)" : "Error against cost";
  figure.x_label = comparison.shear ? "processor seconds per unit strain" : "processor seconds per unit time";
  figure.y_label = fmt::format("|{} - rigid limit|", quantity.name);
  figure.log_x = true;
  for (const StateLimit& state : comparison.limits)
    for (const EngineKind engine : {EngineKind::md, EngineKind::cd}) {
      Series series;
      series.label = series_label(engine, state.inertial_number);
      for (const CompareRow& row : comparison.rows) {
        const auto off = deviation_of(row, comparison);
        if (!off || row.plan.engine != engine || row.plan.inertial_number != state.inertial_number) continue;
        series.x.push_back(row.cost);
        series.y.push_back(std::abs(off->value));
        series.y_error.push_back(off->error);
      }
      if (!series.x.empty()) figure.series.push_back(std::move(series));
    }
  return figure;
}

Figure history_figure(const Comparison& comparison) {
  Figure figure{"Stress ratio", "strain", "μ*", false, false, {}};
  for (const CompareRow& row : comparison.rows) {
    if (!row.plan.reference || !row.usable()) continue;
    Series series;
    series.label = series_label(row.plan.engine, row.plan.inertial_number);
    series.x = row.series.column(Observable::strain);
    series.y = row.series.column(Observable::mu_star);
    series.line = true;
    figure.series.push_back(std::move(series));
  }
  return figure;
}

Figure profile_figure(const Comparison& comparison) {
  Figure figure{"Velocity profile of the last state", "velocity along x", "y", false, false, {}};
  for (const CompareRow& row : comparison.rows) {
    if (row.profile.empty()) continue;
    Series series;
    series.label = series_label(row.plan.engine, row.plan.inertial_number);
    series.line = true;
    for (const ProfileRow& layer : row.profile) {
      series.x.push_back(layer.velocity.x());
      series.y.push_back(layer.position);
    }
    figure.series.push_back(std::move(series));
  }
  return figure;
}

}  // namespace

std::vector<std::string> write_comparison(const Comparison& comparison, const std::string& scene,
                                          const std::string& directory) {
  const auto path = [&](const std::string& name) { return (std::filesystem::path(directory) / name).string(); };
  std::vector<std::string> files;
  write_csv(path("compare.csv"), compare_table(comparison));
  files.push_back(path("compare.csv"));
  write_file(path("compare.json"), compare_json(comparison, scene) + "\n");
  files.push_back(path("compare.json"));
  add_figure(files, path("error_cost"), error_cost_figure(comparison));
  if (comparison.shear) {
    add_figure(files, path("mu_star"), history_figure(comparison));
    add_figure(files, path("velocity_profile"), profile_figure(comparison));
  }
  for (const CompareRow& row : comparison.rows)
    if (row.plan.reference) add_picture(files, path("sample_" + engine_name(row.plan.engine)), row.picture);
  return files;
}

}  // namespace galet
