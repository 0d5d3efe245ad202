#include "named_elements.hpp"

namespace lichtmc::python {

namespace {

// A message lists at most so many names.
constexpr std::size_t most_names = 12;

// "'floor', 'ceiling' and 10 more", similar names first.
std::string names_near(const std::string& name, const NamedElements& elements) {
  const nb::list all = elements.names();
  nb::list shown = nb::cast<nb::list>(
      nb::module_::import_("difflib").attr("get_close_matches")(name, all, nb::arg("n") = most_names));
  for (const nb::handle one : all) {
    if (shown.size() == most_names) break;
    if (!nb::cast<bool>(shown.attr("__contains__")(one))) shown.append(one);
  }
  std::string text;
  for (const nb::handle one : shown) text += (text.empty() ? "'" : ", '") + nb::cast<std::string>(one) + "'";
  if (all.size() > shown.size()) text += " and " + std::to_string(all.size() - shown.size()) + " more";
  return text;
}

std::size_t find_name(const std::string& name, const NamedElements& elements) {
  std::size_t found = elements.count;
  for (std::size_t k = 0; k < elements.count; ++k) {
    if (elements.name(k) != name) continue;
    if (found != elements.count) {
      const std::string text = "Several " + elements.plural + " have the name '" + name + "': give the number of one.";
      throw nb::key_error(text.c_str());
    }
    found = k;
  }
  if (found != elements.count) return found;
  const std::string text =
      elements.count == 0
          ? "There is no " + elements.what + " '" + name + "': the result has no " + elements.plural + "."
          : "There is no " + elements.what + " '" + name + "' (there are: " + names_near(name, elements) + ").";
  throw nb::key_error(text.c_str());
}

std::size_t find_number(nb::handle key, const NamedElements& elements) {
  const Py_ssize_t number = PyNumber_AsSsize_t(key.ptr(), PyExc_IndexError);
  if (number == -1 && PyErr_Occurred() != nullptr) throw nb::python_error();
  const auto count = static_cast<Py_ssize_t>(elements.count);
  if (number >= -count && number < count) return static_cast<std::size_t>(number < 0 ? number + count : number);
  const std::string text = "There is no " + elements.what + " number " + std::to_string(number) + ": the result has " +
                           std::to_string(count) + " " + (count == 1 ? elements.what : elements.plural) + ".";
  throw nb::index_error(text.c_str());
}

}  // namespace

std::size_t NamedElements::find(nb::handle key) const {
  if (nb::isinstance<nb::str>(key)) {
    std::string name;
    if (nb::try_cast(key, name)) return find_name(name, *this);
    const std::string text =
        "There is no " + what + " " + nb::cast<std::string>(nb::module_::import_("builtins").attr("ascii")(key)) + ".";
    throw nb::key_error(text.c_str());  // half a pair of UTF-16, which no name has
  }
  if (PyIndex_Check(key.ptr()) != 0) return find_number(key, *this);
  const std::string text = "The " + plural + " of a result are found by name (str) or number (int), not by " +
                           std::string(nb::repr(key).c_str()) + ".";
  throw nb::type_error(text.c_str());
}

bool NamedElements::contains_number(nb::handle key) const {
  if (PyIndex_Check(key.ptr()) == 0) return false;
  const Py_ssize_t number = PyNumber_AsSsize_t(key.ptr(), nullptr);  // a large one becomes the largest
  if (number == -1 && PyErr_Occurred() != nullptr) throw nb::python_error();
  const auto size = static_cast<Py_ssize_t>(count);
  return number >= -size && number < size;
}

bool NamedElements::contains(nb::handle key) const {
  std::string wanted;
  if (!nb::isinstance<nb::str>(key) || !nb::try_cast(key, wanted)) return false;
  for (std::size_t k = 0; k < count; ++k) {
    if (name(k) == wanted) return true;
  }
  return false;
}

nb::list NamedElements::names() const {
  nb::list all;
  for (std::size_t k = 0; k < count; ++k) all.append(nb::str(name(k).c_str(), name(k).size()));
  return all;
}

}  // namespace lichtmc::python
