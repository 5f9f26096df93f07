// Scenes from TOML files. Keys are strict: an unknown, missing, mistyped or out-of-range field is an error with
// file, line and column, what was expected and a near match; all mistakes of a file are reported together.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "common/scene/scene.hpp"

namespace galet {

/// A change made on the command line: --set path=value, value in TOML syntax (a bare word counts as a string).
/// Entries of lists are reached by their index: "drive[0].rate".
struct Override {
  std::string path;
  std::string value;
};

/// Reads, checks and returns the scene of a file. Throws InputError with every mistake; one that an override made
/// is placed at "--set path=value".
Scene read_scene(const std::string& path, const std::vector<Override>& overrides = {});

/// The same for a text; `name` stands for the file in messages. Scene::directory stays empty, and whether a packing
/// file exists is left to whoever reads it.
Scene parse_scene(std::string_view text, const std::string& name, const std::vector<Override>& overrides = {});

/// The scene reference of the documentation, in Markdown, made from the table that the reader itself uses.
std::string scene_reference();

}  // namespace galet
