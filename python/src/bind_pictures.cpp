// Pictures of results as arrays; and the plots of lichtmc._plot, which need matplotlib.
#include <nanobind/stl/optional.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/string_view.h>
#include <nanobind/stl/vector.h>

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bindings.hpp"
#include "lichtmc/error.hpp"
#include "lichtmc/output.hpp"
#include "lichtmc/picture.hpp"
#include "named_values.hpp"
#include "run_result.hpp"
#include "views.hpp"

namespace lichtmc::python {

namespace {

struct DrawnPicture {
  RunResultPtr run;
  lichtmc::View view;
  ColourScale scale;
  Picture picture;
  std::vector<std::uint8_t> rgba;
};
using DrawnPicturePtr = std::shared_ptr<DrawnPicture>;

// At least 16, as the library wants it, and a whole number.
std::size_t pixels(std::string_view what, std::int64_t value) {
  constexpr std::int64_t least = 16;
  constexpr std::int64_t most = 16'384;
  if (value < least || value > most)
    throw InputError("The " + std::string(what) + " of the picture is " + std::to_string(value) +
                     " (allowed: 16 to 16384 pixels). Give another number.");
  return static_cast<std::size_t>(value);
}

DrawnPicturePtr render(const RunResultPtr& run, std::string_view view_name, std::int64_t width, std::int64_t height,
                       std::string_view colours, std::string_view scale_type, std::optional<double> scale_max,
                       unsigned threads) {
  const lichtmc::View view =
      named<lichtmc::View>("view", view_name, {{"corner", lichtmc::View::corner}, {"above", lichtmc::View::above}});
  ScaleOptions options;
  options.colours = named("colours", colours, {ColourMap::viridis, ColourMap::inferno});
  options.type = named<ScaleType>(
      "scale", scale_type,
      {{"automatic", ScaleType::automatic}, {"linear", ScaleType::linear}, {"logarithmic", ScaleType::logarithmic}});
  options.high = scale_max;
  const std::size_t columns = pixels("width", width);
  const std::size_t rows = pixels("height", height);
  const nb::gil_scoped_release without_lock;
  const ColourScale scale = choose_scale(run->result, options);
  const RoomPainter painter(run->room->room, run->result, threads, run->room->prepared(threads));
  Picture picture = painter.draw(view, scale, columns, rows);
  std::vector<std::uint8_t> rgba = rgba_of(picture);
  return std::make_shared<DrawnPicture>(DrawnPicture{run, view, scale, std::move(picture), std::move(rgba)});
}

View<std::uint8_t> pixels_of(const DrawnPicturePtr& drawn) {
  return shaped(drawn, drawn->rgba, std::array<std::size_t, 3>{drawn->picture.height, drawn->picture.width, 4});
}

nb::bytes png_bytes(const DrawnPicturePtr& drawn) {
  std::string png;
  {
    const nb::gil_scoped_release without_lock;
    png = png_of(drawn->picture);
  }
  return nb::bytes(png.data(), png.size());
}

std::string svg_text(const DrawnPicturePtr& drawn) {
  const nb::gil_scoped_release without_lock;
  return room_svg(drawn->run->room->room, drawn->run->result, drawn->picture, png_of(drawn->picture), drawn->scale,
                  drawn->view);
}

void bind_picture(nb::module_& module) {
  nb::class_<DrawnPicture>(module, "Picture",
                           "A picture of a room in false colour. numpy.asarray(picture) is rgba. A notebook shows it "
                           "with its colour scale.")
      .def_prop_ro("rgba", &pixels_of, has_owner,
                   "Red, green, blue (sRGB) and opacity, uint8 (height, width, 4), row 0 at the top.")
      .def_prop_ro(
          "irradiance",
          [](const DrawnPicturePtr& drawn) {
            return shaped(drawn, drawn->picture.irradiance,
                          std::array<std::size_t, 2>{drawn->picture.height, drawn->picture.width});
          },
          has_owner,
          "Mean irradiance (W/m²) or illuminance (lx) of the surfaces in each pixel, float32 (height, width); NaN "
          "without a surface.")
      .def_prop_ro(
          "view", [](const DrawnPicture& drawn) { return drawn.view == lichtmc::View::corner ? "corner" : "above"; },
          "'corner' or 'above'.")
      .def_prop_ro(
          "low", [](const DrawnPicture& drawn) { return drawn.scale.low; },
          "W/m² or lx at the bottom of the colour scale.")
      .def_prop_ro(
          "high", [](const DrawnPicture& drawn) { return drawn.scale.high; },
          "W/m² or lx at the top of the colour scale.")
      .def_prop_ro(
          "logarithmic", [](const DrawnPicture& drawn) { return drawn.scale.logarithmic; },
          "Whether the colour scale is logarithmic.")
      .def_prop_ro(
          "colours", [](const DrawnPicture& drawn) { return to_string(drawn.scale.colours); },
          "'viridis' or 'inferno', as in matplotlib.")
      .def_prop_ro(
          "cut_height", [](const DrawnPicture& drawn) { return drawn.picture.cut_y_m; },
          "y in m above which the room is not drawn; None if all is drawn.")
      .def_prop_ro(
          "from_inside", [](const DrawnPicture& drawn) { return drawn.picture.from_inside; },
          "Whether the room is drawn from inside.")
      .def_prop_ro("svg", &svg_text,
                   "The picture with title, colour scale and marks for emitters and receivers, as an SVG file.")
      .def(
          "__array__",
          [](const DrawnPicturePtr& drawn, nb::object dtype, nb::object copy) {
            return as_array(nb::cast(pixels_of(drawn), has_owner), dtype, copy);
          },
          nb::arg("dtype").none() = nb::none(), nb::arg("copy").none() = nb::none(), "The pixels, see rgba.")
      .def("_repr_png_", &png_bytes, "The pixels as a PNG file.")
      .def("_repr_svg_", &svg_text, "See svg.")
      .def("__repr__", [](const DrawnPicture& drawn) {
        return "Picture(" + std::to_string(drawn.picture.width) + " × " + std::to_string(drawn.picture.height) +
               " pixels, view '" + (drawn.view == lichtmc::View::corner ? "corner" : "above") + "')";
      });
}

// A method that lichtmc._plot has as a function; matplotlib is imported when it is called.
template <class... Extra>
void bind_plot(nb::class_<RunResult>& of, const char* name, const Extra&... extra) {
  of.def(
      name,
      [name](nb::object result, nb::args positional, nb::kwargs named) {
        return nb::module_::import_("lichtmc._plot").attr(name)(result, *positional, **named);
      },
      extra...);
}

}  // namespace

void bind_pictures(nb::module_& module) {
  bind_picture(module);
  auto result = nb::borrow<nb::class_<RunResult>>(nb::type<RunResult>());
  result.def("render", &render, nb::arg("view") = "corner", nb::kw_only(), nb::arg("width") = 960,
             nb::arg("height") = 720, nb::arg("colours") = "viridis", nb::arg("scale") = "automatic",
             nb::arg("scale_max").none() = nb::none(), nb::arg("threads") = 0,
             "Draws the room in false colour; grey if its tiles were not measured.\n\n"
             "view: 'corner', oblique from above, or 'above', a plan. width, height: pixels, 16 … 16384. colours: "
             "'viridis' or 'inferno'. scale: 'automatic', 'linear' or 'logarithmic'; scale_max: W/m² or lx at its top, "
             "by default a round number that 98 % of the lit area do not exceed. threads: 0: one per processor.");
  bind_plot(
      result, "plot_surface",
      nb::sig("def plot_surface(self, surface: str | int, ax: typing.Any = None, *, error: bool = False, "
              "isolines: bool | int | collections.abc.Sequence[float] = False, colours: str = 'viridis', "
              "scale: str = 'linear', scale_max: float | None = None) -> typing.Any"),
      "Plots the irradiance of a surface; returns the Axes of matplotlib (pip install \"lichtmc[plot]\").\n\n"
      "surface: name or number, see surfaces. ax: Axes to draw into; by default of a new figure. error: plots "
      "the standard error instead. isolines: True, how many, or their values; they are smoothed by up to 2.5 tiles, by "
      "the size of the errors. scale: 'linear' or 'logarithmic'; scale_max: W/m² or lx at the top of the colours, by "
      "default what 99 % of the area do not exceed. A flat surface is drawn to scale, its axes in m: level ones from "
      "above, walls from the middle of the room; others by column and row of their tiles. Cells without a tile, and "
      "tiles that light cannot reach, are white.");
  bind_plot(result, "plot_area",
            nb::sig("def plot_area(self, area: str | int, ax: typing.Any = None, *, error: bool = False, "
                    "values: bool = True, isolines: bool | int | collections.abc.Sequence[float] = False, "
                    "colours: str = 'viridis', scale: str = 'linear', scale_max: float | None = None) -> typing.Any"),
            "Plots the grid of a calculation area; returns the Axes of matplotlib (pip install \"lichtmc[plot]\").\n\n"
            "area: name or number, see areas. values: writes the value of each point into its cell, if the grid has at "
            "most 400 cells. The other arguments are those of plot_surface().");
  bind_plot(
      result, "plot_channel",
      nb::sig("def plot_channel(self, emitter: int | str = 0, receiver: int | str = 0, ax: typing.Any = None, *, "
              "stacked: bool = True, log: bool = False, errors: bool = True, unit: str = 'ns') -> typing.Any"),
      "Plots an impulse response h(t) by order of reflection; returns the Axes of matplotlib (pip install "
      "\"lichtmc[plot]\").\n\n"
      "emitter, receiver: number or name, see channels. stacked: areas that add up to h(t); otherwise lines. log: "
      "logarithmic h axis (then lines). errors: shows ± one standard error of the sum. unit: of the times, 'ns', "
      "'us', 'ms' or 's'.");
}

}  // namespace lichtmc::python
