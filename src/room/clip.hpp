// A triangle clipped to the cells of a grid.
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
// corners: in cells, finite; parts outside the grid count in its outermost cells. columns, rows ≥ 1. The shares add up
// to 1, also if the triangle has no area in the grid (then they are shares of its area in 3-D: each point of the
// triangle still has a cell). A share that is only rounding is added to that of a nearby piece.
void clip_to_cells(const std::array<glm::dvec2, 3>& corners, std::uint32_t columns, std::uint32_t rows,
                   std::vector<CellPiece>& pieces);

// The part of a triangle in one cell is a convex polygon; this is a triangle of it.
struct CellTriangle {
  std::uint32_t column = 0;
  std::uint32_t row = 0;
  double share = 0.0;                   // of the whole triangle's area, > 0
  std::array<glm::dvec2, 3> weights{};  // barycentric coordinates of its corners: of the whole's second and third one
};

// The same pieces as triangles, without those that are only rounding; `triangles` is replaced.
void cut_into_triangles(const std::array<glm::dvec2, 3>& corners, std::uint32_t columns, std::uint32_t rows,
                        std::vector<CellTriangle>& triangles);

}  // namespace lichtmc
