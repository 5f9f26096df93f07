// Arguments that several subcommands share.
#pragma once

#include <string>
#include <vector>

#include "common/io/scene_file.hpp"
#include "common/scene/scene.hpp"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace galet::cli {

struct SceneArguments {
  std::string path;
  std::vector<std::string> changes;  ///< "a.b=c"
};

/// SCENE and --set; SCENE is required unless the caller relaxes the option that is returned.
CLI::Option* add_scene_arguments(CLI::App& app, SceneArguments& arguments);

/// Splits the --set arguments. Throws InputError naming each that has no "=".
std::vector<Override> overrides(const SceneArguments& arguments);

Scene load(const SceneArguments& arguments);

/// `given`, or out/<name of the scene file>; created when absent.
std::string output_directory(const std::string& given, const std::string& scene_path);

/// directory/name
std::string path_in(const std::string& directory, const std::string& name);

}  // namespace galet::cli
