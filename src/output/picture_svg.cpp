#include "output/picture_svg.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>

#include <ImfHeader.h>
#include <ImfStringAttribute.h>
#include <glm/geometric.hpp>

#include "base/message.hpp"
#include "base/png.hpp"
#include "lichtmc/units.hpp"
#include "lichtmc/version.hpp"
#include "output/exr.hpp"
#include "output/isoline_marks.hpp"
#include "output/picture_marks.hpp"
#include "output/picture_parts.hpp"
#include "output/svg.hpp"
#include "room/measured_surfaces.hpp"

namespace lichtmc {

namespace {

std::string scale_words(const ColourScale& scale) {
  return scale.logarithmic ? "logarithmic scale; " : "";
}

// The kind of view, and what it leaves out.
std::string title_of(const Result& result, const Picture& picture, View view) {
  std::string title = result.quantity == Quantity::photometric ? "Illuminance" : "Irradiance";
  if (result.tiles.empty()) title += result.areas.empty() ? " at the receivers" : " on the calculation areas";
  title += picture.from_inside ? ", view from inside" : view == View::corner ? ", oblique view" : ", view from above";
  if (picture.cut_y_m) title += ", cut open: what lies above y = " + short_number(*picture.cut_y_m) + " m is not drawn";
  return title;
}

constexpr double plan_side = 480.0;  // units of a plan's longer side

}  // namespace

std::vector<std::uint8_t> rgba_of(const Picture& picture) {
  std::vector<std::uint8_t> pixels;
  pixels.reserve(4 * picture.colour.size());
  const auto byte = [](double value) {
    return static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(value, 0.0, 1.0)));
  };
  // Most pixels equal the previous one: their bytes are reused.
  glm::vec4 last(0.0F);
  std::array<std::uint8_t, 4> bytes{};
  for (const glm::vec4& colour : picture.colour) {
    if (colour != last) {
      const double cover = colour.a;
      for (int c = 0; c < 3; ++c)
        bytes[static_cast<std::size_t>(c)] = cover > 0.0 ? byte(srgb_of_light(colour[c] / cover)) : std::uint8_t{0};
      bytes[3] = byte(cover);
      last = colour;
    }
    pixels.insert(pixels.end(), bytes.begin(), bytes.end());
  }
  return pixels;
}

std::string png_of(const Picture& picture) {
  return png_file(picture.width, picture.height, 4, rgba_of(picture));
}

std::string exr_of(const Picture& picture, const Result& result) {
  Imf::Header header(static_cast<int>(picture.width), static_cast<int>(picture.height));
  header.insert("unit", Imf::StringAttribute(std::string(irradiance_unit(result.quantity))));
  header.insert("software", Imf::StringAttribute("lichtmc " + std::string(version())));
  header.insert("comments", Imf::StringAttribute(
                                "R, G, B: false colour, linear, premultiplied by A; A: covered share of the "
                                "pixel; Y: irradiance in the unit of the attribute 'unit', NaN without a surface"));
  std::vector<ExrChannel> channels{{"R", {}}, {"G", {}}, {"B", {}}, {"A", {}}, {"Y", picture.irradiance}};
  for (std::size_t c = 0; c < 4; ++c) {
    channels[c].values.reserve(picture.colour.size());
    for (const glm::vec4& colour : picture.colour) channels[c].values.push_back(colour[static_cast<int>(c)]);
  }
  return exr_file(header, std::move(channels), "a picture");
}

