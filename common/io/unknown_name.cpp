#include "common/io/unknown_name.hpp"

#include <fmt/format.h>

#include "common/core/near_match.hpp"
#include "common/io/scene_fields.hpp"

namespace galet {

namespace {

std::vector<std::string> keys_of(const std::string& section) {
  std::vector<std::string> keys;
  for (const SceneField& field : scene_fields())
    if (parent_path(field.path) == section) keys.emplace_back(last_key(field.path));
  return keys;
}

/// The field of the table that has this symbol in the literature ("kappa").
std::vector<std::string> fields_of_symbol(const std::string& symbol, const std::string& section) {
  for (const SceneField& field : scene_fields())
    if (parent_path(field.path) == section && field.symbol == symbol) return {field.path};
  return {};
}

std::vector<std::string> fields_elsewhere(const std::string& key) {
  std::vector<std::string> paths;
  for (const SceneField& field : scene_fields())
    if (last_key(field.path) == key) paths.push_back(field.path);
  return paths;
}

std::string path_of(const std::string& key, const std::string& section) {
  return section.empty() ? key : section + '.' + key;
}

}  // namespace

UnknownName explain_unknown_key(const std::string& key, const std::string& section) {
  const std::string start =
      fmt::format("unknown name {} {} {}", in_quotes(key), section.empty() ? "at" : "in", table_name(section));
  if (const auto fields = fields_of_symbol(key, section); !fields.empty())
    return {fmt::format("{}; did you mean {}?", start, in_quotes(last_key(fields.front()))), fields};
  if (const auto fields = fields_elsewhere(key); !fields.empty()) {
    std::vector<std::string> tables;
    for (const std::string& path : fields) tables.push_back(table_name(parent_path(path)));
    return {fmt::format("{}; it belongs to {}", start, alternatives(tables)), fields};
  }
  const std::vector<std::string> keys = keys_of(section);
  if (const auto meant = near_match(key, keys))
    return {fmt::format("{}; did you mean {}?", start, in_quotes(*meant)), {path_of(*meant, section)}};
  return {fmt::format("{}; expected {}", start, alternatives(keys)), {}};
}

UnknownName explain_unknown_table(const std::string& name, bool list) {
  const std::string start = fmt::format("unknown table {}", list ? "[[" + name + "]]" : '[' + name + ']');
  std::vector<std::string> names;
  std::vector<std::string> tables;
  for (const SceneSection& section : scene_sections()) {
    if (section.name.empty() || !parent_path(section.name).empty()) continue;
    names.push_back(section.name);
    tables.push_back(table_name(section.name));
  }
  if (const auto meant = near_match(name, names))
    return {fmt::format("{}; did you mean {}?", start, table_name(*meant)), {*meant}};
  return {fmt::format("{}; expected {}", start, alternatives(tables)), {}};
}

}  // namespace galet
