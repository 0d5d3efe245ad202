#include "output/isoline_marks.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "base/message.hpp"
#include "output/svg.hpp"

namespace lichtmc {

namespace {

std::string polyline(const std::vector<glm::dvec2>& points, double unit, const glm::dvec2& origin,
                     std::string_view style) {
  std::string svg = "<polyline fill=\"none\" " + std::string(style) + " points=\"";
  for (const glm::dvec2& p : points) svg += fixed(origin.x + unit * p.x) + "," + fixed(origin.y + unit * p.y) + " ";
  return svg + "\"/>\n";
}

}  // namespace

std::string isoline_strokes(const std::vector<Isoline>& lines, double unit, const glm::dvec2& origin) {
  std::string svg;
  for (const Isoline& line : lines) {
    svg += polyline(line.points, unit, origin, "stroke=\"#fff\" stroke-opacity=\"0.55\" stroke-width=\"2.6\"");
    svg += polyline(line.points, unit, origin, "stroke=\"#000\" stroke-width=\"1\"");
  }
  return svg;
}

bool LabelPlaces::take(const glm::dvec2& middle, const glm::dvec2& size, const glm::dvec2& gap) {
  const double half = 0.5 * size.x;
  if (middle.x < low_.x + half || middle.y < low_.y || middle.x > high_.x - half || middle.y > high_.y) return false;
  const bool free = std::none_of(taken_.begin(), taken_.end(), [&](const Taken& other) {
    return std::abs(other.middle.x - middle.x) < half + 0.5 * other.size.x + gap.x &&
           std::abs(other.middle.y - middle.y) < 0.5 * (size.y + other.size.y) + gap.y;
  });
  if (free) taken_.push_back({middle, size});
  return free;
}

std::string LabelPlaces::isoline_labels(const std::vector<Isoline>& lines, double unit, const glm::dvec2& origin,
                                        double font_size, const glm::dvec2& gap) {
  std::string svg;
  for (const Isoline& line : lines) {
    const std::size_t n = line.points.size();
    const std::string text = short_number(line.level);
    const glm::dvec2 size(text_width(text, font_size), font_size);
    for (std::size_t k = 0; k < n; ++k) {
      const std::size_t from_middle = (k + 1) / 2;
      const std::size_t at = k % 2 == 0 ? n / 2 + from_middle : n / 2 - from_middle;
      if (at >= n) continue;
      const glm::dvec2 p = unit * line.points[at];
      if (!take(p, size, gap)) continue;
      svg += svg_text(origin.x + p.x - 0.5 * size.x, origin.y + p.y + 4.0, text,
                      " class=\"halo\" font-size=\"" + fixed(font_size) + "\"");
      break;
    }
  }
  return svg;
}

}  // namespace lichtmc
