// Points, directions and arrays of them as arguments: anything that numpy makes an array of floats of.
#pragma once

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>

#include <cstddef>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

namespace lichtmc::python {

namespace nb = nanobind;

// What numpy makes an array of: the type of such arguments in stubs and messages. Any object is accepted here.
class ArrayLike : public nb::object {
  NB_OBJECT(ArrayLike, nb::object, "numpy.typing.ArrayLike", always)
  static bool always(PyObject* /*object*/) { return true; }
};

// Three numbers, as a list, tuple or array. Throws InputError. what: "position of the emitter", for messages.
glm::dvec3 vec3_of(nb::handle value, const std::string& what);

// An array (n, 3), or (3,) as one row.
std::vector<glm::dvec3> rows_of_3(nb::handle value, const std::string& what);

// The value as a C-contiguous array of doubles of any shape. Throws InputError if it is no array of numbers.
using DoubleArray = nb::ndarray<const double, nb::c_contig, nb::device::cpu>;
DoubleArray doubles_of(nb::handle value, const std::string& what);

// "(4, 3)", for messages.
template <class Array>
std::string shape_text(const Array& array) {
  std::string text = "(";
  for (std::size_t k = 0; k < array.ndim(); ++k) text += (k > 0 ? ", " : "") + std::to_string(array.shape(k));
  return text + (array.ndim() == 1 ? ",)" : ")");
}

}  // namespace lichtmc::python
