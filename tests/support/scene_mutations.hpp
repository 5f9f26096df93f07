// Scene files with random mistakes, and what must be true of each: it is refused with a message, or every value that it
// writes is the value that the scene has, so that no default stands where a file says something.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/core/random.hpp"
#include "common/io/scene_fields.hpp"
#include "common/io/scene_file.hpp"
#include "common/io/toml_tree.hpp"

namespace galet::test {

/// The texts of all .toml files of a folder, by name.
std::vector<std::string> scene_texts(const std::filesystem::path& folder);

/// One to four changes of the text: of letters, digits, words, lines, values; pieces of other texts; random bytes.
std::string mutated(const std::vector<std::string>& texts, RandomStream& random);

/// What a scene that was read from `text` has otherwise than the text says; empty: nothing.
std::vector<std::string> differences(const std::string& text, Scene scene);

struct MutationCounts {
  long read = 0;       ///< texts that were read as scenes
  long refused = 0;    ///< with at least one mistake, each with a message
  double slowest = 0;  ///< seconds of the slowest text
  std::string slowest_text;
  std::vector<std::string> complaints;  ///< what must not be, at most ten
};

/// Reads `count` mutations of the texts; the streams of random numbers are `first`, `first` + 1, ...
MutationCounts read_mutations(const std::vector<std::string>& texts, long first, long count);

}  // namespace galet::test
