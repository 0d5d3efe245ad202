// Pictures of results as arrays; and the plots of lichtmc._plot, which need matplotlib.
#include <nanobind/stl/optional.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/string_view.h>
#include <nanobind/stl/vector.h>

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "arguments.hpp"
#include "bindings.hpp"
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

DrawnPicturePtr render(const RunResultPtr& run, nb::handle view_name, nb::handle width, nb::handle height,
                       nb::handle colours, nb::handle scale_type, nb::handle scale_max, nb::handle number_of_threads) {
  constexpr std::int64_t least_size = 16;  // pixels, as RoomPainter::draw() allows
  constexpr std::int64_t greatest_size = 16'384;
  const auto view = named<lichtmc::View>("view", text_of(view_name, "argument view"),
                                         {{"corner", lichtmc::View::corner}, {"above", lichtmc::View::above}});
  ScaleOptions options;
  options.colours = named("colours", text_of(colours, "argument colours"), {ColourMap::viridis, ColourMap::inferno});
  options.type = named<ScaleType>(
      "scale", text_of(scale_type, "argument scale"),
      {{"auto", ScaleType::automatic}, {"linear", ScaleType::linear}, {"log", ScaleType::logarithmic}});
  options.high = optional_number(scale_max, "argument scale_max");
  const std::int64_t columns = whole_number_of(width, "width of the picture in pixels", least_size, greatest_size);
  const std::int64_t rows = whole_number_of(height, "height of the picture in pixels", least_size, greatest_size);
  const auto threads = static_cast<unsigned>(
      whole_number_of(number_of_threads, "number of threads", 0, std::numeric_limits<int>::max()));
  const nb::gil_scoped_release without_lock;
  const ColourScale scale = choose_scale(run->result, options);
  const RoomPainter painter(run->room->room, run->result, threads, run->room->prepared(threads));
  Picture picture = painter.draw(view, scale, static_cast<std::size_t>(columns), static_cast<std::size_t>(rows));
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
          nb::arg("dtype").none() = nb::none(), nb::arg("copy").none() = nb::none(),
          nb::sig("def __array__(self, dtype: typing.Any = None, copy: bool | None = None) -> "
                  "numpy.typing.NDArray[typing.Any]"),
          "The pixels, see rgba.")
      .def_prop_ro(
          "irradiance_unit", [](const DrawnPicture& drawn) { return irradiance_unit(drawn.run->room->room.quantity); },
          "'lx' or 'W/m^2': of irradiance, low and high.")
      .def(
          "save",
          [](nb::object picture, nb::object path) {
            nb::module_::import_("lichtmc._pictures").attr("save")(picture, path);
          },
          nb::arg("path").none(), nb::sig("def save(self, path: str | os.PathLike[str]) -> None"),
          "Writes the picture into a file: .png, the pixels with their opacity; or .svg, with title and colour "
          "scale.\n\nA file that exists is replaced when the new one is complete. Raises InputError if the name ends "
          "otherwise, RuntimeError if the file cannot be written.")
      .def(
          "plot",
          [](nb::object picture, nb::object ax) {
            return nb::module_::import_("lichtmc._plot").attr("plot_picture")(picture, ax);
          },
          nb::arg("ax").none() = nb::none(), nb::sig("def plot(self, ax: typing.Any = None) -> typing.Any"),
          "Shows the picture with a colour bar and its unit; returns the Axes of matplotlib (pip install "
          "\"lichtmc[plot]\"). ax: Axes to draw into; by default of a new figure.")
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
  result.def(
      "render", &render, nb::arg("view").none() = "corner", nb::kw_only(), nb::arg("width").none() = 960,
      nb::arg("height").none() = 720, nb::arg("colours").none() = "viridis", nb::arg("scale").none() = "auto",
      nb::arg("scale_max").none() = nb::none(), nb::arg("threads").none() = 0,
      nb::sig("def render(self, view: str = 'corner', *, width: int = 960, height: int = 720, colours: str = "
              "'viridis', scale: str = 'auto', scale_max: float | None = None, threads: int = 0) -> "
              "Picture"),
      "Draws the room in false colour; grey if its tiles were not measured.\n\nview: 'corner', oblique from above, or "
      "'above', a plan. width, height: pixels, 16 … 16384. colours: 'viridis' or 'inferno'. scale: 'linear', 'log' "
      "(logarithmic), or 'auto': 'log' if the brightest tiles have more than 10 times the median; scale_max: W/m² or "
      "lx at its top, by default a round number that 98 % of the lit area do not exceed. threads: 0: one per "
      "processor.");
  bind_plot(
      result, "plot_surface",
      nb::sig("def plot_surface(self, surface: str | int, ax: typing.Any = None, *, error: bool = False, "
              "isolines: bool | int | collections.abc.Sequence[float] = False, colours: str = 'viridis', "
              "scale: str = 'auto', scale_max: float | None = None) -> typing.Any"),
      "Plots the irradiance of a surface; returns the Axes of matplotlib (pip install \"lichtmc[plot]\").\n\nsurface: "
      "name or number, see surfaces. ax: Axes to draw into; by default of a new figure. error: plots the standard "
      "error instead. isolines: True, how many, or their values (W/m² or lx); for them the noise is smoothed over up "
      "to 2.5 tiles, but only where this changes the value of a tile by less than three standard errors: at edges of "
      "shadows the lines follow the tiles. scale: 'linear', 'log' (logarithmic), or 'auto', as in render(); "
      "scale_max: W/m² or lx at the top of the colours, by default what 99 % of the area do not exceed. A flat "
      "surface is drawn to scale, its axes in m: level ones from above, walls from the middle of the room; others by "
      "column and row of their tiles. Cells without a tile, and tiles that light cannot reach, are white. Tiles where "
      "no photon arrived, as under a carpet, are hatched.");
  bind_plot(result, "plot_area",
            nb::sig("def plot_area(self, area: str | int, ax: typing.Any = None, *, error: bool = False, "
                    "values: bool = True, isolines: bool | int | collections.abc.Sequence[float] = False, "
                    "colours: str = 'viridis', scale: str = 'auto', scale_max: float | None = None) -> typing.Any"),
            "Plots the grid of a calculation area; returns the Axes of matplotlib (pip install \"lichtmc[plot]\").\n\n"
            "area: name or number, see areas. values: writes the value of each point into its cell, if the grid has at "
            "most 400 cells. The other arguments are those of plot_surface().");
  bind_plot(
      result, "plot_channel",
      nb::sig("def plot_channel(self, emitter: int | str = 0, receiver: int | str = 0, ax: typing.Any = None, *, "
              "stacked: bool = True, log: bool | None = None, errors: bool = True, unit: str = 'ns') -> typing.Any"),
      "Plots an impulse response h(t) by order of reflection; returns the Axes of matplotlib (pip install "
      "\"lichtmc[plot]\").\n\nemitter, receiver: number or name, see channels. stacked: areas that add up to h(t); "
      "otherwise lines. log: logarithmic h axis, with a line for the sum and each order; by default if most of the "
      "time axis would be empty on a linear one. errors: shows ± one standard error of the sum. unit: of the times, "
      "'ns', 'us', 'ms' or 's'. Where the standard error of the sum is more than 20 %, up to a 20th of the bins are "
      "shown together, as their mean; its standard error is drawn as if they were independent.");
}

}  // namespace lichtmc::python
