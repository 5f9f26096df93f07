#include "common/io/scene_file.hpp"

#include <algorithm>
#include <filesystem>
#include <map>
#include <tuple>

#include <fmt/format.h>

#include "common/core/error.hpp"
#include "common/core/near_match.hpp"
#include "common/io/field_reader.hpp"
#include "common/io/files.hpp"
#include "common/io/scene_fields.hpp"
#include "common/io/scene_presence.hpp"
#include "common/io/toml_tree.hpp"
#include "common/io/unknown_name.hpp"
#include "common/scene/body_shapes.hpp"
#include "common/scene/check.hpp"

namespace galet {

namespace {

std::string joined(const std::string& path, const std::string& key) { return path.empty() ? key : path + '.' + key; }

/// True when one path is the other or leads to it: "drive" and "drive[0].rate".
bool related(const std::string& a, const std::string& b) {
  const std::string& shorter = a.size() < b.size() ? a : b;
  const std::string& longer = a.size() < b.size() ? b : a;
  if (!longer.starts_with(shorter)) return false;
  return longer.size() == shorter.size() || longer[shorter.size()] == '.' || longer[shorter.size()] == '[';
}

/// From a tree to a scene and the list of its mistakes.
class SceneReader {
 public:
  explicit SceneReader(const TreeNode& root) {
    places_[""] = root.place;
    read_table(root, "", "");
  }

  Scene& scene() { return scene_; }
  bool written(const std::string& path) const { return places_.count(path) > 0; }
  void add_findings(const std::vector<Finding>& findings);
  const std::vector<Mistake>& mistakes() const { return mistakes_; }

 private:
  // `section` is the table's name in the field table, `path` its name in this file: "drive" and "drive[0]".
  void read_table(const TreeNode& table, const std::string& section, const std::string& path);
  void read_entry(const TreeEntry& entry, const std::string& section, const std::string& path);
  void read_list(const TreeEntry& entry, const SceneSection& section, const std::string& here);
  void read_value(const SceneField& field, const TreeNode& node, const std::string& path);
  void require_fields(const TreeNode& table, const std::string& section, const std::string& path);
  void refuse_unknown(const TreeEntry& entry, const std::string& section, const std::string& path);
  void refuse(const Place& place, const std::string& path, const std::string& message);
  const Place& place_of(std::string path) const;
  bool says_nothing_new(const Finding& finding) const;

