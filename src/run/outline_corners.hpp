// Polygons through points of walls: their sides are the walls, their corners where walls meet.
#pragma once

#include <vector>

#include <glm/vec2.hpp>

namespace lichtmc {

// The shortest decimal number within `rounding` of a value that is known no better.
double short_decimal(double value, double rounding);

// `points`: of a closed line, in order, each on a wall to within `rounding`; neighbours are about `spacing` apart, so
// that corners between them are cut off. Points on one straight line become a side; two sides that follow each other
// are prolonged to the corner where they meet if it is near. Coordinates become the shortest decimal numbers within
// `rounding`.
std::vector<glm::dvec2> polygon_through(const std::vector<glm::dvec2>& points, double spacing, double rounding);

}  // namespace lichtmc
