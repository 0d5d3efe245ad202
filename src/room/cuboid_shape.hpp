// Is this room an empty cuboid? Then its flights have a closed form.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include <glm/vec3.hpp>

#include "lichtmc/room.hpp"

namespace lichtmc {

struct CuboidShape {
  glm::dvec3 corner{0.0};           // m
  std::array<glm::dvec3, 3> edges;  // m, mutually perpendicular, right-handed
  // [surface][triangle]: 2·axis for the face through the corner, 2·axis + 1 for the one opposite. Of triangles without
  // area: any.
  std::vector<std::vector<std::uint8_t>> face_of_triangle;
};

// The cuboid that a room is, or nothing. A room is one when its triangles, those without area aside, cover the six
// faces of one cuboid exactly once: in any triangulation, by any number of surfaces, with any winding, rotated or not.
// Positions may be rounded as float coordinates are. Rooms of more than 20 000 triangles are not looked at.
std::optional<CuboidShape> recognise_cuboid(const Room& room);

}  // namespace lichtmc
