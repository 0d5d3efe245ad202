#include "room/plane_section.hpp"

#include <cstddef>

#include <glm/geometric.hpp>

namespace lichtmc {

std::vector<std::array<glm::dvec3, 2>> section_of(const Room& room, const glm::dvec3& point, const glm::dvec3& normal) {
  std::vector<std::array<glm::dvec3, 2>> lines;
  std::vector<double> height;  // of each corner over the plane
  for (const Surface& surface : room.surfaces) {
    height.clear();
    for (const glm::dvec3& corner : surface.positions) height.push_back(glm::dot(corner - point, normal));
    for (const glm::uvec3& triangle : surface.triangles) {
      std::array<glm::dvec3, 2> line{};
      std::size_t ends = 0;
      for (int k = 0; k < 3 && ends < 2; ++k) {
        const std::size_t a = triangle[k];
        const std::size_t b = triangle[(k + 1) % 3];
        if ((height[a] >= 0.0) == (height[b] >= 0.0)) continue;
        line[ends++] =
            surface.positions[a] + height[a] / (height[a] - height[b]) * (surface.positions[b] - surface.positions[a]);
      }
      if (ends == 2) lines.push_back(line);
    }
  }
  return lines;
}

}  // namespace lichtmc