std::string room_svg(const Room& room, const Result& result, const Picture& picture, const std::string& png,
                     const ColourScale& scale, View view) {
  constexpr double width = 900.0;  // of the picture, in units
  const double unit = width / static_cast<double>(picture.width);
  const double height = unit * static_cast<double>(picture.height);
  const double legend_height = height - 40.0;
  std::string svg;  // of all but the head, which needs the height
  svg += svg_image(png, picture_side, picture_top, width, height, false);
  PictureMarks marks(picture, unit, {picture_side, picture_top});
  svg += marks.areas(result, scale, result.tiles.empty(), view);
  svg += marks.receivers(result, scale);
  svg += marks.emitters(room);
  svg += colour_legend(scale, written_irradiance_unit(result.quantity), picture_side + width, picture_top + 20.0,
                       legend_height);

  std::string note = scale_words(scale) + "sides of surfaces without light are not drawn" +
                     (result.tiles.empty() ? "; grey: the room, whose surfaces are not measured"
                      : measures_all(room) ? ""
                                           : "; grey: surfaces that are not measured") +
                     (result.areas.empty() ? "" : "; dashed: calculation areas") + marks.left_out();
  double y = picture_top + height + 18.5;
  double start = picture_side;
  if (view == View::above) {
    const double metre = unit * glm::length(glm::dvec2(picture.to_pixel * glm::dvec4(1.0, 0.0, 0.0, 0.0)));
    svg += scale_bar(metre, width, picture_side, y - 4.5, start);
    start += 24.0;
    note = "+x to the right, +z downwards; " + note;
  }
  if (text_width(note, note_size) > picture_side + width - start) {  // below the scale bar
    y += view == View::above ? 18.0 : 0.0;
    start = picture_side;
  }
  svg += svg_notes(note, start, y, picture_side + width - start);
  return svg_head(picture_side + width + legend_width(scale, legend_height), y, title_of(result, picture, view),
                  picture_side) +
         svg + "</svg>\n";
}

std::string plan_svg(const Result& result, const SurfacePlan& plan, const std::string& png, const ColourScale& scale,
                     const std::string& name) {
  constexpr double least_width = 360.0;  // for the text
  const Picture& picture = plan.picture;
  const double unit = plan_side / static_cast<double>(std::max(picture.width, picture.height));
  const double width = unit * static_cast<double>(picture.width);
  const double height = unit * static_cast<double>(picture.height);
  const double legend_height = std::max(height, 150.0) - 20.0;
  const double canvas = picture_side + std::max(width, least_width) + legend_width(scale, legend_height);
  const std::string irradiance(irradiance_unit(result.quantity));
  std::string svg;  // of all but the head, which needs the height
  double y = 50.0;
  for (const std::string& line :
       text_lines("mean " + short_number(plan.mean_irradiance) + " " + irradiance + "; tiles from " +
                      short_number(plan.min_irradiance) + " to " + short_number(plan.max_irradiance) + " " + irradiance,
                  text_size, canvas - 2.0 * picture_side)) {
    svg += svg_text(picture_side, y, line, " class=\"muted\"");
    y += 18.0;
  }
  svg += svg_image(png, picture_side, y, width, height, true);
  const glm::dvec2 at(picture_side, y);
  svg += isoline_strokes(plan.isolines, unit, at);
  svg += LabelPlaces({0.0, 10.0}, {width, height - 8.0}).isoline_labels(plan.isolines, unit, at, text_size);
  svg += colour_legend(scale, written_irradiance_unit(result.quantity), picture_side + width, y + 10.0, legend_height);
  y += legend_height + 38.5;
  if (plan.flat) {
    double end = 0.0;
    svg += scale_bar(unit / glm::length(plan.across), width, picture_side, y - 4.5, end);
    y += 18.0;
  }
  std::string note = plan.why_no_isolines;
  if (note.empty()) note = "Isolines, smoothed over " + short_number(plan.smoothing_m) + " m (Gaussian).";
  svg += svg_notes(scale_words(scale) + note, picture_side, y, canvas - 2.0 * picture_side);
  return svg_head(canvas, y, name, picture_side) + svg + "</svg>\n";
}

std::vector<std::string> plan_names(const Result& result, const std::vector<SurfacePlan>& plans) {
  std::map<std::size_t, std::size_t> count;
  for (const SurfacePlan& plan : plans) ++count[plan.map];
  std::map<std::size_t, std::size_t> number;
  std::vector<std::string> names;
  for (const SurfacePlan& plan : plans) {
    std::string name = result.tiling.maps[plan.map].name;
    if (count[plan.map] > 1) name += " (" + std::to_string(++number[plan.map]) + ")";
    names.push_back(std::move(name));
  }
  return names;
}

}  // namespace lichtmc
