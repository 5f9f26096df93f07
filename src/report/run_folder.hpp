// What runs and comparisons left in a folder, read back.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "common/io/csv.hpp"

namespace galet::report {

/// The files of one engine's run.
struct EngineRun {
  std::string engine;              ///< "md" or "cd"
  nlohmann::ordered_json summary;  ///< md_summary.json
  std::optional<NumberTable> series, profile, forces, gaps, voronoi, directions;
  std::string picture;     ///< sample_md.svg, whole; empty: there is none
  std::string checkpoint;  ///< path; empty: there is none
};

struct RunFolder {
  std::string path;
  std::vector<EngineRun> runs;
  nlohmann::ordered_json comparison;                          ///< compare.json; null: there is none
  std::vector<std::pair<std::string, std::uintmax_t>> files;  ///< names and bytes, by name
};

/// Throws InputError when the folder can't be read, holds no results, or holds damaged ones.
RunFolder read_run_folder(const std::string& path);

/// A number of a summary, NaN where it is null or absent.
double number(const nlohmann::ordered_json& json, const std::string& key);

/// A text of a summary, empty where it is absent.
std::string text(const nlohmann::ordered_json& json, const std::string& key);

}  // namespace galet::report
