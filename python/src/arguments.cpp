#include "arguments.hpp"

#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/string.h>

#include <cmath>
#include <limits>

#include "lichtmc/error.hpp"
#include "vectors.hpp"

namespace lichtmc::python {

namespace {

// The name of the type, for values whose repr tells little.
std::string type_of(nb::handle value) {
  return nb::type_name(value.type()).c_str();
}

// True, False, or one of numpy.
bool is_flag(nb::handle value) {
  return nb::isinstance<nb::bool_>(value) || type_of(value).starts_with("numpy.bool");
}

// The value as Python's int; invalid: it is no whole number.
nb::object integer_of(nb::handle value) {
  if (is_flag(value)) return {};
  const bool is_whole_float =
      nb::isinstance<nb::float_>(value) && std::trunc(nb::cast<double>(value)) == nb::cast<double>(value);
  nb::object integer = nb::steal(is_whole_float ? PyNumber_Long(value.ptr()) : PyNumber_Index(value.ptr()));
  if (!integer.is_valid()) clear_error_of_value();
  return integer;
}

}  // namespace

bool tells_of_value(const nb::python_error& error) {
  for (PyObject* kind : {PyExc_TypeError, PyExc_ValueError, PyExc_OverflowError, PyExc_BufferError}) {
    if (error.matches(kind)) return true;
  }
  return false;
}

void clear_error_of_value() {
  if (PyErr_Occurred() == nullptr) return;
  const nb::python_error error;
  if (!tells_of_value(error)) throw error;
}

std::string shown(nb::handle value) {
  constexpr std::size_t longest = 80;  // bytes
  std::string text = nb::repr(value).c_str();
  if (text.size() <= longest) return text;
  std::size_t end = longest;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) --end;  // not within a character
  return text.substr(0, end) + "…";
}

void refuse_value(const std::string& what, nb::handle value, const std::string& allowed, const std::string& remedy) {
  throw InputError("The " + what + " is " + shown(value) + " (allowed: " + allowed + "). " + remedy);
}

nb::object text_of_file_name(const std::string& name) {
  nb::object text = nb::steal(PyUnicode_DecodeFSDefaultAndSize(name.data(), static_cast<Py_ssize_t>(name.size())));
  if (!text.is_valid()) throw nb::python_error();
  return text;
}

std::string readable(const std::string& text) {
  const nb::object decoded =
      nb::steal(PyUnicode_DecodeUTF8(text.data(), static_cast<Py_ssize_t>(text.size()), "backslashreplace"));
  if (!decoded.is_valid()) throw nb::python_error();
  return nb::cast<std::string>(decoded);
}

double number_of(nb::handle value, const std::string& what, const char* example) {
  const double number = is_flag(value) ? 0.0 : PyFloat_AsDouble(value.ptr());
  if (!is_flag(value) && PyErr_Occurred() == nullptr) return number;
  clear_error_of_value();
  refuse_value(what, value, "a number", std::string("Give a number, for example ") + example + ".");
}

std::optional<double> optional_number(nb::handle value, const std::string& what) {
  if (value.is_none()) return std::nullopt;
  return number_of(value, what);
}

std::int64_t whole_number_of(nb::handle value, const std::string& what, std::int64_t least, std::int64_t most) {
  const nb::object integer = integer_of(value);
  const long long number = integer.is_valid() ? PyLong_AsLongLong(integer.ptr()) : 0;
  const bool whole = integer.is_valid() && PyErr_Occurred() == nullptr;
  clear_error_of_value();
  if (whole && number >= least && number <= most) return number;
  refuse_value(what, value, "a whole number, " + std::to_string(least) + " to " + std::to_string(most),
               "Give such a number.");
}

