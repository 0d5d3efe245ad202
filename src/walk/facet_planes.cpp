#include "walk/facet_planes.hpp"

namespace lichtmc {

FacetPlanes::FacetPlanes(const Room& room, const Tracer& tracer) : tracer_(&tracer) {
  for (auto* numbers : {&normal_x_, &normal_y_, &normal_z_, &offset_}) numbers->resize(tracer.facets().size(), 0.0);
  for (std::size_t k = 0; k < room.surfaces.size(); ++k) {
    const Surface& surface = room.surfaces[k];
    for (std::size_t n = 0; n < surface.triangles.size(); ++n) {
      const glm::uvec3& corner = surface.triangles[n];
      const glm::dvec3& a = surface.positions[corner.x];
      const glm::dvec3 cross = glm::cross(surface.positions[corner.y] - a, surface.positions[corner.z] - a);
      const double twice = glm::length(cross);
      const std::uint32_t facet = tracer.locate(k, n).facet;
      if (!(twice > 0.0) || facet >= offset_.size()) continue;
      const glm::dvec3 normal = cross / twice;
      normal_x_[facet] = normal.x;
      normal_y_[facet] = normal.y;
      normal_z_[facet] = normal.z;
      offset_[facet] = glm::dot(normal, a);
    }
  }
}

FlightEnds FacetPlanes::ends_of(const Rays& rays) const {
  const glm::dmat3& m = tracer_->to_world();
  const glm::dvec3 origin = tracer_->world_point(glm::dvec3(0.0));
  return {rays.x.data(),
          rays.y.data(),
          rays.z.data(),
          rays.dx.data(),
          rays.dy.data(),
          rays.dz.data(),
          rays.length.data(),
          rays.facet.data(),
          normal_x_.data(),
          normal_y_.data(),
          normal_z_.data(),
          offset_.data(),
          origin.x,
          origin.y,
          origin.z,
          m[0].x,
          m[1].x,
          m[2].x,
          m[0].y,
          m[1].y,
          m[2].y,
          m[0].z,
          m[1].z,
          m[2].z};
}

}  // namespace lichtmc
