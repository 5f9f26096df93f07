// Bad scenes and the messages that they must give, for the tests of the reader and of the rules.
#pragma once

#include <ostream>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "common/core/error.hpp"
#include "common/io/scene_file.hpp"

namespace galet::test {

struct BadScene {
  std::string name;
  std::string text;
  std::vector<std::string> expected;  ///< "line:column: message", all of them, in the order of the file

  /// The name only: ctest reads the list of tests, and brackets of a text would confuse it.
  friend std::ostream& operator<<(std::ostream& out, const BadScene& scene) { return out << scene.name; }
};

/// "line:column: message" of each mistake of a text.
inline std::vector<std::string> mistakes_of(const std::string& text, const std::vector<Override>& overrides = {}) {
  std::vector<std::string> found;
  try {
    parse_scene(text, "test.toml", overrides);
  } catch (const InputError& error) {
    for (const Mistake& mistake : error.mistakes())
      found.push_back(fmt::format("{}:{}: {}", mistake.line, mistake.column, mistake.message));
  }
  return found;
}

/// A sound scene in the shortest form: a text that follows starts in line 5.
inline const std::string sound = R"(grains.count = 10
material.restitution = 0.5
material.normal_stiffness = 1e4
run.duration = 1
)";

}  // namespace galet::test
