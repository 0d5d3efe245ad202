// Rectangles packed into one grid.
#pragma once

#include <vector>

#include <glm/vec2.hpp>

namespace lichtmc {

struct Packing {
  glm::dvec2 size{1.0};             // of the grid: columns, rows
  std::vector<glm::dvec2> corners;  // of every rectangle the corner at the smallest column and row
  std::vector<bool> turned;         // which rectangles have columns and rows exchanged
};

// Places rectangles side by side in a grid that is about square and wastes little, where that helps with all of them
// lying on their longer sides. Sizes are whole numbers ≥ 1 of
// columns and rows, and so are the results; doubles, so that a size beyond any grid gives a grid beyond any.
Packing pack(const std::vector<glm::dvec2>& sizes);

}  // namespace lichtmc
