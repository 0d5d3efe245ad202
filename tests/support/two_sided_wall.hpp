// A room with everything that makes walks differ, for tests of receivers.
#pragma once

#include <glm/vec3.hpp>

#include "support/rooms.hpp"
#include "support/surfaces.hpp"

namespace lichtmc::test {

// A cuboid of 4 × 3 × 5 m with a window, a thin partition whose sides are both lit, and a panel below the ceiling, the
// last surface. Without emitters.
inline Room room_with_two_sided_wall() {
  Room room = without_surface(make_cuboid({4.0, 3.0, 5.0}, {0.3, 0.8, 0.6, 0.5, 0.7, 0.4}), "wall_z1");
  Surface partition = make_floor(2.5, 2.2);
  for (glm::dvec3& p : partition.positions) p = {p.x, p.z, 2.0};
  partition.name = "partition";
  partition.reflectance = 0.7;
  partition.sides = Sides::both;
  room.surfaces.push_back(partition);
  Surface panel = make_floor(0.5, 0.5);
  for (glm::dvec3& p : panel.positions) p += glm::dvec3(0.5, 2.9, 3.5);
  panel.name = "panel";
  panel.reflectance = 0.5;
  room.surfaces.push_back(panel);
  return room;
}

}  // namespace lichtmc::test
