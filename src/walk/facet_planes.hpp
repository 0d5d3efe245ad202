// The planes of a tracer's facets in the world, in double: where flights end, exact to its rounding.
//
// Tracers compute in float. A path whose corners are moved onto the planes is a path of light through the room, whose
// length is exact: none is shorter than the shortest possible one.
#pragma once

#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "lichtmc/room.hpp"
#include "tracer/tracer.hpp"

namespace lichtmc {

class FacetPlanes {
 public:
  // The tracer must outlive this.
  FacetPlanes(const Room& room, const Tracer& tracer);

  // The point of the facet's plane that is nearest to a point (m, world).
  glm::dvec3 nearest(std::uint32_t facet, const glm::dvec3& point) const {
    const Plane& plane = planes_[facet];
    return point - glm::dot(plane.normal, point - plane.point) * plane.normal;
  }
  // Where flight i, which has hit a surface, ended.
  glm::dvec3 end_of(const Rays& rays, std::size_t i) const {
    const glm::dvec3 end = glm::dvec3(rays.start(i)) + double{rays.length[i]} * glm::dvec3(rays.direction(i));
    return nearest(rays.facet[i], tracer_->world_point(end));
  }

 private:
  struct Plane {
    glm::dvec3 point{0.0};   // m
    glm::dvec3 normal{0.0};  // length 1; 0 for a facet without an area
  };
  const Tracer* tracer_;
  std::vector<Plane> planes_;
};

}  // namespace lichtmc
