// The large flat pieces of a room's surfaces: walls, floors, table tops.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include "lichtmc/room.hpp"

namespace lichtmc {

// Triangles of one surface that lie in one plane, whether they touch or not: a wall with a door in it is one piece.
struct FlatPiece {
  std::vector<std::uint32_t> triangles;  // indices into Surface::triangles
  glm::dvec3 normal{0.0};                // length 1, towards the front
  double area_m2 = 0.0;
};

// The pieces of at least `least_m2` (> 0), the largest first.
std::vector<FlatPiece> flat_pieces(const Surface& surface, double least_m2);

}  // namespace lichtmc
