#include "output/picture_svg.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>

#include <ImfHeader.h>
#include <ImfStringAttribute.h>
#include <glm/geometric.hpp>

#include "base/base64.hpp"
#include "base/message.hpp"
#include "base/png.hpp"
#include "lichtmc/lit_room.hpp"
#include "lichtmc/version.hpp"
#include "output/exr.hpp"
#include "output/readable.hpp"
#include "output/svg.hpp"
#include "room/emitter_place.hpp"
#include "room/welded_mesh.hpp"

namespace lichtmc {

namespace {

constexpr double top = 46.0;  // of the picture, below the title
constexpr double legend_width = 110.0;
constexpr double side = 14.0;

std::string image_of(const std::string& png, double x, double y, double width, double height, bool pixelated) {
  return "<image x=\"" + fixed(x) + "\" y=\"" + fixed(y) + "\" width=\"" + fixed(width) + "\" height=\"" +
         fixed(height) + "\" preserveAspectRatio=\"none\"" + (pixelated ? " image-rendering=\"pixelated\"" : "") +
         " href=\"data:image/png;base64," + base64(png) + "\"/>\n";
}

// Round values on a scale.
std::vector<double> ticks_of(const ColourScale& scale) {
  std::vector<double> ticks;
  if (scale.logarithmic) {
    const int last = static_cast<int>(std::floor(std::log10(scale.high)));
    for (int exponent = static_cast<int>(std::floor(std::log10(scale.low))); exponent <= last; ++exponent) {
      const double decade = std::pow(10.0, exponent);
      for (const double step : {1.0, 2.0, 5.0}) {
        const double value = step * decade;
        if (value >= scale.low * 0.999 && value <= scale.high * 1.001) ticks.push_back(value);
      }
    }
    return ticks;
  }
  const double decade = std::pow(10.0, std::floor(std::log10(scale.high / 5.0)));
  const double rough = scale.high / 5.0 / decade;
  const double step = decade * (rough > 5.0 ? 10.0 : rough > 2.0 ? 5.0 : rough > 1.0 ? 2.0 : 1.0);
  for (double k = 0.0; k * step <= scale.high * 1.001; k += 1.0) ticks.push_back(k * step);
  return ticks;
}

// A bar with all colours and their values.
std::string legend(const ColourScale& scale, Quantity quantity, double x, double y, double height) {
  constexpr std::size_t steps = 256;
  constexpr double bar_width = 18.0;
  std::vector<std::uint8_t> pixels;
  for (std::size_t k = 0; k < steps; ++k) {
    const Colour colour = colour_at(scale.colours, 1.0 - static_cast<double>(k) / (steps - 1));
    pixels.insert(pixels.end(), colour.begin(), colour.end());
  }
  std::string svg = svg_text(x, y - 8.0, written_irradiance_unit(quantity));
  svg += image_of(png_file(1, steps, 3, pixels), x, y, bar_width, height, false);
  svg += "<rect x=\"" + fixed(x) + "\" y=\"" + fixed(y) + "\" width=\"" + fixed(bar_width) + "\" height=\"" +
         fixed(height) + "\" class=\"frame\"/>\n";
  for (const double tick : ticks_of(scale)) {
    const double at = y + height * (1.0 - scale.share(tick));
    svg += svg_line(x + bar_width, at, x + bar_width + 5.0, at, "class=\"frame\"");
    svg += svg_text(x + bar_width + 8.0, at + 4.5, short_number(tick));
  }
  return svg;
}

std::string scale_words(const ColourScale& scale) {
  return scale.logarithmic ? "logarithmic scale; " : "";
}

glm::dvec2 pixel_of(const glm::dmat4& to_pixel, const glm::dvec3& place) {
  const glm::dvec4 at = to_pixel * glm::dvec4(place, 1.0);
  return {at.x / at.w, at.y / at.w};
}

std::string css(const Colour& colour) {
  std::array<char, 8> text{};
  std::snprintf(text.data(), text.size(), "#%02x%02x%02x", colour[0], colour[1], colour[2]);
  return text.data();
}

std::string circle(const glm::dvec2& at, double radius, const std::string& attributes, const std::string& title) {
  return "<circle cx=\"" + fixed(at.x) + "\" cy=\"" + fixed(at.y) + "\" r=\"" + fixed(radius) + "\" " + attributes +
         "><title>" + escaped(title) + "</title></circle>\n";
}

// Marks of emitters and receivers. An area light has its mark at the middle of its surface. The powers are shown if
// there are few emitters.
class Overlay {
 public:
  Overlay(const Picture& picture, double unit, double x, double y) : picture_(&picture), unit_(unit), origin_(x, y) {}

