// Figures with their standard errors.
#include "figures.hpp"

#include <nanobind/stl/string.h>

#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>

#include "bindings.hpp"
#include "lichtmc/output.hpp"
#include "views.hpp"

namespace lichtmc::python {

std::string text_of(const Figure& figure) {
  constexpr double least_plain = 1e-3;  // values outside of these limits get a power of ten
  constexpr double greatest_plain = 1e7;
  const double size = std::abs(figure.value);
  if (!std::isfinite(size) || size == 0.0 || (size >= least_plain && size < greatest_plain)) return figure_text(figure);
  const double power = std::floor(std::log10(size));
  const double unit = std::pow(10.0, power);
  const std::string text = figure_text({figure.value / unit, figure.standard_error / unit});
  const std::string exponent = (power < 0.0 ? "e-" : "e+") + std::string(std::abs(power) < 10.0 ? "0" : "") +
                               std::to_string(static_cast<int>(std::abs(power)));
  return text.find(' ') == std::string::npos ? text + exponent : "(" + text + ")" + exponent;
}

namespace {

View<double> numbers(const Figures& figures, double Figure::*member) {
  std::vector<std::int64_t> strides(figures.shape.size());
  auto step = static_cast<std::int64_t>(figures.step);
  for (std::size_t d = strides.size(); d-- > 0;) {
    strides[d] = step;
    step *= static_cast<std::int64_t>(figures.shape[d]);
  }
  static constexpr double nothing = 0.0;
  const double* first = figures.first == nullptr ? &nothing : &(figures.first->*member);
  return View<double>(first, figures.shape.size(), figures.shape.data(), keep(figures.owner), strides.data());
}

// By numpy's rules, so that negative numbers and errors are as usual.
Figure figure_at(const Figures& figures, nb::handle index) {
  const auto one = [&](double Figure::*member) {
    const nb::object array = nb::cast(numbers(figures, member), has_owner);
    const nb::object picked = array[index];
    if (nb::cast<int>(picked.attr("ndim")) > 0) {
      const std::string text = "Figures are indexed by one number for each of their " +
                               std::to_string(figures.shape.size()) +
                               (figures.shape.size() == 1 ? " dimension" : " dimensions") +
                               ". For parts of arrays use .value[…] and .standard_error[…].";
      throw nb::index_error(text.c_str());
    }
    return nb::cast<double>(nb::float_(picked));
  };
  return {one(&Figure::value), one(&Figure::standard_error)};
}

nb::object formatted(const Figure& figure, const std::string& specification) {
  if (specification.empty()) return nb::cast(text_of(figure));
  const nb::object format = nb::module_::import_("builtins").attr("format");
  nb::object text = format(figure.value, specification);
  if (std::isfinite(figure.standard_error) && figure.standard_error != 0.0)
    text = text + nb::str(" ± ") + format(figure.standard_error, specification);
  return text;
}

}  // namespace

void bind_figures(nb::module_& module) {
  nb::class_<Figure>(module, "Figure",
                     "A value with its standard error, in the unit of what it is a figure of. float(figure) is the "
                     "value, str(figure) is rounded by the error: '349 ± 2'; f'{figure:.1f}' formats both.")
      .def(nb::init<double, double>(), nb::arg("value"), nb::arg("standard_error"))
      .def_ro("value", &Figure::value, "NaN: it does not exist.")
      .def_ro("standard_error", &Figure::standard_error, "Of the value. NaN: unknown; 0: the value is exact.")
      .def("__float__", [](const Figure& figure) { return figure.value; })
      .def("__str__", &text_of)
      .def("__format__", &formatted, nb::arg("specification"))
      .def(
          "__eq__",
          [](const Figure& figure, nb::object other) {
            Figure second;
            return nb::try_cast(other, second) && figure.value == second.value &&
                   figure.standard_error == second.standard_error;
          },
          nb::arg("other").none())
      .def("__hash__",
           [](const Figure& figure) { return nb::hash(nb::make_tuple(figure.value, figure.standard_error)); })
      .def(
          "__reduce__",
          [](const Figure& figure) {
            return nb::make_tuple(nb::type<Figure>(), nb::make_tuple(figure.value, figure.standard_error));
          },
          nb::sig("def __reduce__(self) -> tuple[type[Figure], tuple[float, float]]"))
      .def("__repr__", [](const Figure& figure) {
        return "Figure(" + std::string(nb::repr(nb::float_(figure.value)).c_str()) + ", " +
               std::string(nb::repr(nb::float_(figure.standard_error)).c_str()) + ")";
      });
  nb::class_<Figures>(module, "Figures",
                      "An array of figures: values and standard errors, arrays of the same shape that show the memory "
                      "of the result without copies, read-only. figures[i, j] is a Figure.")
      .def_prop_ro(
          "value", [](const Figures& figures) { return numbers(figures, &Figure::value); }, has_owner,
          "Values, float64. NaN: the figure does not exist.")
      .def_prop_ro(
          "standard_error", [](const Figures& figures) { return numbers(figures, &Figure::standard_error); }, has_owner,
          "Standard errors of the values, same unit, float64. NaN: unknown; 0: exact.")
      .def_prop_ro(
          "shape",
          [](const Figures& figures) {
            // As an object: what attr() returns only refers to the array, which ends here.
            return nb::object(nb::cast(numbers(figures, &Figure::value), has_owner).attr("shape"));
          },
          nb::sig("def shape(self) -> tuple[int, ...]"), "Shape of the arrays.")
      .def("__getitem__", &figure_at, nb::arg("index").none(),
           nb::sig("def __getitem__(self, index: int | tuple[int, ...]) -> Figure"),
           "One figure: a number for each dimension.")
      .def(
          "__array__",
          [](const Figures& figures, nb::object dtype, nb::object copy) {
            return as_array(nb::cast(numbers(figures, &Figure::value), has_owner), dtype, copy);
          },
          nb::arg("dtype").none() = nb::none(), nb::arg("copy").none() = nb::none(),
          nb::sig("def __array__(self, dtype: typing.Any = None, copy: bool | None = None) -> "
                  "numpy.typing.NDArray[typing.Any]"),
          "The values.")
      .def("__repr__", [](const Figures& figures) {
        const nb::object shape = nb::cast(numbers(figures, &Figure::value), has_owner).attr("shape");
        if (figures.first != nullptr && nb::cast<std::size_t>(nb::module_::import_("math").attr("prod")(shape)) == 1)
          return "Figures(" + text_of(*figures.first) + ", shape " + std::string(nb::repr(shape).c_str()) + ")";
        return "Figures(shape " + std::string(nb::repr(shape).c_str()) + ")";
      });
}

}  // namespace lichtmc::python
