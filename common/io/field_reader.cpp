#include "common/io/field_reader.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "common/core/near_match.hpp"

namespace galet {

namespace {

/// Visits the target of a field: one overload per type that a field may have.
class FieldReader {
 public:
  FieldReader(const SceneField& field, const std::string& path, const TreeNode& node, const UnitContext& units)
      : field_(field), path_(path), node_(node), units_(units) {}

  void operator()(bool* target) {
    if (!field_.choices.empty()) {
      if (const std::optional<std::size_t> index = choice()) *target = *index != 0;
    } else if (const bool* truth = std::get_if<bool>(&node_.value)) {
      *target = *truth;
    } else {
      refuse(node_);
    }
  }
  void operator()(int* target) {
    if (const auto value = whole_number(std::numeric_limits<int>::max())) *target = static_cast<int>(*value);
  }
  void operator()(std::uint64_t* target) {
    if (const auto value = whole_number(std::numeric_limits<std::int64_t>::max()))
      *target = static_cast<std::uint64_t>(*value);
  }
  void operator()(double* target) {
    if (const auto value = number(node_)) *target = *value;
  }
  void operator()(std::optional<double>* target) {
    if (const auto value = number(node_)) *target = *value;
  }
  void operator()(std::string* target) {
    if (const std::string* text = node_.text())
      *target = *text;
    else
      refuse(node_);
  }
  void operator()(std::vector<double>* target);
  void operator()(std::vector<bool>* target);
  void operator()(std::vector<std::string>* target);
  template <class Enum>
  void operator()(Enum* target) {
    if (const std::optional<std::size_t> index = choice()) *target = static_cast<Enum>(*index);
  }

  std::vector<Mistake> take_mistakes() { return std::move(mistakes_); }

 private:
  std::optional<double> number(const TreeNode& node);
  std::optional<double> number_with_unit(const TreeNode& node, const std::string& text);
  std::optional<std::int64_t> whole_number(std::int64_t largest);
  std::optional<std::size_t> choice();

  /// `node` is the field's value or, for arrays, one item of it.
  void refuse(const TreeNode& node, const std::string& hint = "") {
    refuse(node, &node == &node_ ? expected(field_) : expected_item(field_), hint);
  }
  void refuse(const TreeNode& node, const std::string& what, const std::string& hint) {
    const Place& place = node.place;
    mistakes_.push_back({place.file, place.line, place.column,
                         fmt::format("{}: expected {}, got {}{}", path_, what, shown(node), hint)});
  }

  const SceneField& field_;
  const std::string& path_;
  const TreeNode& node_;
  const UnitContext& units_;
  std::vector<Mistake> mistakes_;
};

void FieldReader::operator()(std::vector<double>* target) {
  std::vector<double> values;
  if (const auto* items = node_.list()) {
    for (const TreeNode& item : *items)
      if (const auto value = number(item)) values.push_back(*value);
  } else if (field_.number_too && node_.table() == nullptr) {
    if (const auto value = number(node_)) values.push_back(*value);
  } else {
    refuse(node_);
  }
  if (mistakes_.empty()) *target = std::move(values);
}

void FieldReader::operator()(std::vector<bool>* target) {
  const auto* items = node_.list();
  if (items == nullptr) return refuse(node_);
  std::vector<bool> values;
  for (const TreeNode& item : *items) {
    if (const bool* truth = std::get_if<bool>(&item.value))
      values.push_back(*truth);
    else
      refuse(item);
  }
  if (mistakes_.empty()) *target = std::move(values);
}

void FieldReader::operator()(std::vector<std::string>* target) {
  const auto* items = node_.list();
  if (items == nullptr) return refuse(node_);
  std::vector<std::string> values;
  for (const TreeNode& item : *items) {
    const std::string* text = item.text();
    const std::vector<std::string>& known = field_.choices;
    if (text != nullptr && (known.empty() || std::find(known.begin(), known.end(), *text) != known.end()))
      values.push_back(*text);
    else
      refuse(item, text == nullptr || known.empty() ? "" : suggestion(*text, known));
  }
  if (mistakes_.empty()) *target = std::move(values);
}

std::optional<double> FieldReader::number(const TreeNode& node) {
  std::optional<double> value;
  if (const auto* integer = std::get_if<std::int64_t>(&node.value)) value = static_cast<double>(*integer);
  if (const auto* real = std::get_if<double>(&node.value)) value = *real;
  if (const std::string* text = node.text()) {
    value = number_with_unit(node, *text);
    if (!value) return std::nullopt;
  }
  if (value && std::isfinite(*value) && field_.range.contains(*value)) return value;
  refuse(node, value && !std::isfinite(*value) ? ", which is not finite" : "");
  return std::nullopt;
}

std::optional<double> FieldReader::number_with_unit(const TreeNode& node, const std::string& text) {
  const Quantity quantity = field_.quantity;
  if (quantity == Quantity::number) {
    const bool digits = text.find_first_of("0123456789") == 0;
    refuse(node, digits ? " (this field has no unit: leave out the quotes)" : "");
    return std::nullopt;
  }
  if (units_.reduced) {
    refuse(node, "; values with units need units = \"SI\" at the top of the file");
    return std::nullopt;
  }
  const std::vector<int> dimensions = units_.dimension ? std::vector<int>{*units_.dimension} : std::vector<int>{2, 3};
  for (const int dimension : dimensions)
    if (const auto value = value_with_unit(text, quantity, dimension)) return value;
  const int dimension = dimensions.front();
  const std::optional<std::string> meant = near_unit(text, quantity, dimension);
  refuse(node, expected_units(quantity, dimension), meant ? "; did you mean " + in_quotes(*meant) + "?" : "");
  return std::nullopt;
}

std::optional<std::int64_t> FieldReader::whole_number(std::int64_t largest) {
  const auto* value = std::get_if<std::int64_t>(&node_.value);
  if (value != nullptr && *value > largest) {
    refuse(node_, fmt::format(", above the largest possible, {}", largest));
    return std::nullopt;
  }
  if (value == nullptr || !field_.range.contains(static_cast<double>(*value))) {
    refuse(node_);
    return std::nullopt;
  }
  return *value;
}

std::optional<std::size_t> FieldReader::choice() {
  const std::string* word = node_.text();
  if (word != nullptr) {
    const auto found = std::find(field_.choices.begin(), field_.choices.end(), *word);
    if (found != field_.choices.end()) return static_cast<std::size_t>(found - field_.choices.begin());
  }
  refuse(node_, word == nullptr ? "" : suggestion(*word, field_.choices));
  return std::nullopt;
}

}  // namespace

std::vector<Mistake> read_field(const SceneField& field, const std::string& path, const TreeNode& node,
                                const UnitContext& units, Scene& scene) {
  FieldReader reader(field, path, node, units);
  std::visit(reader, field.target(scene));
  return reader.take_mistakes();
}

}  // namespace galet
