#include "room/triangle_shapes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace lichtmc {

std::vector<TriangleShape> triangle_shapes(const Surface& surface) {
  std::vector<TriangleShape> shapes(surface.triangles.size());
  for (std::size_t k = 0; k < shapes.size(); ++k) {
    const glm::uvec3 corner = surface.triangles[k];
    const glm::dvec3 a = surface.positions[corner.x];
    const glm::dvec3 b = surface.positions[corner.y];
    const glm::dvec3 c = surface.positions[corner.z];
    const glm::dvec3 cross = glm::cross(b - a, c - a);
    const double length = glm::length(cross);
    if (!(length > 0.0) || !std::isfinite(length)) continue;
    const double longest = std::max({glm::length(b - a), glm::length(c - b), glm::length(a - c)});
    shapes[k] = {0.5 * length, length / longest, cross / length};
  }
  return shapes;
}

std::vector<TriangleSample> sample_triangles(const Surface& surface) {
  constexpr std::size_t samples = 16;
  std::vector<TriangleSample> result;
  const std::size_t stride = std::max<std::size_t>(1, surface.triangles.size() / samples);
  for (std::size_t n = 0; n < surface.triangles.size(); n += stride) {
    const glm::uvec3 corner = surface.triangles[n];
    const glm::dvec3 a = surface.positions[corner.x];
    const glm::dvec3 b = surface.positions[corner.y] - a;
    const glm::dvec3 c = surface.positions[corner.z] - a;
    const glm::dvec3 cross = glm::cross(b, c);
    const double length = glm::length(cross);
    if (length > 0.0) result.push_back({a + (b + c) / 3.0, cross / length, std::sqrt(length)});
  }
  return result;
}

double largest_extent_m(const Surface& surface) {
  glm::dvec3 low(std::numeric_limits<double>::max());
  glm::dvec3 high(std::numeric_limits<double>::lowest());
  for (const glm::uvec3& corner : surface.triangles) {
    for (int n = 0; n < 3; ++n) {
      low = glm::min(low, surface.positions[corner[n]]);
      high = glm::max(high, surface.positions[corner[n]]);
    }
  }
  if (surface.triangles.empty()) return 0.0;
  return std::max({high.x - low.x, high.y - low.y, high.z - low.z});
}

}  // namespace lichtmc
