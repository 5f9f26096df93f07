#include "common/io/toml_tree.hpp"

#include <charconv>
#include <cmath>
#include <optional>

#include <fmt/format.h>
#include <toml++/toml.h>

#include "common/core/error.hpp"
#include "common/core/near_match.hpp"

namespace galet {

namespace {

Place place_of(const toml::source_region& region, const std::string& name) {
  return {name, static_cast<int>(region.begin.line), static_cast<int>(region.begin.column)};
}

TreeNode copied(const toml::node& node, const std::string& name) {
  TreeNode copy;
  copy.place = place_of(node.source(), name);
  if (const toml::table* table = node.as_table()) {
    TreeNode::Table entries;
    for (const auto& [key, value] : *table)
      entries.push_back({std::string(key.str()), place_of(key.source(), name), copied(value, name)});
    copy.value = std::move(entries);
  } else if (const toml::array* array = node.as_array()) {
    TreeNode::List items;
    for (const toml::node& item : *array) items.push_back(copied(item, name));
    copy.value = std::move(items);
  } else if (const auto* truth = node.as_boolean()) {
    copy.value = truth->get();
  } else if (const auto* integer = node.as_integer()) {
    copy.value = std::int64_t{integer->get()};
  } else if (const auto* real = node.as_floating_point()) {
    copy.value = real->get();
  } else if (const auto* text = node.as_string()) {
    copy.value = text->get();
  }
  return copy;
}

std::string explained(std::string_view description) {
  std::string message = "TOML syntax: " + std::string(description);
  if (description.find("could not determine value type") != std::string_view::npos)
    message += " (text is written in double quotes)";
  return message;
}

/// The value after the = of --set. Nothing when `text` is not one TOML value.
std::optional<TreeNode> toml_value(const std::string& text, const std::string& label) {
  try {
    const toml::table document = toml::parse("value = " + text);
    // A line break in the text could smuggle in further keys.
    if (document.size() != 1) return std::nullopt;
    TreeNode node = copied(*document.get("value"), label);
    return node;
  } catch (const toml::parse_error&) {
    return std::nullopt;
  }
}

void set_place(TreeNode& node, const Place& place) {
  node.place = place;
  if (auto* items = node.list())
    for (TreeNode& item : *items) set_place(item, place);
  if (auto* entries = node.table())
    for (TreeEntry& entry : *entries) {
      entry.key_place = place;
      set_place(entry.node, place);
    }
}

TreeNode override_value(const std::string& text, const Place& place) {
  std::optional<TreeNode> node = toml_value(text, place.file);
  if (!node) {
    if (text.empty() || std::string_view("[{\"'").find(text.front()) != std::string_view::npos)
      throw InputError({{place.file, 0, 0, fmt::format("expected a value in TOML syntax, got {}", text)}});
    node.emplace();
    node->value = text;
  }
  set_place(*node, place);
  return *node;
}

/// One step of a path: "drive[0]" is key "drive" and index 0.
struct PathStep {
  std::string key;
  std::optional<std::size_t> index;
};

std::optional<PathStep> parse_step(const std::string& text) {
  PathStep step{text, std::nullopt};
  const auto open = text.find('[');
  if (open != std::string::npos) {
    std::size_t index = 0;
    const char* const last = text.data() + text.size();
    const auto [end, error] = std::from_chars(text.data() + open + 1, last, index);
    if (error != std::errc() || end + 1 != last || *end != ']') return std::nullopt;
    step = {text.substr(0, open), index};
  }
  return step.key.empty() ? std::nullopt : std::optional<PathStep>(step);
}

std::vector<PathStep> parse_path(const std::string& path, const Place& place) {
  std::vector<PathStep> steps;
  for (std::size_t begin = 0; begin <= path.size();) {
    const auto end = std::min(path.find('.', begin), path.size());
    const std::optional<PathStep> step = parse_step(path.substr(begin, end - begin));
    if (!step)
      throw InputError({{place.file, 0, 0, fmt::format("expected a path like grains.count, got \"{}\"", path)}});
    steps.push_back(*step);
    begin = end + 1;
  }
  return steps;
}

TreeNode& followed(TreeNode& node, const PathStep& step, const Place& place) {
  auto* entries = node.table();
  if (entries == nullptr)
    throw InputError({{place.file, 0, 0, fmt::format("no \"{}\" below {}", step.key, shown(node))}});
  TreeEntry* entry = find_entry(node, step.key);
  if (entry == nullptr) {
    if (step.index) throw InputError({{place.file, 0, 0, fmt::format("the scene has no [[{}]] entry", step.key)}});
    entries->push_back({step.key, place, {place, TreeNode::Table{}}});
    return entries->back().node;
  }
  if (!step.index) return entry->node;
  auto* items = entry->node.list();
  const std::size_t size = items == nullptr ? 0 : items->size();
  if (*step.index >= size)
    throw InputError(
        {{place.file, 0, 0,
          fmt::format("no {}[{}]: the number of [[{}]] entries is {}", step.key, *step.index, step.key, size)}});
  return (*items)[*step.index];
}

}  // namespace

TreeNode parse_toml(std::string_view text, const std::string& name) {
  try {
    TreeNode root = copied(toml::parse(text), name);
    root.place = {name, 1, 1};
    return root;
  } catch (const toml::parse_error& error) {
    const Place place = place_of(error.source(), name);
    throw InputError({{place.file, place.line, place.column, explained(error.description())}});
  }
}

void set_value(TreeNode& root, const std::string& path, const std::string& value) {
  const Place place{fmt::format("--set {}={}", path, value), 0, 0};
  TreeNode node = override_value(value, place);
  TreeNode* target = &root;
  for (const PathStep& step : parse_path(path, place)) target = &followed(*target, step, place);
  *target = std::move(node);
}

TreeEntry* find_entry(TreeNode& node, std::string_view key) {
  if (auto* entries = node.table())
    for (TreeEntry& entry : *entries)
      if (entry.key == key) return &entry;
  return nullptr;
}

std::string shown(const TreeNode& node) {
  struct Show {
    std::string operator()(std::monostate) const { return "a date or time"; }
    std::string operator()(bool truth) const { return truth ? "true" : "false"; }
    std::string operator()(std::int64_t integer) const { return fmt::format("{}", integer); }
    std::string operator()(double real) const {
      const std::string digits = fmt::format("{}", real);
      return digits.find_first_not_of("-0123456789") == std::string::npos ? digits + ".0" : digits;
    }
    std::string operator()(const std::string& text) const {
      if (text.size() <= 60) return in_quotes(text);
      std::size_t cut = 57;
      while ((static_cast<unsigned char>(text[cut]) & 0xC0u) == 0x80u) --cut;  // not inside a UTF-8 character
      return in_quotes(text.substr(0, cut) + "...");
    }
    std::string operator()(const TreeNode::List& items) const {
      return items.size() == 1 ? "an array of 1 value" : fmt::format("an array of {} values", items.size());
    }
    std::string operator()(const TreeNode::Table&) const { return "a table"; }
  };
  return std::visit(Show{}, node.value);
}

}  // namespace galet
