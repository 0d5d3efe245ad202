#include "output/picture_parts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <vector>

#include "base/base64.hpp"
#include "base/message.hpp"
#include "base/png.hpp"
#include "output/readable.hpp"
#include "output/svg.hpp"

namespace lichtmc {

namespace {

constexpr double legend_distance = 16.0;  // from the picture
constexpr double bar_width = 18.0;
constexpr double value_height = 15.0;  // of the values

// The values step · 10ⁿ on a logarithmic scale.
std::vector<double> decades_of(const ColourScale& scale, const std::vector<double>& steps) {
  std::vector<double> ticks;
  const int last = static_cast<int>(std::floor(std::log10(scale.high)));
  for (int exponent = static_cast<int>(std::floor(std::log10(scale.low))); exponent <= last; ++exponent) {
    for (const double step : steps) {
      const double value = step * std::pow(10.0, exponent);
      if (value >= scale.low * 0.999 && value <= scale.high * 1.001) ticks.push_back(value);
    }
  }
  return ticks;
}

// Whether the values have room for their text.
bool fit(const std::vector<double>& ticks, const ColourScale& scale, double height) {
  for (std::size_t k = 1; k < ticks.size(); ++k) {
    if (height * (scale.share(ticks[k]) - scale.share(ticks[k - 1])) < value_height) return false;
  }
  return true;
}

// Round values on a scale.
std::vector<double> ticks_of(const ColourScale& scale, double height) {
  if (scale.logarithmic) {
    for (const std::vector<double>& steps : {std::vector<double>{1.0, 2.0, 5.0}, std::vector<double>{1.0, 3.0}}) {
      std::vector<double> ticks = decades_of(scale, steps);
      if (fit(ticks, scale, height)) return ticks;
    }
    return decades_of(scale, {1.0});
  }
  const double decade = std::pow(10.0, std::floor(std::log10(scale.high / 5.0)));
  const double rough = scale.high / 5.0 / decade;
  const double step = decade * (rough > 5.0 ? 10.0 : rough > 2.0 ? 5.0 : rough > 1.0 ? 2.0 : 1.0);
  std::vector<double> ticks;
  for (double k = 0.0; k * step <= scale.high * 1.001; k += 1.0) ticks.push_back(k * step);
  return ticks;
}

}  // namespace

std::string svg_image(const std::string& png, double x, double y, double width, double height, bool pixelated) {
  return "<image x=\"" + fixed(x) + "\" y=\"" + fixed(y) + "\" width=\"" + fixed(width) + "\" height=\"" +
         fixed(height) + "\" preserveAspectRatio=\"none\"" + (pixelated ? " image-rendering=\"pixelated\"" : "") +
         " href=\"data:image/png;base64," + base64(png) + "\"/>\n";
}

std::string svg_circle(const glm::dvec2& at, double radius, const std::string& attributes, const std::string& title) {
  return "<circle cx=\"" + fixed(at.x) + "\" cy=\"" + fixed(at.y) + "\" r=\"" + fixed(radius) + "\" " + attributes +
         "><title>" + escaped(title) + "</title></circle>\n";
}

std::string css(const Colour& colour) {
  std::array<char, 8> text{};
  std::snprintf(text.data(), text.size(), "#%02x%02x%02x", colour[0], colour[1], colour[2]);
  return text.data();
}

glm::dvec2 pixel_of(const glm::dmat4& to_pixel, const glm::dvec3& place) {
  const glm::dvec4 at = to_pixel * glm::dvec4(place, 1.0);
  return {at.x / at.w, at.y / at.w};
}

std::string colour_legend(const ColourScale& scale, std::string_view unit, double x, double y, double height) {
  constexpr std::size_t steps = 256;
  std::vector<std::uint8_t> pixels;
  for (std::size_t k = 0; k < steps; ++k) {
    const Colour colour = colour_at(scale.colours, 1.0 - static_cast<double>(k) / (steps - 1));
    pixels.insert(pixels.end(), colour.begin(), colour.end());
  }
  x += legend_distance;
  std::string svg = svg_text(x, y - 10.0, unit);
  svg += svg_image(png_file(1, steps, 3, pixels), x, y, bar_width, height, false);
  svg += "<rect x=\"" + fixed(x) + "\" y=\"" + fixed(y) + "\" width=\"" + fixed(bar_width) + "\" height=\"" +
         fixed(height) + "\" class=\"frame\"/>\n";
  for (const double tick : ticks_of(scale, height)) {
    const double at = y + height * (1.0 - scale.share(tick));
    svg += svg_line(x + bar_width, at, x + bar_width + 5.0, at, "class=\"frame\"");
    svg += svg_text(x + bar_width + 8.0, at + 4.5, short_number(tick));
  }
  return svg;
}

double legend_width(const ColourScale& scale, double height) {
  double text = 60.0;  // usual values: pictures of one width are easier to compare
  for (const double tick : ticks_of(scale, height)) text = std::max(text, text_width(short_number(tick), text_size));
  return legend_distance + bar_width + 8.0 + text + 8.0;
}

std::string scale_bar(double units_per_metre, double width, double x, double y, double& end) {
  double length = std::pow(10.0, std::floor(std::log10(0.25 * width / units_per_metre)));
  for (const double step : {5.0, 2.0}) {
    if (step * length * units_per_metre <= 0.25 * width) {
      length *= step;
      break;
    }
  }
  const double right = x + length * units_per_metre;
  const std::string text = short_number(length) + " m";
  end = right + 8.0 + text_width(text, note_size);
  return svg_line(x, y, right, y, "class=\"frame\" stroke-width=\"2\"") +
         svg_line(x, y - 4.0, x, y + 4.0, "class=\"frame\"") +
         svg_line(right, y - 4.0, right, y + 4.0, "class=\"frame\"") +
         svg_text(right + 8.0, y + 4.5, text, " class=\"muted\" font-size=\"" + fixed(note_size) + "\"");
}

std::string svg_notes(const std::string& text, double x, double& y, double width) {
  std::string svg;
  for (const std::string& line : text_lines(text, note_size, width)) {
    svg += svg_text(x, y, line, " class=\"muted\" font-size=\"" + fixed(note_size) + "\"");
    y += 16.0;
  }
  return svg;
}

}  // namespace lichtmc
