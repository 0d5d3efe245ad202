// The large coplanar parts of a surface: walls, floors, table tops.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include "lichtmc/room.hpp"

namespace lichtmc {

// Coplanar triangles of one surface, connected or not: a wall with a door opening is one piece.
struct FlatPiece {
  std::vector<std::uint32_t> triangles;  // indices into Surface::triangles
  glm::dvec3 normal{0.0};                // length 1, towards the front
  double area_m2 = 0.0;
};

// The pieces of at least `least_m2` (> 0), the largest first.
std::vector<FlatPiece> flat_pieces(const Surface& surface, double least_m2);

}  // namespace lichtmc
