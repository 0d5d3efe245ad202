// Comparisons of two results, and of two designs.
#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "bindings.hpp"
#include "lichtmc/compare.hpp"
#include "run_result.hpp"
#include "views.hpp"

namespace lichtmc::python {

namespace {

using ComparisonPtr = std::shared_ptr<Comparison>;

std::vector<ComparisonPtr> shared(std::vector<Comparison> comparisons) {
  std::vector<ComparisonPtr> all;
  for (Comparison& one : comparisons) all.push_back(std::make_shared<Comparison>(std::move(one)));
  return all;
}

auto of_figures(const ComparisonPtr& comparison, double FigurePair::*member) {
  return column(comparison, comparison->figures, member);
}

std::string repr_of(const Comparison& comparison) {
  char text[160];
  std::snprintf(text, sizeof text, ": %zu compared, %s, largest |z| %.3g, chi-square %.5g of expected %.5g>",
                comparison.figures.size(), comparison.agree ? "they agree" : "they disagree",
                std::abs(comparison.largest_z), comparison.chi_square, comparison.expected_chi_square);
  return "<lichtmc.Comparison of " + to_string(comparison.what) + text;
}

void bind_comparison(nb::module_& module) {
  nb::class_<Comparison>(
      module, "Comparison",
      "Two results held against each other: tile by tile, or receiver by receiver. True if they agree.\n\n"
      "Each figure gives z = (b − a)/√(error_a² + error_b²). If both results are right and independent, z has the "
      "normal distribution. They disagree if the largest |z|, or the sum of z², is so large that chance alone causes "
      "that once in a million comparisons.")
      .def_prop_ro(
          "what", [](const Comparison& c) { return to_string(c.what); },
          "'tiles', 'receivers' or 'tiles with receivers at their points'.")
      .def_ro("agree", &Comparison::agree, "Whether the results agree within their standard errors.")
      .def("__bool__", [](const Comparison& c) { return c.agree; })
      .def("__len__", [](const Comparison& c) { return c.figures.size(); })
      .def_prop_ro(
          "names",
          [](const Comparison& c) {
            std::vector<std::string> names;
            for (const FigurePair& pair : c.figures) names.push_back(pair.name);
            return names;
          },
          "Of the figures: 'floor, column 3, row 4', 'receiver desk'; a list of n texts.")
      .def_prop_ro(
          "a", [](const ComparisonPtr& c) { return of_figures(c, &FigurePair::a); }, has_owner,
          "Irradiance of the first result, W/m² or lx, float64 (n,).")
      .def_prop_ro(
          "error_a", [](const ComparisonPtr& c) { return of_figures(c, &FigurePair::error_a); }, has_owner,
          "Its standard error, same unit, float64 (n,).")
      .def_prop_ro(
          "b", [](const ComparisonPtr& c) { return of_figures(c, &FigurePair::b); }, has_owner,
          "Irradiance of the second result, W/m² or lx, float64 (n,).")
      .def_prop_ro(
          "error_b", [](const ComparisonPtr& c) { return of_figures(c, &FigurePair::error_b); }, has_owner,
          "Its standard error, same unit, float64 (n,).")
      .def_prop_ro(
          "z",
          [](const Comparison& c) {
            std::vector<double> z;
            for (const FigurePair& pair : c.figures) z.push_back(pair.z());
            const std::size_t count = z.size();
            return owned<double, 1>(std::move(z), {count});
          },
          has_owner, "(b − a)/√(error_a² + error_b²), float64 (n,).")
      .def_prop_ro(
          "freedom", [](const ComparisonPtr& c) { return of_figures(c, &FigurePair::freedom); }, has_owner,
          "Degrees of freedom of the error of b − a, float64 (n,): z has Student's distribution with as many.")
      .def_ro("dark", &Comparison::dark, "Number of figures that are left out because both are 0.")
      .def_ro("unknown", &Comparison::unknown,
              "Number of figures that are left out because an error is unknown: too few batches.")
      .def_ro("unmatched", &Comparison::unmatched,
              "Number of receivers that are left out because they lie at the point of no tile, or of several.")
      .def_ro("largest", &Comparison::largest, "Index of the figure with the largest |z|.")
      .def_ro("largest_z", &Comparison::largest_z, "Its z, signed.")
      .def_ro("largest_chance", &Comparison::largest_chance,
              "Probability that chance alone makes the largest of n as large, 0 … 1.")
      .def_ro("chi_square", &Comparison::chi_square, "The sum of z².")
      .def_ro("expected_chi_square", &Comparison::expected_chi_square, "Its mean if the results agree.")
      .def_ro("chi_square_chance", &Comparison::chi_square_chance,
              "Probability that chance alone makes the sum of z² as large, 0 … 1.")
      .def_ro("difference", &Comparison::difference, "(mean of b)/(mean of a) − 1.")
      .def_ro("difference_error", &Comparison::difference_error, "Standard error of that.")
      .def("__str__", [](const Comparison& c) { return comparison_text(c); })
      .def("__repr__", &repr_of);
}

void bind_designs(nb::module_& module) {
  nb::class_<DesignArea>(module, "DesignArea", "The figures of a calculation area of a design.")
      .def_ro("name", &DesignArea::name, "Name of the area.")
      .def_ro("role", &DesignArea::role, "'task', 'surrounding', …; may be empty.")
      .def_ro("quantity", &DesignArea::quantity, "'horizontal', 'normal', 'cylindrical' or 'semicylindrical'.")
      .def_ro("points", &DesignArea::points, "Number of its points.")
      .def_ro("mean", &DesignArea::mean, "Em, W/m² or lx, a Figure.")
      .def_ro("minimum", &DesignArea::minimum, "Emin, W/m² or lx, a Figure.")
      .def_ro("uniformity", &DesignArea::uniformity, "U0 = Emin/Em, a Figure.")
      .def_ro("target_lx", &DesignArea::target_mean, "Target of Em, lx, or None.")
      .def_ro("target_uniformity", &DesignArea::target_uniformity, "Target of U0, or None.")
      .def_prop_ro(
          "verdict", [](const DesignArea& area) { return std::string(to_string(area.verdict)); },
          "'pass', 'fail', 'undecided'; '' without a target.");
  nb::class_<DesignAreas>(module, "DesignAreas", "A calculation area of two designs, by its name.")
      .def_ro("a", &DesignAreas::a, "Its DesignArea in the first design, or None.")
      .def_ro("b", &DesignAreas::b, "Its DesignArea in the second design, or None.")
      .def_ro("mean_difference", &DesignAreas::mean_difference,
              "Em of b minus Em of a, W/m² or lx, a Figure; NaN if one is missing.")
      .def_ro("uniformity_difference", &DesignAreas::uniformity_difference,
              "U0 of b minus U0 of a, a Figure; NaN if one is missing.")
      .def_prop_ro(
          "name", [](const DesignAreas& pair) { return pair.a ? pair.a->name : pair.b->name; }, "Name of the area.");
  nb::class_<DesignTotals>(module, "DesignTotals", "Totals of a design.")
      .def_ro("power", &DesignTotals::power, "Of all emitters, W or lm.")
      .def_ro("watts", &DesignTotals::watts,
              "Electrical power that all luminaires take, W; None if a luminaire does not tell it.")
      .def_ro("least_maintenance_factor", &DesignTotals::least_maintenance_factor, "The lowest; NaN: unknown.")
      .def_ro("greatest_maintenance_factor", &DesignTotals::greatest_maintenance_factor, "The highest; NaN: unknown.");
  nb::class_<DesignComparison>(module, "DesignComparison",
                               "Two designs side by side: their calculation areas, with the differences. str() of it "
                               "is a table.")
      .def_ro("a", &DesignComparison::a, "Folder of the first design.")
      .def_ro("b", &DesignComparison::b, "Folder of the second design.")
      .def_ro("unit", &DesignComparison::unit, "Of power: 'W' or 'lm'.")
      .def_ro("areas", &DesignComparison::areas, "A list of DesignAreas: those of a, then those that b alone has.")
      .def_ro("total_a", &DesignComparison::total_a, "DesignTotals of the first design.")
      .def_ro("total_b", &DesignComparison::total_b, "DesignTotals of the second design.")
      .def("__str__", [](const DesignComparison& designs) { return designs_text(designs); })
      .def("__repr__", [](const DesignComparison& designs) {
        return "<lichtmc.DesignComparison of '" + designs.a + "' and '" + designs.b + "', " +
               std::to_string(designs.areas.size()) + (designs.areas.size() == 1 ? " area>" : " areas>");
      });
}

}  // namespace

void bind_compare(nb::module_& module) {
  bind_comparison(module);
  bind_designs(module);
  module.def(
      "compare",
      [](const RunResult& a, const RunResult& b) {
        const nb::gil_scoped_release without_lock;
        return shared(compare(a.result, b.result));
      },
      nb::arg("a"), nb::arg("b"), "See lichtmc.compare().");
  module.def(
      "compare_folders",
      [](const std::filesystem::path& a, const std::filesystem::path& b) {
        const nb::gil_scoped_release without_lock;
        return shared(compare_results(a, b));
      },
      nb::arg("a"), nb::arg("b"), "See lichtmc.compare().");
  module.def(
      "compare_designs",
      [](const std::filesystem::path& a, const std::filesystem::path& b) { return compare_designs(a, b); },
      nb::arg("a"), nb::arg("b"), nb::call_guard<nb::gil_scoped_release>(),
      "Two designs side by side: the calculation areas of the results, or of scenes, in two folders.\n\n"
      "A difference is no fault. Raises InputError if a folder contains no result or no areas, or if units differ.");
}

}  // namespace lichtmc::python
