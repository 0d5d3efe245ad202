// Start points of a point emitter's photons in a room of triangles.
#pragma once

#include <vector>

#include <glm/vec3.hpp>

#include "lichtmc/room.hpp"
#include "tracer/departure.hpp"
#include "tracer/room_triangles.hpp"
#include "tracer/tracer.hpp"

namespace lichtmc {

// As Tracer::start(). An emitter touches a facet if its distance from it is at most one step, or at most the error of
// that distance (see NearPlane). `departures`: of the room's triangles, in the order of RoomTriangles.
Start start_at(const glm::dvec3& world_point_m, const glm::dvec3& axis, const Room& room, const Placement& placement,
               const std::vector<Departure>& departures);

}  // namespace lichtmc
