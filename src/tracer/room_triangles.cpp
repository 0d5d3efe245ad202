#include "tracer/room_triangles.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <glm/geometric.hpp>

#include "base/frame.hpp"
#include "room/bounds.hpp"

namespace lichtmc {

Placement placement_of(const Room& room) {
  const auto [low, high] = bounds_of(room);
  const glm::dvec3 half = 0.5 * (high - low);
  int exponent = 0;
  std::frexp(std::max({half.x, half.y, half.z}), &exponent);
  return {low + half, std::ldexp(1.0, -exponent)};
}

RoomTriangles make_triangles(const Room& room, const Tiling& tiling, const Placement& placement) {
  RoomTriangles made;
  for (std::size_t k = 0; k < room.surfaces.size(); ++k) {
    const Surface& surface = room.surfaces[k];
    const auto first_vertex = static_cast<std::uint32_t>(made.vertices.size());
    made.first_facet.push_back(made.corners.size());
    for (const glm::dvec3& position : surface.positions) made.vertices.emplace_back(placement(position));
    for (std::size_t n = 0; n < surface.triangles.size(); ++n) {
      const glm::uvec3 triangle = surface.triangles[n];
      const glm::dvec3 a = surface.positions[triangle.x];
      // Scaled first: otherwise the cross product of a tiny room's edges would underflow.
      const glm::dvec3 cross = glm::cross(placement.scale * (surface.positions[triangle.y] - a),
                                          placement.scale * (surface.positions[triangle.z] - a));
      const double length = glm::length(cross);
      // A triangle without area has no tile. Rounded to float, it could become a sliver that rays hit: it gets the same
      // corner three times, and any normal.
      const Frame frame = frame_about(length > 0.0 ? cross / length : glm::dvec3(0.0, 1.0, 0.0));
      const auto& cells = tiling.cells[k][n];
      made.facets.push_back({glm::vec3(frame.tangent), glm::vec3(frame.bitangent), glm::vec3(frame.normal),
                             static_cast<std::uint32_t>(k), cells[0], cells[1] - cells[0], cells[2] - cells[0]});
      made.corners.push_back((length > 0.0 ? triangle : glm::uvec3(triangle.x)) + first_vertex);
      const glm::uvec3 corner = made.corners.back();
      made.departures.push_back(
          make_departure({made.vertices[corner.x], made.vertices[corner.y], made.vertices[corner.z]}, frame.normal));
    }
  }
  return made;
}

}  // namespace lichtmc