  glm::dvec2 at(const glm::dvec3& place) const { return origin_ + unit_ * pixel_of(picture_->to_pixel, place); }

  std::string emitters(const Room& room) const {
    constexpr std::size_t max_marks = 200;
    constexpr std::size_t max_labels = 8;
    const std::size_t n = room.emitters.size();
    std::string svg;
    for (std::size_t k = 0; k < std::min(n, max_marks); ++k) {
      const Emitter& emitter = room.emitters[k];
      const glm::dvec2 p = at(place_of(room, emitter));
      const std::string power = short_number(emitter.power) + " " + std::string(power_unit(room.quantity));
      svg += circle(p, 5.0, "fill=\"#fff7c2\" stroke=\"#000\" stroke-width=\"1.5\"", emitter.name + ": " + power);
      for (int ray = 0; ray < 8; ++ray) {
        const double angle = 0.785398163 * ray;
        const glm::dvec2 direction(std::cos(angle), std::sin(angle));
        svg += svg_line(p.x + 7.0 * direction.x, p.y + 7.0 * direction.y, p.x + 11.0 * direction.x,
                        p.y + 11.0 * direction.y, "stroke=\"#000\" stroke-width=\"1.5\"");
      }
      if (n <= max_labels) svg += svg_text(p.x + 14.0, p.y + 4.0, power, " class=\"halo\" font-size=\"12\"");
    }
    return svg;
  }

  std::string receivers(const Result& result, const ColourScale& scale) const {
    constexpr std::size_t max_marks = 3000;
    std::string svg;
    const std::size_t n = result.receiver_results.size();
    const double radius = n > 300 ? 3.0 : 5.0;
    for (std::size_t k = 0; k < std::min(n, max_marks); ++k) {
      const double value = result.receiver_results[k].irradiance;
      svg += circle(
          at(result.receivers[k].position), radius,
          "fill=\"" + css(colour_of(scale, value)) + "\" stroke=\"#fff\" stroke-width=\"1\"",
          result.receivers[k].name + ": " + short_number(value) + " " + std::string(irradiance_unit(result.quantity)));
    }
    return svg;
  }

