#include "room/close_triangles.hpp"

#include <array>
#include <cmath>

#include <glm/geometric.hpp>

#include "room/sorted_points.hpp"

namespace lichtmc {

namespace {

// Whether a point lies within reach of the outline of a triangle, seen along its normal (length 1), or inside it.
bool is_over(const std::array<glm::dvec3, 3>& corners, const glm::dvec3& normal, const glm::dvec3& point,
             double reach_m) {
  for (std::size_t k = 0; k < 3; ++k) {
    const glm::dvec3 side = corners[(k + 1) % 3] - corners[k];
    const double length = glm::length(side);
    if (!(length > 0.0)) continue;
    const glm::dvec3 inwards = glm::cross(normal, side / length);
    if (glm::dot(point - corners[k], inwards) < -reach_m) return false;
  }
  return true;
}

}  // namespace

std::vector<std::vector<CloseTriangle>> close_triangles(const Room& room, const std::vector<glm::dvec3>& points,
                                                        double reach_m) {
  std::vector<std::vector<CloseTriangle>> close(points.size());
  const SortedPoints sorted(points);
  for (std::size_t n = 0; n < room.surfaces.size(); ++n) {
    const Surface& surface = room.surfaces[n];
    for (const glm::uvec3& t : surface.triangles) {
      const std::array<glm::dvec3, 3> corners{surface.positions[t.x], surface.positions[t.y], surface.positions[t.z]};
      Bounds box;
      for (const glm::dvec3& corner : corners) box.add(corner);
      box.low -= reach_m;
      box.high += reach_m;
      sorted.for_each_in(box, [&](std::size_t k) {
        const glm::dvec3 cross = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
        const double length = glm::length(cross);
        if (!(length > 0.0)) return;
        const glm::dvec3 normal = cross / length;
        const double distance = glm::dot(points[k] - corners[0], normal);
        if (std::abs(distance) <= reach_m && is_over(corners, normal, points[k], reach_m))
          close[k].push_back({n, corners[0], normal, distance});
      });
    }
  }
  return close;
}

}  // namespace lichtmc
