// Elements that have names, for Python: by name or by number.
#pragma once

#include <nanobind/nanobind.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <cstddef>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace lichtmc::python {

namespace nb = nanobind;

// `count` elements and the name of each; what: "surface", for messages.
struct NamedElements {
  std::string what;
  std::string plural;
  std::size_t count = 0;
  std::function<const std::string&(std::size_t)> name;

  // The element that a name (str) or number (negative: from the end) means. Throws Python's KeyError, with similar
  // names first, IndexError or TypeError.
  std::size_t find(nb::handle key) const;
  // By name, as a dict; a number is none of its keys, but find() takes it.
  bool contains(nb::handle key) const;
  bool contains_number(nb::handle key) const;
  nb::list names() const;
};

// Gives a class the methods of a mapping from names to elements, in their order: as a dict that can be indexed by
// number too. elements(const Mapping&) -> NamedElements; element(const Mapping&, std::size_t) -> the element; type: the
// name of its class.
template <class Mapping, class Elements, class Element>
void bind_mapping(nb::class_<Mapping>& of, const std::string& type, const Elements& elements, const Element& element) {
  using Value = decltype(element(std::declval<const Mapping&>(), std::size_t{}));
  of.def("__len__", [elements](const Mapping& mapping) { return elements(mapping).count; })
      .def(
          "__getitem__",
          [elements, element](const Mapping& mapping, nb::object key) {
            return element(mapping, elements(mapping).find(key));
          },
          nb::arg("key").none(), nb::sig(("def __getitem__(self, key: str | int) -> " + type).c_str()),
          "By name, or by number.")
      .def(
          "__contains__",
          [elements](const Mapping& mapping, nb::object key) { return elements(mapping).contains(key); },
          nb::arg("key").none())
      .def("__iter__",
           [elements](const Mapping& mapping) -> nb::typed<nb::iterator, std::string> {
             return nb::steal<nb::iterator>(PyObject_GetIter(elements(mapping).names().ptr()));
           })
      .def(
          "keys",
          [elements](const Mapping& mapping) -> nb::typed<nb::list, std::string> { return elements(mapping).names(); },
          "The names.")
      .def(
          "values",
          [elements, element](const Mapping& mapping) {
            std::vector<Value> values;
            const std::size_t count = elements(mapping).count;
            for (std::size_t k = 0; k < count; ++k) values.push_back(element(mapping, k));
            return values;
          },
          "The elements, in the order of the names.")
      .def(
          "items",
          [elements, element](const Mapping& mapping) {
            const NamedElements named = elements(mapping);
            std::vector<std::pair<std::string, Value>> items;
            for (std::size_t k = 0; k < named.count; ++k) items.emplace_back(named.name(k), element(mapping, k));
            return items;
          },
          "Pairs of name and element.")
      .def(
          "get",
          [elements, element](const Mapping& mapping, nb::object key, nb::object otherwise) {
            const NamedElements named = elements(mapping);
            return named.contains(key) || named.contains_number(key) ? nb::cast(element(mapping, named.find(key)))
                                                                     : otherwise;
          },
          nb::arg("key").none(), nb::arg("default").none() = nb::none(),
          nb::sig(("def get(self, key: str | int, default: typing.Any = None) -> " + type + " | typing.Any").c_str()),
          "The element, or `default` if there is none.");
  nb::module_::import_("collections.abc").attr("Mapping").attr("register")(of);
}

}  // namespace lichtmc::python
