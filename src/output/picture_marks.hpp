// Marks of emitters and receivers on a picture of a room.
#pragma once

#include <string>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "lichtmc/picture.hpp"
#include "lichtmc/result.hpp"
#include "lichtmc/room.hpp"

namespace lichtmc {

// An area light has its mark at the middle of its surface. The powers are shown where there are few emitters, if there
// is a free place beside the mark. Points outside the picture have no mark.
class PictureMarks {
 public:
  // The picture is drawn from `origin` on, `unit` units a pixel.
  PictureMarks(const Picture& picture, double unit, const glm::dvec2& origin);

  std::string emitters(const Room& room);
  std::string receivers(const Result& result, const ColourScale& scale);

  // Clauses, each beginning with "; ", about marks that are left out because there are too many.
  const std::string& left_out() const { return left_out_; }

 private:
  struct Box {
    glm::dvec2 low{0.0};
    glm::dvec2 high{0.0};
  };

  bool is_in_picture(const glm::dvec3& place, glm::dvec2& at) const;
  bool is_free(const Box& box) const;
  std::string label(const glm::dvec2& at, const std::string& text);

  const Picture* picture_;
  double unit_;
  Box area_;  // of the picture
  std::vector<Box> taken_;
  std::string left_out_;
};

}  // namespace lichtmc
