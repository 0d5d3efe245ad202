// The smallest rectangle around points in a plane.
#pragma once

#include <vector>

#include <glm/vec2.hpp>

namespace lichtmc {

// The direction (length 1, within 45° of the first axis) along which the rectangle around the points has the smallest
// area; the axis direction (1, 0) if no other rectangle is smaller by more than rounding.
glm::dvec2 smallest_rectangle(const std::vector<glm::dvec2>& points);

}  // namespace lichtmc
