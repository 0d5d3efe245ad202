#include "walk/facet_planes.hpp"

namespace lichtmc {

FacetPlanes::FacetPlanes(const Room& room, const Tracer& tracer) : tracer_(&tracer), planes_(tracer.facets().size()) {
  for (std::size_t k = 0; k < room.surfaces.size(); ++k) {
    const Surface& surface = room.surfaces[k];
    for (std::size_t n = 0; n < surface.triangles.size(); ++n) {
      const glm::uvec3& corner = surface.triangles[n];
      const glm::dvec3& a = surface.positions[corner.x];
      const glm::dvec3 cross = glm::cross(surface.positions[corner.y] - a, surface.positions[corner.z] - a);
      const double twice = glm::length(cross);
      const std::uint32_t facet = tracer.locate(k, n).facet;
      if (twice > 0.0 && facet < planes_.size()) planes_[facet] = {a, cross / twice};
    }
  }
}

}  // namespace lichtmc
