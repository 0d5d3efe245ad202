// Enumerations as strings: Python code says estimator="collision", with the words of the command line.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>

#include "lichtmc/error.hpp"

namespace lichtmc::python {

// The value whose name, by to_string(), is `name`. Throws InputError that lists the names. what: "estimator", …
template <class Enumeration>
Enumeration named(std::string_view what, std::string_view name, std::initializer_list<Enumeration> values) {
  std::string allowed;
  for (const Enumeration value : values) {
    const std::string_view word = to_string(value);
    if (word == name) return value;
    allowed += (allowed.empty() ? "'" : ", '") + std::string(word) + "'";
  }
  throw InputError("The argument " + std::string(what) + " is '" + std::string(name) + "' (allowed: " + allowed +
                   "). Choose one of these.");
}

// The same for enumerations without such a function.
template <class Enumeration>
Enumeration named(std::string_view what, std::string_view name,
                  std::initializer_list<std::pair<std::string_view, Enumeration>> values) {
  std::string allowed;
  for (const auto& [word, value] : values) {
    if (word == name) return value;
    allowed += (allowed.empty() ? "'" : ", '") + std::string(word) + "'";
  }
  throw InputError("The argument " + std::string(what) + " is '" + std::string(name) + "' (allowed: " + allowed +
                   "). Choose one of these.");
}

}  // namespace lichtmc::python
