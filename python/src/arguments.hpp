// Arguments of Python code: numbers, texts, file names, arrays of whole numbers. Where a value is of another type, the
// message says what was expected in words of the user, in place of a TypeError with types of C++.
#pragma once

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lichtmc/units.hpp"

namespace lichtmc::python {

namespace nb = nanobind;

// An argument that accepts any object, also None: the functions below say what is wrong with it.
inline auto any_arg(const char* name) {
  return nb::arg(name).none();
}

// Whether an exception says that a value is of a wrong kind. Others, such as KeyboardInterrupt and MemoryError, are no
// matter of the value.
bool tells_of_value(const nb::python_error& error);
// After a function of Python's C API has failed: clears its exception if it tells of the value, else throws it.
void clear_error_of_value();

// Text of a value for messages: its repr, shortened.
std::string shown(nb::handle value);

// Throws InputError: "The {what} is {value} (allowed: {allowed}). {remedy}"
[[noreturn]] void refuse_value(const std::string& what, nb::handle value, const std::string& allowed,
                               const std::string& remedy);

// A name of a file as Python has it, which keeps bytes that are no text.
nb::object text_of_file_name(const std::string& name);
// For messages: the same text, in UTF-8 whatever its bytes are.
std::string readable(const std::string& text);

// A number; numpy's scalars are numbers, texts are not.
// example: for the message.
double number_of(nb::handle value, const std::string& what, const char* example = "0.5");
// None: none.
std::optional<double> optional_number(nb::handle value, const std::string& what);
// A whole number, least ≤ n ≤ most.
std::int64_t whole_number_of(nb::handle value, const std::string& what, std::int64_t least, std::int64_t most);
// A seed: 0 to 2^64 − 1.
std::uint64_t seed_of(nb::handle value);
// `count` numbers: an array of that length, or one number for all. each: "receiver", for messages.
std::vector<double> numbers_of(nb::handle value, const std::string& what, std::size_t count, const std::string& each);

std::string text_of(nb::handle value, const std::string& what);
// A sequence of texts; a single text is one.
std::vector<std::string> texts_of(nb::handle value, const std::string& what);
bool flag_of(nb::handle value, const std::string& what);
std::filesystem::path path_of(nb::handle value, const std::string& what);
// "lm" or "W".
Quantity unit_of(nb::handle value);

// A C-contiguous array of whole numbers of any shape. Throws InputError if the value is none: also for floats.
using WholeArray = nb::ndarray<const std::int64_t, nb::c_contig, nb::device::cpu>;
WholeArray whole_numbers_of(nb::handle value, const std::string& what);

}  // namespace lichtmc::python
