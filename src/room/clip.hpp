// A triangle cut along the lines of a grid.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace lichtmc {

// The part of a triangle in one cell.
struct CellPiece {
  std::uint32_t column = 0;
  std::uint32_t row = 0;
  double share = 0.0;        // of the triangle's area, > 0
  glm::dvec3 centroid{0.0};  // barycentric coordinates
};

// Cuts a triangle along the lines between the cells of a grid; `pieces` is replaced.
//
// corners: in cells, finite; what lies outside the grid counts in the cells at its rim. columns, rows ≥ 1. The shares
// add up to 1, also where the triangle has no area in the grid (then they are those of its area elsewhere: each point
// of the triangle has a cell all the same). A share that is no more than rounding is added to that of a piece near by.
void clip_to_cells(const std::array<glm::dvec2, 3>& corners, std::uint32_t columns, std::uint32_t rows,
                   std::vector<CellPiece>& pieces);

}  // namespace lichtmc