 private:
  const Picture* picture_;
  double unit_;
  glm::dvec2 origin_;
};

// A scale bar with a round length in metres.
std::string scale_bar(double units_per_metre, double width, double x, double y) {
  double length = std::pow(10.0, std::floor(std::log10(0.25 * width / units_per_metre)));
  for (const double step : {5.0, 2.0}) {
    if (step * length * units_per_metre <= 0.25 * width) {
      length *= step;
      break;
    }
  }
  const double end = x + length * units_per_metre;
  return svg_line(x, y, end, y, "class=\"frame\" stroke-width=\"2\"") +
         svg_line(x, y - 4.0, x, y + 4.0, "class=\"frame\"") + svg_line(end, y - 4.0, end, y + 4.0, "class=\"frame\"") +
         svg_text(end + 8.0, y + 4.5, short_number(length) + " m", " class=\"muted\" font-size=\"12\"");
}

constexpr double plan_side = 480.0;  // units of a plan's longer side

std::string polyline(const std::vector<glm::dvec2>& points, double unit, double x, double y, std::string_view style) {
  std::string svg = "<polyline fill=\"none\" " + std::string(style) + " points=\"";
  for (const glm::dvec2& p : points) svg += fixed(x + unit * p.x) + "," + fixed(y + unit * p.y) + " ";
  return svg + "\"/>\n";
}

// Isolines: dark over a wider bright line, visible on every colour; then their labels, with a minimum distance.
std::string isolines_svg(const SurfacePlan& plan, double unit, double x, double y) {
  std::string svg;
  for (const Isoline& line : plan.isolines) {
    svg += polyline(line.points, unit, x, y, "stroke=\"#fff\" stroke-opacity=\"0.55\" stroke-width=\"2.6\"");
    svg += polyline(line.points, unit, x, y, "stroke=\"#000\" stroke-width=\"1\"");
  }
  constexpr double min_distance = 44.0;
  std::vector<glm::dvec2> labels;
  const double width = unit * static_cast<double>(plan.picture.width);
  const double height = unit * static_cast<double>(plan.picture.height);
  for (const Isoline& line : plan.isolines) {
    // The first free position along the line, from its middle outwards.
    const std::size_t n = line.points.size();
    for (std::size_t k = 0; k < n; ++k) {
      const std::size_t from_middle = (k + 1) / 2;
      const std::size_t at = k % 2 == 0 ? n / 2 + from_middle : n / 2 - from_middle;
      if (at >= n) continue;
      const glm::dvec2 p = unit * line.points[at];
      if (p.x < 16.0 || p.y < 10.0 || p.x > width - 16.0 || p.y > height - 8.0) continue;
      const bool free = std::none_of(labels.begin(), labels.end(),
                                     [&](const glm::dvec2& other) { return glm::length(other - p) < min_distance; });
      if (!free) continue;
      labels.push_back(p);
      svg += svg_text(x + p.x, y + p.y + 4.0, short_number(line.level),
                      " class=\"halo\" text-anchor=\"middle\" font-size=\"13\"");
      break;
    }
  }
  return svg;
}

// The visible edges of a room: edges that are not shared by exactly two triangles, and edges between planes that differ
// by more than 20°. At most 3000, the longest.
std::vector<std::array<glm::dvec3, 2>> edges_of(const Room& room) {
  constexpr std::size_t max_edges = 3000;
  constexpr double crease_cosine = 0.94;  // cos 20°
  const WeldedMesh mesh(room);
  const auto normal = [&](std::size_t triangle) {
    const WeldedMesh::Corners& c = mesh.corners(triangle);
    const glm::dvec3 cross = glm::cross(c[1] - c[0], c[2] - c[0]);
    const double length = glm::length(cross);
    return length > 0.0 ? cross / length : glm::dvec3(0.0);
  };
  std::vector<std::array<glm::dvec3, 2>> edges;
  for_each_edge(mesh.edges(), [&](std::size_t first, std::size_t end) {
    bool visible = end - first != 2;
    if (!visible)
      visible = std::abs(glm::dot(normal(mesh.edges()[first].triangle), normal(mesh.edges()[first + 1].triangle))) <
                crease_cosine;
    if (visible) edges.push_back({mesh.places()[mesh.edges()[first].from], mesh.places()[mesh.edges()[first].to]});
  });
  const auto longer = [](const auto& a, const auto& b) { return glm::length(a[1] - a[0]) > glm::length(b[1] - b[0]); };
  std::stable_sort(edges.begin(), edges.end(), longer);
  if (edges.size() > max_edges) edges.resize(max_edges);
  return edges;
}

}  // namespace

std::string png_of(const Picture& picture) {
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
  return png_file(picture.width, picture.height, 4, pixels);
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
  const std::string title = std::string(result.quantity == Quantity::photometric ? "Illuminance" : "Irradiance") +
                            (view == View::corner ? ", oblique view" : ", view from above");
  std::string svg = svg_head(side + width + legend_width, top + height + 34.0, title, side);
  svg += image_of(png, side, top, width, height, false);
  const Overlay overlay(picture, unit, side, top);
  svg += overlay.receivers(result, scale);
  svg += overlay.emitters(room);
  svg += legend(scale, result.quantity, side + width + 16.0, top + 20.0, height - 40.0);
  const std::string words = scale_words(scale) + "sides of surfaces without light are not drawn";
  if (view == View::above) {
    const double metre = unit * glm::length(glm::dvec2(picture.to_pixel * glm::dvec4(1.0, 0.0, 0.0, 0.0)));
    svg += scale_bar(metre, width, side, top + height + 14.0);
    svg += svg_text(side + width, top + height + 18.5, "+x to the right, +z downwards; " + words,
                    " class=\"muted\" text-anchor=\"end\" font-size=\"12\"");
  } else {
    svg += svg_text(side + width, top + height + 18.5, words, " class=\"muted\" text-anchor=\"end\" font-size=\"12\"");
  }
  return svg + "</svg>\n";
}

std::string plan_svg(const Result& result, const SurfacePlan& plan, const std::string& png, const ColourScale& scale,
                     const std::string& name) {
  const Picture& picture = plan.picture;
  const double unit = plan_side / static_cast<double>(std::max(picture.width, picture.height));
  const double width = unit * static_cast<double>(picture.width);
  const double height = unit * static_cast<double>(picture.height);
  const double legend_height = std::max(height, 150.0);
  const std::string irradiance(irradiance_unit(result.quantity));
  std::string svg =
      svg_head(side + std::max(width, 360.0) + legend_width, top + 22.0 + legend_height + 50.0, name, side);
  svg += svg_text(side, 50.0,
                  "mean " + short_number(plan.mean_irradiance) + " " + irradiance + "; tiles from " +
                      short_number(plan.min_irradiance) + " to " + short_number(plan.max_irradiance) + " " + irradiance,
                  " class=\"muted\"");
  const double y = top + 22.0;
  svg += image_of(png, side, y, width, height, true);
  svg += isolines_svg(plan, unit, side, y);
  svg += legend(scale, result.quantity, side + width + 16.0, y + 10.0, legend_height - 20.0);
  std::string note = plan.why_no_isolines;
  if (note.empty()) {
    note = "Isolines, smoothed over " + short_number(plan.smoothing_m) + " m (Gaussian).";
  }
  if (plan.flat) {
    svg += scale_bar(unit / glm::length(plan.across), width, side, y + legend_height + 14.0);
  }
  svg += svg_text(side, y + legend_height + 36.0, scale_words(scale) + note, " class=\"muted\" font-size=\"12\"");
  return svg + "</svg>\n";
}

std::string paths_svg(const Room& room, const std::vector<PhotonPath>& paths) {
  constexpr double width = 900.0;
  constexpr double height = 620.0;
  const glm::dmat4 view = view_onto(room, static_cast<std::size_t>(width), static_cast<std::size_t>(height));
  const auto at = [&](const glm::dvec3& p) { return glm::dvec2(side, top) + pixel_of(view, p); };
  std::string svg =
      svg_head(side + width + legend_width, top + height + 34.0, to_text(paths.size(), "photon path"), side);
  for (const auto& edge : edges_of(room)) {
    const glm::dvec2 a = at(edge[0]);
    const glm::dvec2 b = at(edge[1]);
    svg += svg_line(a.x, a.y, b.x, b.y, "class=\"frame\" stroke-opacity=\"0.6\"");
  }
  for (const PhotonPath& path : paths) {
    svg += "<g stroke-width=\"1.3\" stroke-opacity=\"0.85\"><title>photon " + std::to_string(path.history) + ": " +
           to_text(path.points.size() - 1, "flight") + ", " + std::string(to_string(path.end)) + "</title>\n";
    for (std::size_t k = 1; k < path.points.size(); ++k) {
      const glm::dvec2 a = at(path.points[k - 1].place);
      const glm::dvec2 b = at(path.points[k].place);
      svg += svg_line(a.x, a.y, b.x, b.y, "stroke=\"" + css(colour_of_flight(k)) + "\"");
    }
    const glm::dvec2 end = at(path.points.back().place);
    const bool absorbed = path.end == PathEnd::absorbed;
    svg += circle(end, 2.5, absorbed ? "fill=\"#888\" stroke=\"none\"" : "fill=\"none\" stroke=\"#888\"",
                  std::string(to_string(path.end)));
    svg += "</g>\n";
  }
  const double x = side + width + 10.0;
  svg += svg_text(x, top + 12.0, "flight");
  for (std::size_t k = 1; k <= 10; ++k) {
    const double y = top + 14.0 + 20.0 * static_cast<double>(k);
    svg += svg_line(x, y - 4.0, x + 26.0, y - 4.0, "stroke-width=\"4\" stroke=\"" + css(colour_of_flight(k)) + "\"");
    svg += svg_text(x + 34.0, y, k < 10 ? std::to_string(k) : "10 …");
  }
  svg += svg_text(side + width, top + height + 18.5, "filled dots: absorbed; open dots: escaped, cut off or lost",
                  " class=\"muted\" text-anchor=\"end\" font-size=\"12\"");
  return svg + "</svg>\n";
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
