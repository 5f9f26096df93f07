#include "tests/support/scene_mutations.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "common/core/clock.hpp"
#include "common/core/error.hpp"
#include "common/io/files.hpp"

namespace galet::test {

namespace {

constexpr std::uint64_t seed = 20250;

/// Values that a careless hand, or a hostile one, may write.
constexpr std::array values = {"-1",
                               "0",
                               "-0.0",
                               "1e308",
                               "1e-320",
                               "1e999",
                               "nan",
                               "-inf",
                               "0x1f",
                               "1_000",
                               "9223372036854775807",
                               "99999999999999999999",
                               "2147483648",
                               "true",
                               "\"\"",
                               "\"10 kPa\"",
                               "\"md\"",
                               "\"none\"",
                               "'''a\nb'''",
                               "[]",
                               "{}",
                               "[1, \"2\"]",
                               "[1, 2, 3, 4]",
                               "[[1], [2]]",
                               "[true, false]",
                               "{mean = 1, spread = 0.5}",
                               "1979-05-27",
                               "12:30:00",
                               "\"\\u0000\"",
                               "1e"};

std::size_t below(RandomStream& random, std::size_t count) {
  return std::min(count - 1, static_cast<std::size_t>(random.uniform() * static_cast<double>(count)));
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  for (const std::string_view line : split_lines(text)) lines.emplace_back(line);
  if (lines.empty()) lines.emplace_back();
  return lines;
}

std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + '\n';
  return text;
}

/// A change of letters anywhere.
void change_letters(std::string& text, RandomStream& random) {
  if (text.empty()) return;
  const std::size_t place = below(random, text.size());
  switch (below(random, 6)) {
    case 0:
      text[place] = static_cast<char>(0x20 + below(random, 95));
      break;
    case 1:
      text.erase(place, 1 + below(random, 8));
      break;
    case 2:
      text.insert(place, 1, static_cast<char>(below(random, 256)));
      break;
    case 3:
      text[place] = static_cast<char>(text[place] ^ (1 << below(random, 8)));
      break;
    case 4:
      if (place + 1 < text.size()) std::swap(text[place], text[place + 1]);
      break;
    default:
      text.resize(place);
  }
}

/// A change of whole lines.
void change_lines(std::string& text, const std::vector<std::string>& texts, RandomStream& random) {
  std::vector<std::string> lines = lines_of(text);
  const std::size_t place = below(random, lines.size());
  const auto at = lines.begin() + static_cast<std::ptrdiff_t>(place);
  switch (below(random, 5)) {
    case 0:
      lines.erase(at);
      break;
    case 1:
      lines.insert(at, lines[below(random, lines.size())]);
      break;
    case 2:
      std::swap(*at, lines[below(random, lines.size())]);
      break;
    case 3: {
      const std::vector<std::string> others = lines_of(texts[below(random, texts.size())]);
      lines.insert(at, others[below(random, others.size())]);
      break;
    }
    default:
      lines.insert(at, std::string(1 + below(random, 400), "[{"[below(random, 2)]));
  }
  text = joined(lines);
}

/// Another value behind a key, or a key with a wrong letter.
void change_entry(std::string& text, RandomStream& random) {
  std::vector<std::string> lines = lines_of(text);
  std::vector<std::size_t> entries;
  for (std::size_t k = 0; k < lines.size(); ++k)
    if (lines[k].find('=') != std::string::npos && !lines[k].starts_with('#')) entries.push_back(k);
  if (entries.empty()) return;
  std::string& line = lines[entries[below(random, entries.size())]];
  const std::size_t equals = line.find('=');
  if (below(random, 4) == 0 && equals > 0)
    line[below(random, equals)] = static_cast<char>('a' + below(random, 26));
  else
    line = line.substr(0, equals + 1) + " " + values[below(random, values.size())];
  text = joined(lines);
}

/// A digit becomes another one: most of these files stay sound, with another value.
void change_digit(std::string& text, RandomStream& random) {
  std::vector<std::size_t> digits;
  for (std::size_t k = 0; k < text.size(); ++k)
    if (text[k] >= '0' && text[k] <= '9') digits.push_back(k);
  if (!digits.empty()) text[digits[below(random, digits.size())]] = static_cast<char>('0' + below(random, 10));
}

}  // namespace

std::vector<std::string> scene_texts(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> paths;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().extension() == ".toml") paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end());
  std::vector<std::string> texts;
  for (const auto& path : paths) texts.push_back(read_file(path.string()));
  return texts;
}

std::string mutated(const std::vector<std::string>& texts, RandomStream& random) {
  std::string text = texts[below(random, texts.size())];
  const std::size_t changes = 1 + below(random, 4);
  for (std::size_t k = 0; k < changes; ++k) switch (below(random, 4)) {
      case 0:
        change_letters(text, random);
        break;
      case 1:
        change_lines(text, texts, random);
        break;
      case 2:
        change_entry(text, random);
        break;
      default:
        change_digit(text, random);
    }
  return text;
}

namespace {

/// Compares a node of the file with the member of the scene that its field is stored in.
struct SameValue {
  const SceneField& field;
  const TreeNode& node;
  int dimension;

