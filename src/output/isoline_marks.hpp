// Isolines and their labels as SVG. Lengths are units of the picture.
#pragma once

#include <string>
#include <vector>

#include <glm/vec2.hpp>

#include "lichtmc/picture.hpp"

namespace lichtmc {

// The lines, dark over a wider bright line: visible on every colour. A point p of a line is drawn at origin + unit · p.
std::string isoline_strokes(const std::vector<Isoline>& lines, double unit, const glm::dvec2& origin);

// Finds free places for texts.
class LabelPlaces {
 public:
  // Texts have their whole width, and their middle in height, between `low` and `high`, measured from the origin of the
  // lines.
  LabelPlaces(const glm::dvec2& low, const glm::dvec2& high) : low_(low), high_(high) {}

  // Takes the place of a text of this size, if it is free from other texts with a gap.
  bool take(const glm::dvec2& middle, const glm::dvec2& size, const glm::dvec2& gap);

  // The value of each line beside it: on the first free place along the line, from its middle outwards; none if there
  // is no such place. `gap`: from other texts.
  std::string isoline_labels(const std::vector<Isoline>& lines, double unit, const glm::dvec2& origin, double font_size,
                             const glm::dvec2& gap = glm::dvec2(6.0));

 private:
  struct Taken {
    glm::dvec2 middle{0.0};
    glm::dvec2 size{0.0};
  };
  glm::dvec2 low_;
  glm::dvec2 high_;
  std::vector<Taken> taken_;
};

}  // namespace lichtmc
