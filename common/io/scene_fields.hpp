// The fields of a scene file: one table, from which the reader checks files and the scene reference is written.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "common/io/units.hpp"
#include "common/scene/scene.hpp"

namespace galet {

/// The values that a field may take.
struct Interval {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_open = false;
  bool high_open = false;

  bool contains(double x) const {
    return (low_open ? x > low : x >= low) && (high_open ? x < high : x <= high);  // false for NaN
  }
};

/// "> 0", "in [0, 1)"; empty for all numbers.
std::string to_string(const Interval& interval);

/// The member of a Scene that a field is stored in. Its type is the field's type.
using FieldTarget =
    std::variant<bool*, int*, std::uint64_t*, double*, std::optional<double>*, std::string*, std::vector<double>*,
                 std::vector<bool>*, std::vector<std::string>*, EngineKind*, SizeKind*, InitialKind*, LoadingKind*,
                 Axis*, DampingConvention*, NormalLaw*, CohesionLaw*, BodyShape*>;

struct SceneField {
  std::string path;                         ///< "grains.count"; without index in lists: "drive.rate"
  FieldTarget (*target)(Scene&) = nullptr;  ///< in lists: of the last entry
  std::string symbol = {};  ///< of the field's literature; a scene that uses it as a key is told the name
  Quantity quantity = Quantity::number;
  Interval range = {};                    ///< of each component
  std::vector<std::string> choices = {};  ///< words, in the order of the values of the enum
  bool required = false;                  ///< when its table is written
  bool number_too = false;                ///< an array of one component may be written as a number
  std::string fallback = {};              ///< the default in words, where the default Scene doesn't say it all
  std::string doc;
};

struct SceneSection {
  std::string name;   ///< "grains"; "" for the top of the file
  bool list = false;  ///< written [[name]], once per entry
  std::string doc;
  void (*append)(Scene&) = nullptr;  ///< lists: a new entry at the end
};

/// In the order of the reference.
const std::vector<SceneSection>& scene_sections();
const std::vector<SceneField>& scene_fields();

/// The field of that path, or null.
const SceneField* find_field(std::string_view path);

/// The section of that name, or null: then no table has this name.
const SceneSection* find_section(std::string_view name);

/// The path without its last key, and its last key: "grains.count" -> "grains", "count".
std::string_view parent_path(std::string_view path);
std::string_view last_key(std::string_view path);

/// "[grains]", "[[drive]]", "the top of the file": the table of that path in words.
std::string table_name(std::string_view path);

/// Type and range of a field in words: "a pressure > 0", "true or false", "an array of lengths > 0".
std::string expected(const SceneField& field);

/// The same for one item of an array.
std::string expected_item(const SceneField& field);

/// The default of a field as the reference shows it.
std::string default_text(const SceneField& field);

}  // namespace galet