  std::optional<double> number_of(const TreeNode& from) const {
    if (const auto* whole = std::get_if<std::int64_t>(&from.value)) return static_cast<double>(*whole);
    if (const auto* real = std::get_if<double>(&from.value)) return *real;
    if (const std::string* text = from.text()) return value_with_unit(*text, field.quantity, dimension);
    return std::nullopt;
  }
  /// The index of the word among the field's choices.
  std::optional<std::size_t> choice() const {
    const std::string* text = node.text();
    if (text == nullptr) return std::nullopt;
    const auto found = std::find(field.choices.begin(), field.choices.end(), *text);
    if (found == field.choices.end()) return std::nullopt;
    return static_cast<std::size_t>(found - field.choices.begin());
  }
  template <class Number>
  bool same_number(Number value) const {
    return number_of(node) == static_cast<double>(value);
  }
  bool operator()(const bool* value) const {
    if (!field.choices.empty()) return choice() && (*choice() != 0) == *value;
    const bool* written = std::get_if<bool>(&node.value);
    return written != nullptr && *written == *value;
  }
  bool operator()(const int* value) const { return same_number(*value); }
  bool operator()(const std::uint64_t* value) const { return same_number(*value); }
  bool operator()(const double* value) const { return same_number(*value); }
  bool operator()(const std::optional<double>* value) const { return value->has_value() && same_number(**value); }
  bool operator()(const std::string* value) const { return node.text() != nullptr && *node.text() == *value; }
  bool operator()(const std::vector<double>* value) const {
    const auto* items = node.list();
    if (items == nullptr) return field.number_too && value->size() == 1 && same_number(value->front());
    if (items->size() != value->size()) return false;
    for (std::size_t k = 0; k < items->size(); ++k)
      if (number_of((*items)[k]) != (*value)[k]) return false;
    return true;
  }
  bool operator()(const std::vector<bool>* value) const {
    const auto* items = node.list();
    if (items == nullptr || items->size() != value->size()) return false;
    for (std::size_t k = 0; k < items->size(); ++k) {
      const bool* written = std::get_if<bool>(&(*items)[k].value);
      if (written == nullptr || *written != (*value)[k]) return false;
    }
    return true;
  }
  bool operator()(const std::vector<std::string>* value) const {
    const auto* items = node.list();
    if (items == nullptr) return node.text() != nullptr && value->size() == 1 && value->front() == *node.text();
    if (items->size() != value->size()) return false;
    for (std::size_t k = 0; k < items->size(); ++k)
      if ((*items)[k].text() == nullptr || *(*items)[k].text() != (*value)[k]) return false;
    return true;
  }
  template <class Enum>
  bool operator()(const Enum* value) const {
    return choice() && *choice() == static_cast<std::size_t>(*value);
  }
};

/// Walks the file's tables. `last`: inside the last entry of each list on the way, which is the one that fields reach.
void compare(const TreeNode& node, const std::string& path, bool last, Scene& scene,
             std::vector<std::string>& different) {
  const SceneField* field = find_field(path);
  const SceneSection* section = find_section(path);
  if (node.table() != nullptr && (section != nullptr || path.empty())) {
    for (const TreeEntry& entry : *node.table())
      compare(entry.node, path.empty() ? entry.key : path + '.' + entry.key, last, scene, different);
  } else if (node.list() != nullptr && section != nullptr && section->list) {
    // Bodies in copies, or cut into arcs, are read as several bodies with names of their own.
    const bool whole = path != "body" || scene.bodies.size() == node.list()->size();
    for (std::size_t k = 0; k < node.list()->size(); ++k)
      compare((*node.list())[k], path, last && whole && k + 1 == node.list()->size(), scene, different);
  } else if (field == nullptr) {
    different.push_back(path + ": no field has this name");
  } else if (last && !std::visit(SameValue{*field, node, scene.dimension}, field->target(scene))) {
    different.push_back(path + ": the file says " + shown(node));
  }
}

void read_one(const std::string& text, MutationCounts& counts) {
  try {
    Scene scene = parse_scene(text, "mutated.toml");
    ++counts.read;
    for (const std::string& difference : differences(text, std::move(scene)))
      counts.complaints.push_back(difference + "\n" + text);
  } catch (const InputError& error) {
    ++counts.refused;
    bool spoken = !error.mistakes().empty();
    for (const Mistake& mistake : error.mistakes()) spoken = spoken && !mistake.message.empty() && mistake.line > 0;
    if (!spoken) counts.complaints.push_back("refused without place or message\n" + text);
  } catch (const std::exception& error) {
    counts.complaints.push_back(std::string("not an input error: ") + error.what() + "\n" + text);
  }
}

}  // namespace

std::vector<std::string> differences(const std::string& text, Scene scene) {
  std::vector<std::string> different;
  compare(parse_toml(text, "mutated.toml"), "", true, scene, different);
  return different;
}

MutationCounts read_mutations(const std::vector<std::string>& texts, long first, long count) {
  MutationCounts counts;
  for (long k = first; k < first + count && counts.complaints.size() < 10; ++k) {
    RandomStream random(seed, static_cast<std::uint64_t>(k));
    const std::string text = mutated(texts, random);
    const double start = thread_seconds();
    read_one(text, counts);
    if (const double seconds = thread_seconds() - start; seconds > counts.slowest)
      counts.slowest = seconds, counts.slowest_text = text;
  }
  return counts;
}

}  // namespace galet::test
