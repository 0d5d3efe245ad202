#include "vectors.hpp"

#include <nanobind/stl/string.h>

#include <cstddef>

#include "arguments.hpp"
#include "lichtmc/error.hpp"

namespace lichtmc::python {

// Texts that look like numbers are refused, which numpy would convert.
DoubleArray doubles_of(nb::handle value, const std::string& what) {
  try {
    const nb::module_ numpy = nb::module_::import_("numpy");
    const nb::object given = numpy.attr("asarray")(value);
    const auto kind = nb::cast<std::string>(given.attr("dtype").attr("kind"));
    if (kind == "f" || kind == "i" || kind == "u" || kind == "b")
      return nb::cast<DoubleArray>(numpy.attr("ascontiguousarray")(given, "float64"));
  } catch (const nb::python_error& error) {
    if (!tells_of_value(error)) throw;
  } catch (const nb::cast_error&) {
  }
  refuse_value(what, value, "numbers, as a list, tuple or numpy array", "Give it as such.");
}

glm::dvec3 vec3_of(nb::handle value, const std::string& what) {
  const DoubleArray array = doubles_of(value, what);
  if (array.ndim() != 1 || array.shape(0) != 3)
    throw InputError("The " + what + " has the shape " + shape_text(array) +
                     " (allowed: (3,)). Give three numbers: x, y, z.");
  return {array.data()[0], array.data()[1], array.data()[2]};
}

std::vector<glm::dvec3> rows_of_3(nb::handle value, const std::string& what) {
  const DoubleArray array = doubles_of(value, what);
  const bool one = array.ndim() == 1 && array.shape(0) == 3;
  if (!one && !(array.ndim() == 2 && array.shape(1) == 3))
    throw InputError("The " + what + " has the shape " + shape_text(array) +
                     " (allowed: (n, 3), or (3,) for a single one). Give x, y, z in each row.");
  const std::size_t count = one ? 1 : array.shape(0);
  std::vector<glm::dvec3> rows(count);
  for (std::size_t k = 0; k < count; ++k)
    rows[k] = {array.data()[3 * k], array.data()[3 * k + 1], array.data()[3 * k + 2]};
  return rows;
}

}  // namespace lichtmc::python
