// Rectangles packed into one grid.
#pragma once

#include <vector>

#include <glm/vec2.hpp>

namespace lichtmc {

struct Packing {
  glm::dvec2 size{1.0};             // of the grid: columns, rows
  std::vector<glm::dvec2> corners;  // for every rectangle its corner at the smallest column and row
  std::vector<bool> turned;         // which rectangles have columns and rows exchanged
};

// Places rectangles side by side in a grid that is about square and wastes little; if that helps, all of them have
// their longer sides along the rows. Sizes and results are integers ≥ 1 of columns and rows; they are doubles, so that
// sizes beyond the limits of a grid do not overflow.
Packing pack(const std::vector<glm::dvec2>& sizes);

}  // namespace lichtmc
