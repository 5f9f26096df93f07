// A TOML document as plain data with the place of every key and value. The only part of the library that knows
// the TOML parser.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace galet {

/// Where something was written: a file, or the --set option that gave it (then line = 0).
struct Place {
  std::string file;
  int line = 0;
  int column = 0;
};

struct TreeEntry;

struct TreeNode {
  using List = std::vector<TreeNode>;
  using Table = std::vector<TreeEntry>;
  /// std::monostate stands for dates and times, which no scene has.
  using Value = std::variant<std::monostate, bool, std::int64_t, double, std::string, List, Table>;

  Place place;
  Value value;

  const Table* table() const { return std::get_if<Table>(&value); }
  const List* list() const { return std::get_if<List>(&value); }
  Table* table() { return std::get_if<Table>(&value); }
  List* list() { return std::get_if<List>(&value); }
  const std::string* text() const { return std::get_if<std::string>(&value); }
};

struct TreeEntry {
  std::string key;
  Place key_place;
  TreeNode node;
};

/// The document's root table. Throws InputError, with the place, when `text` is not TOML.
TreeNode parse_toml(std::string_view text, const std::string& name);

/// Sets root.path, as if the document had `path = value` there, creating the tables that lead to it; entries of a
/// list of tables are reached as "drive[0].rate". A value that is not TOML counts as a string if it starts like a
/// bare word. Throws InputError when the path can't be followed.
void set_value(TreeNode& root, const std::string& path, const std::string& value);

/// The entry of a table, or null.
TreeEntry* find_entry(TreeNode& table, std::string_view key);

/// The value as a message shows it: as written for numbers, quoted (and cut when long) for strings.
std::string shown(const TreeNode& node);

}  // namespace galet