  Scene scene_;
  UnitContext units_{.reduced = true, .dimension = 2};
  std::map<std::string, Place> places_;
  std::vector<std::string> refused_;  ///< paths whose value was refused or can't be known
  std::vector<Mistake> mistakes_;
};

void SceneReader::refuse(const Place& place, const std::string& path, const std::string& message) {
  refused_.push_back(path);
  mistakes_.push_back({place.file, place.line, place.column, message});
}

void SceneReader::read_table(const TreeNode& table, const std::string& section, const std::string& path) {
  // Values before tables: the units of all tables depend on two values at the top.
  const auto is_value = [](const TreeEntry& entry) {
    return entry.node.table() == nullptr && entry.node.list() == nullptr;
  };
  for (const TreeEntry& entry : *table.table())
    if (is_value(entry)) read_entry(entry, section, path);
  for (const TreeEntry& entry : *table.table())
    if (!is_value(entry)) read_entry(entry, section, path);
  require_fields(table, section, path);
}

void SceneReader::read_entry(const TreeEntry& entry, const std::string& section, const std::string& path) {
  const std::string name = joined(section, entry.key);
  const std::string here = joined(path, entry.key);
  const SceneSection* table = find_section(name);
  const SceneField* field = find_field(name);
  if (table == nullptr && field == nullptr) return refuse_unknown(entry, section, path);
  places_[here] = entry.node.place;
  if (table != nullptr && table->list) return read_list(entry, *table, here);
  if (table != nullptr && entry.node.table() != nullptr) return read_table(entry.node, name, here);
  if (field != nullptr) return read_value(*field, entry.node, here);
  const bool list = entry.node.list() != nullptr;
  refuse(entry.key_place, here,
         fmt::format("{}: expected a table [{}], got {}", name, name,
                     list ? "a list: write it once, with single brackets" : shown(entry.node)));
}

void SceneReader::read_list(const TreeEntry& entry, const SceneSection& section, const std::string& here) {
  const auto* items = entry.node.list();
  if (items == nullptr)
    return refuse(entry.key_place, here,
                  fmt::format("{}: expected [[{}]] entries, got {}: write [[{}]] with double brackets", here,
                              section.name, shown(entry.node), section.name));
  for (std::size_t k = 0; k < items->size(); ++k) {
    const TreeNode& item = (*items)[k];
    const std::string path = fmt::format("{}[{}]", here, k);
    places_[path] = item.place;
    section.append(scene_);
    if (item.table() != nullptr)
      read_table(item, section.name, path);
    else
      refuse(item.place, path, fmt::format("{}: expected a table, got {}", path, shown(item)));
  }
}

void SceneReader::read_value(const SceneField& field, const TreeNode& node, const std::string& path) {
  const std::vector<Mistake> mistakes = read_field(field, path, node, units_, scene_);
  mistakes_.insert(mistakes_.end(), mistakes.begin(), mistakes.end());
  const bool refused = !mistakes.empty();
  if (refused) refused_.push_back(path);
  if (path == "dimension") units_.dimension = refused ? std::nullopt : std::optional<int>(scene_.dimension);
  if (path == "units") units_.reduced = !refused && scene_.reduced_units;
}

void SceneReader::require_fields(const TreeNode& table, const std::string& section, const std::string& path) {
  for (const SceneField& field : scene_fields()) {
    if (!field.required || parent_path(field.path) != section) continue;
    const std::string here = joined(path, std::string(last_key(field.path)));
    // A misspelt key has been refused in its stead.
    if (written(here) || std::find(refused_.begin(), refused_.end(), here) != refused_.end()) continue;
    refuse(table.place, here, fmt::format("{} is needed: {}", here, expected(field)));
  }
}

void SceneReader::refuse_unknown(const TreeEntry& entry, const std::string& section, const std::string& path) {
  const auto* items = entry.node.list();
  const bool list = items != nullptr && !items->empty() && items->front().table() != nullptr;
  const bool table = list || entry.node.table() != nullptr;
  const UnknownName unknown =
      table && section.empty() ? explain_unknown_table(entry.key, list) : explain_unknown_key(entry.key, section);
  refuse(entry.key_place, joined(path, entry.key), unknown.message);
  for (const std::string& meant : unknown.meant) {
    const bool same_table = parent_path(meant) == section;
    refused_.push_back(same_table ? joined(path, std::string(last_key(meant))) : meant);
  }
}

const Place& SceneReader::place_of(std::string path) const {
  while (!written(path)) {
    const auto cut = path.find_last_of(".[");
    path.erase(cut == std::string::npos ? 0 : cut);
  }
  return places_.at(path);
}

bool SceneReader::says_nothing_new(const Finding& finding) const {
  return std::any_of(refused_.begin(), refused_.end(), [&finding](const std::string& refused) {
    return related(refused, finding.path) ||
           std::any_of(finding.reads.begin(), finding.reads.end(),
                       [&refused](const std::string& path) { return related(refused, path); });
  });
}

void SceneReader::add_findings(const std::vector<Finding>& findings) {
  for (const Finding& finding : findings) {
    if (says_nothing_new(finding)) continue;
    const Place& place = place_of(finding.path);
    mistakes_.push_back({place.file, place.line, place.column, finding.message});
  }
}

/// The tree of the text with the overrides in it. Overrides that can't be made add to `mistakes`.
TreeNode overridden_tree(std::string_view text, const std::string& name, const std::vector<Override>& overrides,
                         std::vector<Mistake>& mistakes) {
  TreeNode root = parse_toml(text, name);
  for (const Override& change : overrides) {
    try {
      set_value(root, change.path, change.value);
    } catch (const InputError& error) {
      mistakes.insert(mistakes.end(), error.mistakes().begin(), error.mistakes().end());
    }
  }
  return root;
}

/// What a default depends on is known only once the whole file is read.
void complete(Scene& scene, const SceneReader& reader) {
  if (!reader.written("initial.kind") && !scene.grains.listed.empty()) scene.initial.kind = InitialKind::listed;
  const bool gas = scene.initial.kind == InitialKind::gas || scene.initial.kind == InitialKind::compressed_gas;
  if (!reader.written("initial.solid_fraction") && gas && scene.dimension == 3) scene.initial.solid_fraction = 0.3;
}

bool names_field(const std::vector<Finding>& findings, const std::string& path) {
  return std::any_of(findings.begin(), findings.end(), [&path](const Finding& found) { return found.path == path; });
}

std::vector<Finding> check_initial_file(const Scene& scene) {
  const bool from_file = scene.initial.kind == InitialKind::packing || scene.initial.kind == InitialKind::checkpoint;
  if (!from_file || scene.initial.file.empty()) return {};
  const std::filesystem::path file = std::filesystem::path(scene.directory) / scene.initial.file;
  std::error_code error;
  if (std::filesystem::is_regular_file(file, error)) return {};
  return {{"initial.file", fmt::format("initial.file: no file \"{}\"", file.string()), {"initial.kind"}}};
}

/// `directory` is empty for a text without a file.
Scene read(std::string_view text, const std::string& name, const std::string& directory,
           const std::vector<Override>& overrides) {
  std::vector<Mistake> mistakes;
  const TreeNode root = overridden_tree(text, name, overrides, mistakes);
  SceneReader reader(root);
  Scene& scene = reader.scene();
  scene.source = text;
  scene.directory = directory;
  complete(scene, reader);
  reader.add_findings(check_presence(scene, [&reader](const std::string& path) { return reader.written(path); }));
  const std::vector<Finding> findings = check(scene);
  reader.add_findings(findings);
  if (!directory.empty() && !names_field(findings, "initial.file")) reader.add_findings(check_initial_file(scene));
  mistakes.insert(mistakes.end(), reader.mistakes().begin(), reader.mistakes().end());
  std::stable_sort(mistakes.begin(), mistakes.end(), [](const Mistake& a, const Mistake& b) {
    return std::tie(a.line, a.column) < std::tie(b.line, b.column);
  });
  if (!mistakes.empty()) throw InputError(std::move(mistakes));
  return with_bodies_apart(std::move(scene));
}

}  // namespace

Scene read_scene(const std::string& path, const std::vector<Override>& overrides) {
  const std::string folder = std::filesystem::path(path).parent_path().string();
  return read(read_file(path), path, folder.empty() ? "." : folder, overrides);
}

Scene parse_scene(std::string_view text, const std::string& name, const std::vector<Override>& overrides) {
  return read(text, name, "", overrides);
}

}  // namespace galet
