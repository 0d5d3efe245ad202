// A point inside a room, for a lamp where the file has none.
#pragma once

#include <glm/vec3.hpp>

#include "lichtmc/room.hpp"
#include "tracer/tracer.hpp"

namespace lichtmc {

struct InsidePoint {
  glm::dvec3 place{0.0};  // m
  // False if the geometry does not tell where the inside is: nothing encloses a point, or the best two points are
  // about as well enclosed, one by fronts and the other by backs of faces, so that one may be inside a wall.
  bool sure = true;
};

// The point, of several hundred, that is best enclosed, with the greatest distance from surfaces, mostly fronts of
// faces around it. `tracer`: Embree's. low, high: bounding box of the room, m.
//
// Points inside walls, furniture and the ground are enclosed too. They are told apart by both criteria: walls are thin,
// so that every point in them is close to surfaces, and the faces of solids look outwards, so that they are seen from
// behind there. Neither is certain (a room may be drawn as one shell that looks outwards; the ground may be thick).
InsidePoint find_inside(const Room& room, const Tracer& tracer, const glm::dvec3& low, const glm::dvec3& high);

}  // namespace lichtmc
