// Names in messages: the known name that a mistyped one was meant to be, and lists of what was possible.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace galet {

/// Levenshtein distance, with a swap of two neighbours as one step too (the commonest slip): the least number of
/// letters to insert, delete, replace or swap. (Optimal string alignment: no letter is changed twice.)
int edit_distance(std::string_view a, std::string_view b);

/// The candidate that `name` was probably meant to be: upper and lower case apart, at most a third of its letters
/// wrong, or cut short. Empty when nothing is that near; the first of equally near ones.
std::optional<std::string> near_match(std::string_view name, const std::vector<std::string>& candidates);

/// "; did you mean "friction"?", or nothing.
std::string suggestion(std::string_view name, const std::vector<std::string>& candidates);

/// "a, b or c".
std::string alternatives(const std::vector<std::string>& names);

/// The name in double quotes; each of the names in double quotes.
std::string in_quotes(std::string_view name);
std::vector<std::string> in_quotes(const std::vector<std::string>& names);

}  // namespace galet
