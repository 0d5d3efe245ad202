// A cuboid room from its edges and reflectances: the special case with exact results.
#pragma once

#include <glm/vec3.hpp>

#include "lichtmc/room.hpp"

namespace lichtmc {

// Reflectances of the six walls of a cuboid that extends from the origin to +X, +Y (up), +Z.
struct CuboidReflectances {
  double floor = 0.5;    // y = 0
  double ceiling = 0.5;  // y = size.y
  double x0 = 0.5;       // x = 0
  double x1 = 0.5;       // x = size.x
  double z0 = 0.5;       // z = 0
  double z1 = 0.5;       // z = size.z
};

// The same reflectance on all six walls.
CuboidReflectances uniform_reflectance(double reflectance);

// Makes the room [0, size.x] × [0, size.y] × [0, size.z] in metres, normals inwards, without emitters.
//
// Six surfaces in this order: "floor", "ceiling", "wall_x0", "wall_x1", "wall_z0", "wall_z1"; two triangles each; UVs
// from 0 to 1 along the wall's two axes (u along the first of x, y, z that lies in the wall, v along the second).
// Throws InputError if an edge is not a finite number above 0 or a reflectance is outside 0 … 1.
Room make_cuboid(const glm::dvec3& size_m, const CuboidReflectances& reflectances);

}  // namespace lichtmc
