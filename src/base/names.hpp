// Names that a user gives: patterns for them, and the nearest of those that exist.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace lichtmc {

// Whether a name is the pattern itself, or fits it as a pattern of the shell: "*" stands for any text, "?" for one
// character, "[a-z]" for one of a set, "[!a-z]" for one outside of it. "/" is a character as any other. Both are UTF-8.
bool matches_pattern(std::string_view pattern, std::string_view name);

// Number of characters to insert, delete, replace or swap with their neighbour to make one text from the other; upper
// and lower case of ASCII are the same (optimal string alignment distance).
std::size_t edit_distance(std::string_view a, std::string_view b);

// Those of `names` that are most similar to `name`, at most five, in quotes: "'Wall', 'Walls'". If none is similar: the
// first ones. "none" if there are none.
std::string nearest_names(std::string_view name, std::vector<std::string> names);

}  // namespace lichtmc
