#include "src/commands/arguments.hpp"

#include <filesystem>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "common/core/error.hpp"

namespace galet::cli {

namespace fs = std::filesystem;

CLI::Option* add_scene_arguments(CLI::App& app, SceneArguments& arguments) {
  app.add_option("--set", arguments.changes, "change one field of the scene, e.g. --set run.strain=5 (repeatable)")
      ->type_name("FIELD=VALUE")
      ->allow_extra_args(false);
  return app.add_option("SCENE", arguments.path, "scene file (TOML)")->required();
}

std::vector<Override> overrides(const SceneArguments& arguments) {
  std::vector<Override> parsed;
  std::vector<Mistake> mistakes;
  for (const std::string& change : arguments.changes) {
    const std::size_t equals = change.find('=');
    if (equals == std::string::npos || equals == 0 || change.find('\n') != std::string::npos)
      mistakes.push_back({"", 0, 0, fmt::format("--set {}: expected FIELD=VALUE, e.g. run.strain=5", change)});
    else
      parsed.push_back({change.substr(0, equals), change.substr(equals + 1)});
  }
  if (!mistakes.empty()) throw InputError(mistakes);
  return parsed;
}

Scene load(const SceneArguments& arguments) { return read_scene(arguments.path, overrides(arguments)); }

std::string output_directory(const std::string& given, const std::string& scene_path) {
  const fs::path directory = given.empty() ? fs::path("out") / fs::path(scene_path).stem() : fs::path(given);
  std::error_code error;
  fs::create_directories(directory, error);
  if (!fs::is_directory(directory))
    throw InputError(fmt::format("--out {}: can't make this folder: {}", directory.string(), error.message()));
  return directory.string();
}

std::string path_in(const std::string& directory, const std::string& name) {
  return (fs::path(directory) / name).string();
}

}  // namespace galet::cli
