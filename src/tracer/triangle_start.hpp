// Start points of a point emitter's photons in a room of triangles.
#pragma once

#include <cstddef>
#include <vector>

#include <glm/vec3.hpp>

#include "lichtmc/room.hpp"
#include "room/bounds.hpp"
#include "tracer/departure.hpp"
#include "tracer/room_triangles.hpp"
#include "tracer/tracer.hpp"

namespace lichtmc {

// Boxes about groups of facets that follow each other, which are neighbours in most meshes: a point outside of a box
// touches none of its facets. The search for the facets that an emitter touches reads one box instead of 64 facets.
class FacetGroups {
 public:
  static constexpr std::size_t size = 64;  // facets of a group

  FacetGroups() = default;
  explicit FacetGroups(const std::vector<Departure>& departures);

  // Whether the point (tracer's coordinates) may touch facets of a group.
  bool may_touch(std::size_t group, const glm::dvec3& point) const { return boxes_[group].holds(point); }

 private:
  std::vector<Bounds> boxes_;
};

// As Tracer::start(). An emitter touches a facet if its distance from it is at most one step, or at most the error of
// that distance (see NearPlane). `departures`: of the room's triangles, in the order of RoomTriangles; `groups`: of
// these.
Start start_at(const glm::dvec3& world_point_m, const glm::dvec3& axis, const Room& room, const Placement& placement,
               const std::vector<Departure>& departures, const FacetGroups& groups);

}  // namespace lichtmc
