// The smallest rectangle about points in a plane.
#pragma once

#include <vector>

#include <glm/vec2.hpp>

namespace lichtmc {

// The direction (length 1, within 45° of the first axis) along which the rectangle about the points has the least area.
// The axes' own direction (1, 0) where no other is smaller by more than rounding.
glm::dvec2 smallest_rectangle(const std::vector<glm::dvec2>& points);

}  // namespace lichtmc
