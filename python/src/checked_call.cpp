#include "checked_call.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace lichtmc::python {

namespace {

// The parameters of "def f(self, a: list[int], *, b: float = 0.5) -> None": self, a, b.
std::vector<std::string> parameters_of(std::string_view signature) {
  std::vector<std::string> names;
  int depth = 0;
  bool in_name = false;
  char quote = 0;
  for (const char c : signature) {
    if (quote != 0) {
      if (c == quote) quote = 0;
      continue;
    }
    if (c == '\'' || c == '"') quote = c;
    const bool opens = c == '(' || c == '[';
    if (opens) ++depth;
    if (c == ')' || c == ']') --depth;
    if (names.empty() ? opens : depth == 1 && c == ',') {
      names.emplace_back();
      in_name = true;
    } else if (depth == 0 && !names.empty()) {
      break;
    } else if (c == ':' || c == '=') {
      in_name = false;
    } else if (in_name && c != ' ') {
      names.back() += c;
    }
  }
  std::erase(names, "*");
  return names;
}

[[noreturn]] void refuse(const std::string& message) {
  PyErr_SetString(PyExc_TypeError, message.c_str());
  throw nb::python_error();
}

std::string list_of(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) {
    if (name != "self") text += (text.empty() ? "" : ", ") + name;
  }
  return text;
}

}  // namespace

void check_call(const char* name, const char* signature, std::span<const nb::handle> arguments,
                const nb::kwargs* unknown) {
  if (unknown != nullptr && unknown->size() > 0) {
    const std::string keyword = nb::str(nb::handle((*unknown->begin()).first)).c_str();
    refuse(std::string(name) + "() has no argument '" + keyword + "' (allowed: " + list_of(parameters_of(signature)) +
           ").");
  }
  for (std::size_t k = 0; k < arguments.size(); ++k) {
    if (arguments[k].ptr() != Py_Ellipsis) continue;
    const std::vector<std::string> names = parameters_of(signature);
    refuse(std::string(name) + "() needs the argument '" + names.at(k) + "' (its arguments: " + list_of(names) + ").");
  }
}

}  // namespace lichtmc::python
