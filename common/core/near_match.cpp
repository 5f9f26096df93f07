#include "common/core/near_match.hpp"

#include <algorithm>
#include <numeric>

namespace galet {

int edit_distance(std::string_view a, std::string_view b) {
  // Rows of the dynamic programme: row[j] is the distance between the first i letters of a and the first j of b.
  std::vector<int> row(b.size() + 1);
  std::iota(row.begin(), row.end(), 0);
  std::vector<int> above = row;      // of i - 1
  std::vector<int> two_above = row;  // of i - 2
  for (std::size_t i = 1; i <= a.size(); ++i) {
    two_above.swap(above);
    above.swap(row);
    row[0] = static_cast<int>(i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const int replaced = above[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      row[j] = std::min({replaced, above[j] + 1, row[j - 1] + 1});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) row[j] = std::min(row[j], two_above[j - 2] + 1);
    }
  }
  return row[b.size()];
}

namespace {

std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char& c : lower)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return lower;
}

bool cut_short(std::string_view name, std::string_view candidate) {
  return name.size() >= 3 && candidate.starts_with(name);
}

}  // namespace

std::optional<std::string> near_match(std::string_view name, const std::vector<std::string>& candidates) {
  const std::string wanted = lower_case(name);
  const int allowed = std::max(1, static_cast<int>(wanted.size()) / 3);
  std::optional<std::string> nearest;
  int least = allowed + 1;
  for (const std::string& candidate : candidates) {
    const std::string known = lower_case(candidate);
    const int distance = std::min(edit_distance(wanted, known), cut_short(wanted, known) ? allowed : allowed + 1);
    // A name of one letter is one letter away from every other: nothing of it would be left.
    if (distance >= least || distance >= static_cast<int>(known.size())) continue;
    least = distance;
    nearest = candidate;
  }
  return nearest;
}

std::string suggestion(std::string_view name, const std::vector<std::string>& candidates) {
  const std::optional<std::string> meant = near_match(name, candidates);
  return meant ? "; did you mean " + in_quotes(*meant) + "?" : "";
}

std::string alternatives(const std::vector<std::string>& names) {
  std::string list;
  for (std::size_t k = 0; k < names.size(); ++k) {
    if (k > 0) list += k + 1 == names.size() ? " or " : ", ";
    list += names[k];
  }
  return list;
}

std::string in_quotes(std::string_view name) { return '"' + std::string(name) + '"'; }

std::vector<std::string> in_quotes(const std::vector<std::string>& names) {
  std::vector<std::string> all;
  for (const std::string& name : names) all.push_back(in_quotes(name));
  return all;
}

}  // namespace galet
