// Points outside a closed room.
//
// A room is closed if one closed shell extends over all of it, or if it is a cuboid. The outside is what no closed
// shell contains. Points on a surface, within the rounding of float coordinates, are not outside. In rooms that are not
// closed nothing is outside.
#pragma once

#include <vector>

#include <glm/vec3.hpp>

#include "lichtmc/room.hpp"

namespace lichtmc {

// Whether each of these points (world coordinates, m) lies outside.
std::vector<bool> points_outside(const Room& room, const std::vector<glm::dvec3>& points_m);

// Whether the light of each emitter starts outside: the position of a point emitter; the fronts of all tested triangles
// of an area light, some of them distributed over it.
std::vector<bool> emitters_beyond_walls(const Room& room);

}  // namespace lichtmc
