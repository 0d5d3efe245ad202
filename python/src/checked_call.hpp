// Functions whose callers learn in plain words that an argument is missing or that a keyword is not known, in place of
// nanobind's "incompatible function arguments". As in Python these are TypeErrors.
//
//   constexpr const char* signature = "def paint(self, colour: str, *, layers: int = 1) -> None";
//   wall.def("paint", checked("paint", signature, &paint), required("colour"), nb::kw_only(), any_arg("layers") = 1,
//            other_keywords(), nb::sig(signature), "Paints a wall.");
//
// The function takes its arguments as nb::handle.
#pragma once

#include <nanobind/nanobind.h>

#include <array>
#include <cstddef>
#include <span>
#include <type_traits>
#include <utility>

#include "arguments.hpp"

namespace lichtmc::python {

// An argument without a default: Ellipsis stands for one that is not given.
inline auto required(const char* name) {
  return any_arg(name) = nb::ellipsis();
}

// Where the keywords arrive that no argument has.
inline auto other_keywords() {
  return nb::arg("other_keywords");
}

// Throws TypeError if a keyword is not known or an argument is missing. arguments: all of the signature in its order,
// empty handles for those that are not to be checked. unknown: null if the function takes any keyword.
void check_call(const char* name, const char* signature, std::span<const nb::handle> arguments,
                const nb::kwargs* unknown);

template <class Argument>
nb::handle checked_handle(const Argument& argument) {
  if constexpr (std::is_same_v<Argument, nb::handle>) {
    return argument;
  } else {
    return {};
  }
}

// The function with a further argument for keywords that are not known. name: for messages, that of the function or of
// the class that is made. Both texts must be literals.
template <class Outcome, class... Arguments>
auto checked(const char* name, const char* signature, Outcome (*function)(Arguments...)) {
  struct Texts {
    const char* name;
    const char* signature;
  };
  return [texts = Texts{name, signature}, function](Arguments... arguments, const nb::kwargs& unknown) -> Outcome {
    const std::array<nb::handle, sizeof...(Arguments)> handles{checked_handle(arguments)...};
    check_call(texts.name, texts.signature, handles, &unknown);
    return function(std::forward<Arguments>(arguments)...);
  };
}

}  // namespace lichtmc::python
