#include "src/report/run_folder.hpp"

#include <algorithm>
#include <filesystem>
#include <limits>

#include <fmt/format.h>

#include "common/core/error.hpp"
#include "common/io/files.hpp"

namespace galet::report {

namespace fs = std::filesystem;

namespace {

nlohmann::ordered_json read_json(const std::string& path) {
  try {
    return nlohmann::ordered_json::parse(read_file(path));
  } catch (const nlohmann::json::parse_error& error) {
    throw InputError({Mistake{path, 0, 0, fmt::format("this is no whole JSON file: {}", error.what())}});
  }
}

bool there(const fs::path& path) {
  std::error_code ignored;
  return fs::is_regular_file(path, ignored);
}

std::optional<NumberTable> read_table(const fs::path& path) {
  if (!there(path)) return std::nullopt;
  return read_csv(path.string(), EmptyCells::not_a_number);
}

EngineRun read_run(const fs::path& folder, const std::string& engine) {
  EngineRun run;
  run.engine = engine;
  const std::string summary = (folder / (engine + "_summary.json")).string();
  run.summary = read_json(summary);
  if (!run.summary.is_object() || !run.summary.contains("averages") || !run.summary.contains("origin"))
    throw InputError({Mistake{summary, 0, 0, "this is no summary of a run by this version of galet"}});
  const auto table_of = [&](const char* name) { return read_table(folder / fmt::format("{}_{}.csv", engine, name)); };
  run.series = table_of("series");
  run.profile = table_of("profile");
  run.forces = table_of("forces");
  run.gaps = table_of("gaps");
  run.voronoi = table_of("voronoi");
  run.directions = table_of("directions");
  if (const fs::path picture = folder / fmt::format("sample_{}.svg", engine); there(picture))
    run.picture = read_file(picture.string());
  if (const fs::path checkpoint = folder / (engine + "_checkpoint.h5"); there(checkpoint))
    run.checkpoint = checkpoint.string();
  return run;
}

}  // namespace

RunFolder read_run_folder(const std::string& path) {
  std::error_code error;
  if (!fs::is_directory(path, error))
    throw InputError(fmt::format("'{}' is no folder: expected one that galet run or galet compare wrote", path));
  RunFolder folder;
  folder.path = path;
  for (const fs::directory_entry& entry : fs::directory_iterator(path, error))
    if (entry.is_regular_file(error))
      folder.files.emplace_back(entry.path().filename().string(), entry.file_size(error));
  if (error) throw InputError(fmt::format("can't read the folder '{}': {}", path, error.message()));
  std::sort(folder.files.begin(), folder.files.end());
  for (const char* engine : {"md", "cd"})
    if (there(fs::path(path) / fmt::format("{}_summary.json", engine))) folder.runs.push_back(read_run(path, engine));
  if (const fs::path comparison = fs::path(path) / "compare.json"; there(comparison))
    folder.comparison = read_json(comparison.string());
  if (folder.runs.empty() && folder.comparison.is_null())
    throw InputError(fmt::format(
        "'{}' holds no results: expected md_summary.json, cd_summary.json (galet run) or compare.json (galet compare)",
        path));
  return folder;
}

double number(const nlohmann::ordered_json& json, const std::string& key) {
  const auto found = json.find(key);
  return found != json.end() && found->is_number() ? found->get<double>() : std::numeric_limits<double>::quiet_NaN();
}

std::string text(const nlohmann::ordered_json& json, const std::string& key) {
  const auto found = json.find(key);
  return found != json.end() && found->is_string() ? found->get<std::string>() : std::string();
}

}  // namespace galet::report
