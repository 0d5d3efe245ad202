// Marks of emitters, receivers and calculation areas on a picture of a room.
#pragma once

#include <string>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "lichtmc/picture.hpp"
#include "lichtmc/result.hpp"
#include "lichtmc/room.hpp"

namespace lichtmc {

// Of each receiver: whether it is a point of a calculation area.
std::vector<bool> points_of_areas(const Result& result);

// An area light has its mark at the middle of its surface. The powers are shown where there are few emitters, if there
// is a free place beside the mark. Points outside the picture have no mark.
class PictureMarks {
 public:
  // The picture is drawn from `origin` on, `unit` units a pixel.
  PictureMarks(const Picture& picture, double unit, const glm::dvec2& origin);

  std::string emitters(const Room& room);
  // A dot for each, except for the points of calculation areas.
  std::string receivers(const Result& result, const ColourScale& scale);
  // The outline of each calculation area with its name; `cells`: also its cells in false colour. Those that look down
  // would hide others from above: there they are left out, and from outside their cells are.
  std::string areas(const Result& result, const ColourScale& scale, bool cells, View view);

  // Clauses, each beginning with "; ", about marks that are left out because there are too many.
  const std::string& left_out() const { return left_out_; }

 private:
  struct Box {
    glm::dvec2 low{0.0};
    glm::dvec2 high{0.0};
  };

  bool is_before_eye(const glm::dvec3& place, glm::dvec2& at) const;
  bool is_in_picture(const glm::dvec3& place, glm::dvec2& at) const;
  bool is_free(const Box& box) const;
  std::string label(const glm::dvec2& at, const std::string& text);
  std::string cells(const Result& result, const AreaResult& area, const ColourScale& scale) const;

  const Picture* picture_;
  double unit_;
  Box area_;  // of the picture
  std::vector<Box> taken_;
  std::string left_out_;
};

}  // namespace lichtmc
