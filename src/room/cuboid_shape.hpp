// Recognition of empty cuboids, in which flights have a closed form.
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
  // [surface][triangle]: 2·axis for the face through the corner, 2·axis + 1 for the opposite one. For triangles without
  // area: any value.
  std::vector<std::vector<std::uint8_t>> face_of_triangle;
};

// The cuboid that a room forms, or nothing. A room is a cuboid if its triangles, except those without area, cover the
// six faces of one cuboid exactly once: in any triangulation, by any number of surfaces, with any winding, rotated or
// not. Positions may have the rounding of float coordinates. Rooms with more than 20 000 triangles are not tested.
std::optional<CuboidShape> recognise_cuboid(const Room& room);

}  // namespace lichtmc