std::uint64_t seed_of(nb::handle value) {
  const nb::object integer = integer_of(value);
  const unsigned long long seed = integer.is_valid() ? PyLong_AsUnsignedLongLong(integer.ptr()) : 0;
  if (integer.is_valid() && PyErr_Occurred() == nullptr) return seed;
  clear_error_of_value();
  refuse_value("seed", value, "a whole number, 0 to " + std::to_string(std::numeric_limits<std::uint64_t>::max()),
               "Give such a number.");
}

std::vector<double> numbers_of(nb::handle value, const std::string& what, std::size_t count, const std::string& each) {
  const DoubleArray array = doubles_of(value, what);
  const std::size_t given = array.ndim() == 1 ? array.shape(0) : 0;
  if (given == count && array.ndim() == 1) return {array.data(), array.data() + count};
  if (given == 1) return std::vector<double>(count, array.data()[0]);
  throw InputError("The " + what + " has the shape " + shape_text(array) + " (allowed: (" + std::to_string(count) +
                   ",), one for each " + each + ", or one number). Give as many as there are.");
}

std::string text_of(nb::handle value, const std::string& what) {
  std::string text;
  if (nb::isinstance<nb::str>(value) && nb::try_cast(value, text)) return text;
  refuse_value(what, value, "a text", "Give a str.");
}

std::vector<std::string> texts_of(nb::handle value, const std::string& what) {
  if (nb::isinstance<nb::str>(value)) return {text_of(value, what)};
  const nb::object items = nb::steal(PyObject_GetIter(value.ptr()));
  if (!items.is_valid()) {
    clear_error_of_value();
    refuse_value(what, value, "texts, as a list or tuple", "Give a list of str.");
  }
  std::vector<std::string> texts;
  while (true) {
    const nb::object item = nb::steal(PyIter_Next(items.ptr()));
    if (!item.is_valid()) break;
    texts.push_back(text_of(item, what + " at position " + std::to_string(texts.size())));
  }
  if (PyErr_Occurred() != nullptr) throw nb::python_error();
  return texts;
}

bool flag_of(nb::handle value, const std::string& what) {
  if (is_flag(value)) return PyObject_IsTrue(value.ptr()) == 1;
  refuse_value(what, value, "True or False", "Give one of these.");
}

std::filesystem::path path_of(nb::handle value, const std::string& what) {
  std::filesystem::path path;
  const bool is_content = nb::isinstance<nb::bytes>(value);
  if (!is_content) {
    const nb::object name = nb::steal(PyOS_FSPath(value.ptr()));
    if (name.is_valid() && nb::try_cast(name, path)) return path;
    clear_error_of_value();
  }
  refuse_value(
      what, value, "the name of a file, as str or pathlib.Path",
      is_content ? "For the content of a file in memory there are from_bytes() and from_text()." : "Give such a name.");
}

Quantity unit_of(nb::handle value) {
  const std::string unit = nb::isinstance<nb::str>(value) ? text_of(value, "unit") : std::string();
  for (const Quantity quantity : {Quantity::photometric, Quantity::radiometric}) {
    if (unit == power_unit(quantity)) return quantity;
  }
  refuse_value("unit", value, "'lm' for luminous flux, 'W' for radiant flux", "Give one of these.");
}

WholeArray whole_numbers_of(nb::handle value, const std::string& what) {
  std::string type = type_of(value);
  try {
    const nb::module_ numpy = nb::module_::import_("numpy");
    const nb::object array = numpy.attr("asarray")(value);
    const auto kind = nb::cast<std::string>(array.attr("dtype").attr("kind"));
    if (kind == "i" || kind == "u") return nb::cast<WholeArray>(numpy.attr("ascontiguousarray")(array, "int64"));
    type = nb::cast<std::string>(array.attr("dtype").attr("name"));
  } catch (const nb::python_error& error) {
    if (!tells_of_value(error)) throw;
  } catch (const nb::cast_error&) {
  }
  throw InputError("The type of the " + what + " is " + type +
                   " (allowed: integers, as a list, tuple or numpy array). Convert it, for example by .astype(int).");
}

}  // namespace lichtmc::python
