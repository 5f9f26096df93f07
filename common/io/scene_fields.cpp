#include "common/io/scene_fields.hpp"

#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "common/core/near_match.hpp"

namespace galet {

std::string to_string(const Interval& interval) {
  const bool below = std::isfinite(interval.low);
  const bool above = std::isfinite(interval.high);
  if (below && above)
    return fmt::format("in {}{}, {}{}", interval.low_open ? '(' : '[', interval.low, interval.high,
                       interval.high_open ? ')' : ']');
  if (below) return fmt::format("{} {}", interval.low_open ? ">" : ">=", interval.low);
  if (above) return fmt::format("{} {}", interval.high_open ? "<" : "<=", interval.high);
  return "";
}

const SceneField* find_field(std::string_view path) {
  for (const SceneField& field : scene_fields())
    if (field.path == path) return &field;
  return nullptr;
}

const SceneSection* find_section(std::string_view name) {
  for (const SceneSection& section : scene_sections())
    if (section.name == name) return &section;
  return nullptr;
}

std::string_view parent_path(std::string_view path) {
  const auto dot = path.rfind('.');
  return dot == std::string_view::npos ? std::string_view() : path.substr(0, dot);
}

std::string_view last_key(std::string_view path) {
  const auto dot = path.rfind('.');
  return dot == std::string_view::npos ? path : path.substr(dot + 1);
}

std::string table_name(std::string_view path) {
  if (path.empty()) return "the top of the file";
  const SceneSection* section = find_section(path);
  const bool list = section != nullptr && section->list;
  return list ? fmt::format("[[{}]]", path) : fmt::format("[{}]", path);
}

namespace {

std::string with_range(std::string noun, const Interval& range) {
  const std::string bounds = to_string(range);
  return bounds.empty() ? noun : noun + ' ' + bounds;
}

/// "a length" -> "lengths".
std::string plural(Quantity quantity) {
  std::string noun = with_article(quantity);
  noun.erase(0, noun.find(' ') + 1);
  if (noun.ends_with('y')) return noun.substr(0, noun.size() - 1) + "ies";
  if (noun.ends_with("ss")) return noun + "es";
  return noun + 's';
}

/// What a field of each type expects.
struct ExpectedOf {
  const SceneField& field;

  std::string operator()(bool*) const { return "true or false"; }
  std::string operator()(int*) const { return whole_number(); }
  std::string operator()(std::uint64_t*) const { return whole_number(); }
  std::string operator()(double*) const { return with_range(with_article(field.quantity), field.range); }
  std::string operator()(std::optional<double>*) const { return (*this)(static_cast<double*>(nullptr)); }
  std::string operator()(std::string*) const { return "a string"; }
  std::string operator()(std::vector<bool>*) const { return "an array of true or false"; }
  std::string operator()(std::vector<std::string>*) const {
    return field.choices.empty() ? "an array of strings" : "an array of " + alternatives(in_quotes(field.choices));
  }
  std::string operator()(std::vector<double>*) const {
    const std::string array = "an array of " + with_range(plural(field.quantity), field.range);
    return field.number_too ? with_article(field.quantity) + " or " + array : array;
  }
  template <class Enum>
  std::string operator()(Enum*) const {
    return alternatives(in_quotes(field.choices));
  }

 private:
  std::string whole_number() const {
    const Interval& range = field.range;
    if (range.high == range.low + 1) return fmt::format("{} or {}", range.low, range.high);
    return with_range("a whole number", range);
  }
};

/// The value that a field of each type has in a default Scene.
struct DefaultOf {
  const SceneField& field;

  std::string operator()(const bool* value) const {
    return field.choices.empty() ? fmt::format("{}", *value) : chosen(*value ? 1 : 0);
  }
  std::string operator()(const int* value) const { return fmt::format("{}", *value); }
  std::string operator()(const std::uint64_t* value) const { return fmt::format("{}", *value); }
  std::string operator()(const double* value) const { return fmt::format("{}", *value); }
  std::string operator()(const std::string* text) const { return text->empty() ? "none" : in_quotes(*text); }
  std::string operator()(const std::optional<double>* value) const { return *value ? (*this)(&**value) : "none"; }
  std::string operator()(const std::vector<double>* values) const {
    return values->empty() ? "none" : fmt::format("{}", *values);
  }
  std::string operator()(const std::vector<bool>* values) const {
    return values->empty() ? "none" : fmt::format("{}", *values);
  }
  std::string operator()(const std::vector<std::string>* values) const {
    return values->empty() ? "none" : fmt::format("{}", *values);
  }
  template <class Enum>
  std::string operator()(const Enum* value) const {
    return chosen(static_cast<std::size_t>(*value));
  }

 private:
  std::string chosen(std::size_t index) const { return in_quotes(field.choices.at(index)); }
};

/// A default scene with one entry in each of its lists, for fields to point into.
Scene scene_with_entries() {
  Scene scene;
  for (const SceneSection& section : scene_sections())
    if (section.list) section.append(scene);
  return scene;
}

}  // namespace

std::string expected(const SceneField& field) {
  Scene scene = scene_with_entries();
  const FieldTarget target = field.target(scene);
  if (!field.choices.empty() && !std::holds_alternative<std::vector<std::string>*>(target))
    return alternatives(in_quotes(field.choices));
  return std::visit(ExpectedOf{field}, target);
}

std::string expected_item(const SceneField& field) {
  Scene scene = scene_with_entries();
  const FieldTarget target = field.target(scene);
  if (std::holds_alternative<std::vector<bool>*>(target)) return "true or false";
  if (std::holds_alternative<std::vector<std::string>*>(target))
    return field.choices.empty() ? "a string" : alternatives(in_quotes(field.choices));
  return with_range(with_article(field.quantity), field.range);
}

std::string default_text(const SceneField& field) {
  if (field.required) return "needed";
  if (!field.fallback.empty()) return field.fallback;
  Scene scene = scene_with_entries();
  return std::visit([&field](const auto* value) { return DefaultOf{field}(value); }, field.target(scene));
}

}  // namespace galet
