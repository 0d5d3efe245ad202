#include "output/picture_marks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "base/message.hpp"
#include "output/picture_parts.hpp"
#include "output/svg.hpp"
#include "room/emitter_place.hpp"

namespace lichtmc {

namespace {

constexpr std::size_t max_marks = 3000;  // more are not distinguishable, and slow to show
constexpr std::size_t many_emitters = 50;
constexpr std::size_t many_receivers = 300;

std::string count_of(std::size_t shown, std::size_t all, const char* noun) {
  return shown < all ? "; marks of " + std::to_string(shown) + " of " + to_text(all, noun) : "";
}

}  // namespace

PictureMarks::PictureMarks(const Picture& picture, double unit, const glm::dvec2& origin)
    : picture_(&picture), unit_(unit) {
  area_ = {origin, origin + unit * glm::dvec2(static_cast<double>(picture.width), static_cast<double>(picture.height))};
}

bool PictureMarks::is_in_picture(const glm::dvec3& place, glm::dvec2& at) const {
  if (!((picture_->to_pixel * glm::dvec4(place, 1.0)).w > 0.0)) return false;  // behind the eye
  at = area_.low + unit_ * pixel_of(picture_->to_pixel, place);
  return at.x > area_.low.x && at.y > area_.low.y && at.x < area_.high.x && at.y < area_.high.y;
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
  constexpr std::size_t max_labels = 8;
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
  std::string svg;
  const std::size_t n = result.receiver_results.size();
  const double radius = n > many_receivers ? 2.5 : 5.0;
  const std::string stroke = n > many_receivers ? "0.5" : "1";
  for (std::size_t k = 0; k < std::min(n, max_marks); ++k) {
    glm::dvec2 p(0.0);
    if (!is_in_picture(result.receivers[k].position, p)) continue;
    const double value = result.receiver_results[k].irradiance;
    svg += svg_circle(
        p, radius, "fill=\"" + css(colour_of(scale, value)) + "\" stroke=\"#fff\" stroke-width=\"" + stroke + "\"",
        result.receivers[k].name + ": " + short_number(value) + " " + std::string(irradiance_unit(result.quantity)));
  }
  left_out_ += count_of(std::min(n, max_marks), n, "receiver");
  return svg;
}

}  // namespace lichtmc
