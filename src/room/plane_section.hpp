// The lines in which a plane cuts the surfaces of a room, for drawings.
#pragma once

#include <array>
#include <vector>

#include <glm/vec3.hpp>

#include "lichtmc/room.hpp"

namespace lichtmc {

// One line for each triangle that the plane cuts, with its ends in m. The plane goes through `point`, at right angles
// to `normal` (any length but 0). Corners in the plane count as lying on the side of the normal: a triangle in the
// plane gives no line, and neighbours share the ends of their lines.
std::vector<std::array<glm::dvec3, 2>> section_of(const Room& room, const glm::dvec3& point, const glm::dvec3& normal);

}  // namespace lichtmc
