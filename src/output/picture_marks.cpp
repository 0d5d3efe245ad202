#include "output/picture_marks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include <glm/geometric.hpp>

#include "base/message.hpp"
#include "output/picture_parts.hpp"
#include "output/svg.hpp"
#include "room/emitter_place.hpp"

namespace lichtmc {

namespace {

constexpr std::size_t max_marks = 3000;  // more are not distinguishable, and slow to show
constexpr std::size_t max_labels = 8;
constexpr std::size_t max_cells = 20'000;
constexpr std::size_t many_emitters = 50;
constexpr std::size_t many_receivers = 300;

std::string count_of(std::size_t shown, std::size_t all, const char* noun) {
  return shown < all ? "; marks of " + std::to_string(shown) + " of " + to_text(all, noun) : "";
}

// A task lies in its surrounding: large areas do not hide small ones.
std::vector<const AreaResult*> largest_first(const Result& result) {
  std::vector<const AreaResult*> areas;
  for (const AreaResult& area : result.areas) areas.push_back(&area);
  const auto size = [](const AreaResult* one) {
    return static_cast<double>(one->area.cells.size()) * glm::length(one->area.u) * glm::length(one->area.v);
  };
  std::stable_sort(areas.begin(), areas.end(),
                   [&size](const AreaResult* a, const AreaResult* b) { return size(a) > size(b); });
  return areas;
}

bool looks_down(const Area& area) {
  constexpr double least = 0.1;  // of the cosine of the angle to the vertical
  return area.normal.y < -least;
}

}  // namespace

PictureMarks::PictureMarks(const Picture& picture, double unit, const glm::dvec2& origin)
    : picture_(&picture), unit_(unit) {
  area_ = {origin, origin + unit * glm::dvec2(static_cast<double>(picture.width), static_cast<double>(picture.height))};
}

bool PictureMarks::is_before_eye(const glm::dvec3& place, glm::dvec2& at) const {
  if (!((picture_->to_pixel * glm::dvec4(place, 1.0)).w > 0.0)) return false;
  at = area_.low + unit_ * pixel_of(picture_->to_pixel, place);
  return true;
}

bool PictureMarks::is_in_picture(const glm::dvec3& place, glm::dvec2& at) const {
  return is_before_eye(place, at) && at.x > area_.low.x && at.y > area_.low.y && at.x < area_.high.x &&
         at.y < area_.high.y;
}

bool PictureMarks::is_free(const Box& box) const {
  if (box.low.x < area_.low.x || box.low.y < area_.low.y || box.high.x > area_.high.x || box.high.y > area_.high.y)
    return false;
  return std::none_of(taken_.begin(), taken_.end(), [&](const Box& other) {
    return box.low.x < other.high.x && other.low.x < box.high.x && box.low.y < other.high.y && other.low.y < box.high.y;
  });
}

// A label to the right of a mark, else to the left, above or below.
std::string PictureMarks::label(const glm::dvec2& at, const std::string& text) {
  const double width = text_width(text, note_size);
  for (const glm::dvec2& start : {glm::dvec2(14.0, 4.0), glm::dvec2(-14.0 - width, 4.0),
                                  glm::dvec2(-0.5 * width, -15.0), glm::dvec2(-0.5 * width, 23.0)}) {
    const glm::dvec2 p = at + start;
    const Box box{{p.x, p.y - note_size}, {p.x + width, p.y + 3.0}};
    if (!is_free(box)) continue;
    taken_.push_back(box);
    return svg_text(p.x, p.y, text, " class=\"halo\" font-size=\"" + fixed(note_size) + "\"");
  }
  return {};
}

std::string PictureMarks::emitters(const Room& room) {
  const std::size_t n = room.emitters.size();
  const double size = n > many_emitters ? 0.5 : 1.0;
  const std::string stroke = "stroke=\"#000\" stroke-width=\"" + fixed(1.5 * size) + "\"";
  struct Mark {
    glm::dvec2 at{0.0};
    std::string text;
  };
  std::vector<Mark> marks;
  std::string svg;
  for (std::size_t k = 0; k < std::min(n, max_marks); ++k) {
    const Emitter& emitter = room.emitters[k];
    glm::dvec2 p(0.0);
    if (!is_in_picture(place_of(room, emitter), p)) continue;
    marks.push_back({p, short_number(emitter.power) + " " + std::string(power_unit(room.quantity))});
    taken_.push_back({p - 11.0 * size, p + 11.0 * size});
    svg += svg_circle(p, 5.0 * size, "fill=\"#fff7c2\" " + stroke, emitter.name + ": " + marks.back().text);
    for (int ray = 0; ray < 8; ++ray) {
      const double angle = 0.785398163 * ray;
      const glm::dvec2 direction = size * glm::dvec2(std::cos(angle), std::sin(angle));
      const glm::dvec2 from = p + 7.0 * direction;
      const glm::dvec2 to = p + 11.0 * direction;
      svg += svg_line(from.x, from.y, to.x, to.y, stroke);
    }
  }
  if (n <= max_labels) {
    for (const Mark& mark : marks) svg += label(mark.at, mark.text);
  }
  left_out_ += count_of(std::min(n, max_marks), n, "emitter");
  return svg;
}

std::string PictureMarks::receivers(const Result& result, const ColourScale& scale) {
  const std::vector<bool> of_areas = points_of_areas(result);
  std::vector<std::size_t> shown;
  for (std::size_t k = 0; k < result.receiver_results.size(); ++k) {
    if (!of_areas[k]) shown.push_back(k);
  }
  std::string svg;
  const std::size_t n = shown.size();
  const double radius = n > many_receivers ? 2.5 : 5.0;
  const std::string stroke = n > many_receivers ? "0.5" : "1";
  for (std::size_t k = 0; k < std::min(n, max_marks); ++k) {
    const Receiver& receiver = result.receivers[shown[k]];
    glm::dvec2 p(0.0);
    if (!is_in_picture(receiver.position, p)) continue;
    const double value = result.receiver_results[shown[k]].irradiance;
    svg += svg_circle(p, radius,
                      "fill=\"" + css(colour_of(scale, value)) + "\" stroke=\"#fff\" stroke-width=\"" + stroke + "\"",
                      receiver.name + ": " + short_number(value) + " " + std::string(irradiance_unit(result.quantity)));
  }
  left_out_ += count_of(std::min(n, max_marks), n, "receiver");
  return svg;
}

std::string PictureMarks::cells(const Result& result, const AreaResult& one, const ColourScale& scale) const {
  const Area& area = one.area;
  std::string svg;
  for (std::size_t k = 0; k < area.cells.size(); ++k) {
    const glm::dvec3 centre = area.centre(area.cells[k]);
    std::string points;
    for (const glm::dvec2& corner :
         {glm::dvec2(-0.5, -0.5), glm::dvec2(0.5, -0.5), glm::dvec2(0.5, 0.5), glm::dvec2(-0.5, 0.5)}) {
      glm::dvec2 p(0.0);
      if (!is_before_eye(centre + corner.x * area.u + corner.y * area.v, p)) {
        points.clear();
        break;
      }
      points += fixed(p.x) + "," + fixed(p.y) + " ";
    }
    if (points.empty()) continue;
    const std::string colour = css(colour_of(scale, result.receiver_results[area.first_receiver + k].irradiance));
    svg += "<polygon points=\"" + points + "\" fill=\"" + colour + "\" stroke=\"" + colour + "\"/>\n";
  }
  return svg;
}

std::string PictureMarks::areas(const Result& result, const ColourScale& scale, bool cells_too, View view) {
  // Those that look down lie above what is seen from above.
  const bool from_above = view == View::above;
  std::vector<const AreaResult*> shown;
  for (const AreaResult* area : largest_first(result)) {
    if (!from_above || !looks_down(area->area)) shown.push_back(area);
  }
  if (shown.size() < result.areas.size()) left_out_ += "; areas that face down are left out";
  if (shown.empty()) return {};
  // Cells that extend beyond the picture are cut off at its border.
  const glm::dvec2 size = area_.high - area_.low;
  const std::string frame = fixed(area_.low.x) + " " + fixed(area_.low.y) + " " + fixed(size.x) + " " + fixed(size.y);
  std::string svg = "<svg x=\"" + fixed(area_.low.x) + "\" y=\"" + fixed(area_.low.y) + "\" width=\"" + fixed(size.x) +
                    "\" height=\"" + fixed(size.y) + "\" viewBox=\"" + frame + "\">\n";
  std::size_t all = 0;
  for (const AreaResult* area : shown) all += area->area.cells.size();
  if (cells_too && all <= max_cells) {
    for (const AreaResult* area : shown) {
      if (picture_->from_inside || !looks_down(area->area)) svg += cells(result, *area, scale);
    }
  }
  std::string labels;
  for (const AreaResult* one : shown) {
    const Area& area = one->area;
    glm::dvec2 lowest(0.0, -1.0);  // the end of a line that is nearest to the viewer
    for (const std::array<glm::dvec3, 2>& line : area.outline) {
      glm::dvec2 from(0.0);
      glm::dvec2 to(0.0);
      if (!is_before_eye(line[0], from) || !is_before_eye(line[1], to)) continue;
      svg += svg_line(from.x, from.y, to.x, to.y, "stroke=\"#fff\" stroke-opacity=\"0.7\" stroke-width=\"3\"");
      svg += svg_line(from.x, from.y, to.x, to.y, "stroke=\"#000\" stroke-width=\"1.2\" stroke-dasharray=\"7 3\"");
      for (const glm::dvec2& end : {from, to}) {
        if (end.y > lowest.y) lowest = end;
      }
    }
    if (shown.size() <= max_labels && lowest.y >= 0.0)
      labels += label(lowest, shortened(area.properties.name, note_size, 220.0));
  }
  if (cells_too && all > max_cells) left_out_ += "; cells of areas are too many to be drawn";
  return svg + "</svg>\n" + labels;
}

std::vector<bool> points_of_areas(const Result& result) {
  std::vector<bool> of_areas(result.receiver_results.size());
  for (const AreaResult& area : result.areas) {
    const std::size_t first = std::min(area.area.first_receiver, of_areas.size());
    const std::size_t last = std::min(first + area.area.cells.size(), of_areas.size());
    std::fill(of_areas.begin() + static_cast<std::ptrdiff_t>(first),
              of_areas.begin() + static_cast<std::ptrdiff_t>(last), true);
  }
  return of_areas;
}

}  // namespace lichtmc
