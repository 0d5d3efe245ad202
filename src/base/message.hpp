// Parts of messages: numbers, counts and names, in one form for all errors.
#pragma once

#include <string>
#include <string_view>

namespace lichtmc {

// A number in the shortest form that reads back as the same double: "0.1", "1e+30", "nan".
std::string to_text(double value);

// A number rounded to three digits: "0.123", "12.3", "12300", "1.23e+06".
std::string short_number(double value);

// A count with its noun, in the singular or plural: "1 triangle", "12 triangles".
std::string to_text(std::size_t count, std::string_view singular);

// A name in quotes, "'name'", as visible_text(); an empty name gives "(no name)".
std::string in_quotes(std::string_view name);

}  // namespace lichtmc
