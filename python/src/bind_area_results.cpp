// The calculation areas of a result or scene, with their figures.
#include <nanobind/stl/map.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/string_view.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <vector>

#include "bindings.hpp"
#include "figures.hpp"
#include "grids.hpp"
#include "lichtmc/output.hpp"
#include "named_elements.hpp"
#include "result_parts.hpp"

namespace lichtmc::python {

namespace {

auto grid(double ReceiverResult::*member) {
  return [member](const OneArea& one) {
    const Area& area = one.area();
    const std::span<const ReceiverResult> results(*one.of.results);
    return grid_of(one.of.owner, results.subspan(area.first_receiver, area.cells.size()), member,
                   {area.rows, area.columns}, [&area](std::size_t k) { return std::size_t{area.cells[k]}; });
  };
}

// Cells without a point have a centre too.
View<double> centres(const OneArea& one) {
  const Area& area = one.area();
  std::vector<double> values;
  for (std::uint32_t cell = 0; cell < area.rows * area.columns; ++cell) {
    const glm::dvec3 centre = area.centre(cell);
    values.insert(values.end(), {centre.x, centre.y, centre.z});
  }
  return owned(std::move(values), std::array<std::size_t, 3>{area.rows, area.columns, 3});
}

View<double> vector(const OneArea& one, const glm::dvec3& of_area) {
  return strided(one.of.owner, &of_area.x, std::array<std::size_t, 1>{3}, std::array<std::int64_t, 1>{1});
}

auto figure(Figure AreaResult::*member) {
  return [member](const OneArea& one) { return one.figures().*member; };
}

auto verdict(Verdict AreaResult::*member) {
  return [member](const OneArea& one) { return to_string(one.figures().*member); };
}

// "; left out: 3 points outside the rooms", and the notes; empty without either.
std::string omissions_text(const Area& area) {
  std::string text;
  for (const AreaLeftOut& some : area.left_out)
    text += (text.empty() ? "; left out: " : ", ") + std::to_string(some.points) +
            (some.points == 1 ? " point " : " points ") + some.why;
  for (const std::string& note : area.notes) text += "; " + note.substr(0, note.size() - (note.ends_with('.') ? 1 : 0));
  return text;
}

void bind_figures_of(nb::class_<OneArea>& of) {
  of.def_prop_ro("mean", figure(&AreaResult::mean),
                 "Mean irradiance (W/m²) or illuminance Em (lx), maintained: with the emitters' maintenance factors.")
      .def_prop_ro("minimum", figure(&AreaResult::minimum),
                   "Lowest irradiance, same unit, corrected for the statistical errors of the points.")
      .def_prop_ro("maximum", figure(&AreaResult::maximum),
                   "Highest irradiance, same unit, corrected for the statistical errors of the points.")
      .def_prop_ro("uniformity", figure(&AreaResult::uniformity), "U0 = minimum / mean.")
      .def_prop_ro("diversity", figure(&AreaResult::diversity), "Ud = minimum / maximum.")
      .def_prop_ro("initial_mean", figure(&AreaResult::initial_mean), "The mean with new emitters.")
      .def_prop_ro("initial_minimum", figure(&AreaResult::initial_minimum), "The minimum with new emitters.")
      .def_prop_ro("initial_maximum", figure(&AreaResult::initial_maximum), "The maximum with new emitters.")
      .def_prop_ro(
          "lowest", [](const OneArea& one) { return one.figures().lowest; },
          "Lowest value of grid, with its statistical error.")
      .def_prop_ro(
          "highest", [](const OneArea& one) { return one.figures().highest; },
          "Highest value of grid, with its statistical error.")
      .def_prop_ro(
          "target_lx", [](const OneArea& one) { return one.area().properties.target_lx; },
          "Target of the mean, lx; None without.")
      .def_prop_ro(
          "target_uniformity", [](const OneArea& one) { return one.area().properties.target_uniformity; },
          "Target of U0; None without.")
      .def_prop_ro("verdict", verdict(&AreaResult::verdict),
                   "Whether both targets are met: 'pass', 'fail', 'undecided' (a target is less than two standard "
                   "errors away), or '' without a target.")
      .def_prop_ro("mean_verdict", verdict(&AreaResult::mean_verdict), "The same for the mean alone.")
      .def_prop_ro("uniformity_verdict", verdict(&AreaResult::uniformity_verdict), "The same for U0 alone.")
      .def_prop_ro(
          "text", [](const OneArea& one) { return area_line(one.figures(), one.of.quantity); },
          "The figures in a line: 'desk (task): Em 349 ± 2 lx, U0 0.55 ± 0.01, target 500 lx, 0.60: fail'.")
      .def("__repr__", [](const OneArea& one) {
        return "AreaResult(" + area_line(one.figures(), one.of.quantity) + omissions_text(one.area()) + ")";
      });
}

void bind_layout_of(nb::class_<OneArea>& of) {
  of.def_prop_ro("name", [](const OneArea& one) { return one.area().properties.name; })
      .def_prop_ro(
          "role", [](const OneArea& one) { return one.area().properties.role; },
          "'task', 'surrounding', 'background', 'wall', 'ceiling' or any text; may be empty.")
      .def_prop_ro(
          "quantity", [](const OneArea& one) { return to_string(one.area().quantity); },
          "What is measured at its points: 'normal', 'horizontal', 'cylindrical' or 'semicylindrical'.")
      .def_prop_ro(
          "points", [](const OneArea& one) { return one.area().cells.size(); }, "Number of points.")
      .def_prop_ro(
          "columns", [](const OneArea& one) { return one.area().columns; }, "Columns of the grid.")
      .def_prop_ro(
          "rows", [](const OneArea& one) { return one.area().rows; }, "Rows of the grid.")
      .def_prop_ro(
          "receivers",
          [](const OneArea& one) {
            return nb::slice(one.area().first_receiver, one.area().first_receiver + one.area().cells.size());
          },
          "Where its points are in the arrays of receivers and of Result.parts, in the order of the cells that have "
          "one.")
      .def_prop_ro(
          "left_out",
          [](const OneArea& one) {
            std::map<std::string, std::uint64_t> reasons;
            for (const AreaLeftOut& some : one.area().left_out) reasons[some.why] += some.points;
            return reasons;
          },
          "Cells without a point: their number, by the reason. What the margin leaves out of the grid as a whole is in "
          "notes.")
      .def_prop_ro(
          "notes", [](const OneArea& one) { return one.area().notes; },
          "What else one should know, sentences: what the usual margin leaves out, points that lie on table tops.")
      .def_prop_ro(
          "margin", [](const OneArea& one) { return one.area().margin_m; },
          "Distance from the walls or edges within which cells have no point, m.")
      .def_prop_ro(
          "above_floor", [](const OneArea& one) { return one.area().above_floor_m; },
          "Height above the floor, m; None if it is not level or has no floor below.")
      .def_prop_ro(
          "corner", [](const OneArea& one) { return vector(one, one.area().corner); }, has_owner,
          "Corner of the grid, m, float64 (3,). The cell (row, column) has its centre at corner + (column + ½) u + "
          "(row + ½) v.")
      .def_prop_ro(
          "u", [](const OneArea& one) { return vector(one, one.area().u); }, has_owner,
          "Edge of a cell along a row, m, float64 (3,).")
      .def_prop_ro(
          "v", [](const OneArea& one) { return vector(one, one.area().v); }, has_owner,
          "Edge of a cell along a column, m, float64 (3,).")
      .def_prop_ro(
          "normal", [](const OneArea& one) { return vector(one, one.area().normal); }, has_owner,
          "Direction of the side that is measured, length 1, float64 (3,).");
}

NamedElements elements(const AreaResults& areas) {
  const std::vector<AreaResult>& all = *areas.of.areas;
  return {"area", "areas", all.size(),
          [&all](std::size_t k) -> const std::string& { return all[k].area.properties.name; }};
}

}  // namespace

void bind_area_results(nb::module_& module) {
  nb::class_<OneArea> one(module, "AreaResult", "A calculation area with its figures and the grid of its points.");
  bind_figures_of(one);
  bind_layout_of(one);
  one.def_prop_ro("position", &centres, has_owner, "Centres of the cells, m, float64 (rows, columns, 3). A copy.")
      .def_prop_ro("grid", grid(&ReceiverResult::irradiance), has_owner,
                   "Irradiance (W/m²) or illuminance (lx) at the points, float64 (rows, columns); NaN in cells without "
                   "a point. A view of the receivers without a copy if every cell has a point.")
      .def_prop_ro("grid_error", grid(&ReceiverResult::standard_error), has_owner,
                   "Standard errors of grid, same unit and shape.")
      .def_prop_ro("grid_direct", grid(&ReceiverResult::direct), has_owner,
                   "Direct part of grid, same unit and shape.");
  nb::class_<AreaResults> all(module, "AreaResults", "The calculation areas by name, as a dict; also by number.");
  bind_mapping(all, "AreaResult", elements, [](const AreaResults& areas, std::size_t k) {
    return OneArea{areas.of, k};
  });
  all.def("__repr__", [](const AreaResults& areas) {
    std::string text;
    for (const AreaResult& area : *areas.of.areas) text += "\n  " + area_line(area, areas.of.quantity);
    return text.empty() ? std::string("AreaResults()") : "AreaResults:" + text;
  });
}

}  // namespace lichtmc::python
