#include "src/studies/run_study.hpp"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "common/core/clock.hpp"
#include "common/core/error.hpp"
#include "common/io/files.hpp"
#include "common/io/scene_file.hpp"
#include "common/scene/stages.hpp"
#include "src/dimension.hpp"
#include "src/simulation.hpp"
#include "src/studies/registry.hpp"
#include "src/studies/row_file.hpp"

namespace galet {

namespace {

/// Share of a run of several stages, all taken as equally long.
double share_of(const Scene& scene, const Progress& at) {
  const double done = at.steps > 0 ? static_cast<double>(at.step) / static_cast<double>(at.steps) : 0;
  for (std::size_t k = 0; k < scene.stages.size(); ++k)
    if (stage_name(scene, k) == at.stage)
      return (static_cast<double>(k) + done) / static_cast<double>(scene.stages.size());
  return done;
}

RunResult run_scene(const Scene& scene, EngineKind engine, const WorkControl& work) {
  RunControl control;
  control.keep_last_good = false;
  control.stop = work.stop;
  control.progress = [&](const Progress& at) { work.progress(share_of(scene, at)); };
  return with_dimension(scene.dimension, [&](auto dimension) {
    Simulation<dimension> simulation(scene, engine);
    return simulation.run(control);
  });
}

std::string scene_path(const std::string& directory, const StudyRun& run) {
  return (std::filesystem::path(directory) / "scenes" / (run.name + ".toml")).string();
}

void run_row(StudyRow& row, const std::string& directory, const WorkControl& work) {
  if (work.stop()) {
    row.run.ending = Ending::interrupted;
    return;
  }
  row.run = run_scene(parse_scene(row.plan.scene, scene_path(directory, row.plan)), row.plan.engine, work);
  if (row.usable()) write_row(directory, row);
}

}  // namespace

bool StudyOutcome::failed() const {
  return static_cast<int>(rows.size()) < planned ||
         std::any_of(rows.begin(), rows.end(), [](const StudyRow& row) { return !row.usable(); });
}

StudyOutcome run_study(const Study& study, const StudyOptions& options) {
  require(!options.directory.empty(), "a study needs a folder for its results");
  StudyOutcome outcome;
  outcome.size = options.size;
  outcome.jobs = options.jobs;
  const double start = wall_seconds();
  std::filesystem::create_directories(std::filesystem::path(options.directory) / "scenes");
  std::vector<StudyRow> rows;
  std::vector<std::size_t> missing;
  for (const StudyRun& run : study.plan(options.size)) {
    write_file(scene_path(options.directory, run), run.scene);
    auto kept = options.fresh ? std::nullopt : read_row(options.directory, run);
    if (!kept) missing.push_back(rows.size());
    rows.push_back(kept ? std::move(*kept) : StudyRow{run, {}, false});
  }
  outcome.planned = static_cast<int>(rows.size());
  outcome.kept = outcome.planned - static_cast<int>(missing.size());

  std::vector<double> costs;
  for (const std::size_t k : missing) costs.push_back(estimate_run(rows[k].plan));
  run_side_by_side(options, costs,
                   [&](std::size_t k, const WorkControl& work) { run_row(rows[missing[k]], options.directory, work); });
  outcome.interrupted =
      std::erase_if(rows, [](const StudyRow& row) { return row.run.ending == Ending::interrupted; }) > 0;
  std::vector<StudyRow> usable;
  for (const StudyRow& row : rows)
    if (row.usable()) usable.push_back(row);
  outcome.report = study.evaluate(usable);
  outcome.rows = std::move(rows);
  outcome.wall_seconds = wall_seconds() - start;
  return outcome;
}

}  // namespace galet
