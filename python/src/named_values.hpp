// Enumerations as strings: Python code says estimator="collision", with the words of the command line.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "lichtmc/error.hpp"

namespace lichtmc::python {

// The value whose word in the list is `name`. Throws InputError that lists the words. what: "scale", …
// Words: pairs of word and value.
template <class Enumeration, class Words>
Enumeration value_of_word(std::string_view what, std::string_view name, const Words& words) {
  std::string allowed;
  for (const auto& [word, value] : words) {
    if (word == name) return value;
    allowed += (allowed.empty() ? "'" : ", '") + std::string(word) + "'";
  }
  throw InputError("The argument " + std::string(what) + " is '" + std::string(name) + "' (allowed: " + allowed +
                   "). Choose one of these.");
}

// The same for values whose word is that of to_string().
template <class Enumeration>
Enumeration named(std::string_view what, std::string_view name, std::initializer_list<Enumeration> values) {
  std::vector<std::pair<std::string_view, Enumeration>> words;
  for (const Enumeration value : values) words.emplace_back(to_string(value), value);
  return value_of_word<Enumeration>(what, name, words);
}

// The same for values without such a function.
template <class Enumeration>
Enumeration named(std::string_view what, std::string_view name,
                  std::initializer_list<std::pair<std::string_view, Enumeration>> words) {
  return value_of_word<Enumeration>(what, name, words);
}

}  // namespace lichtmc::python
