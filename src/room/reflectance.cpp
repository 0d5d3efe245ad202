#include "room/reflectance.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace lichtmc {

namespace {

using Corners = std::array<glm::dvec2, 3>;

Corners reflectance_map_corners(const Surface& surface, const glm::uvec3& triangle) {
  return {surface.reflectance_uvs[triangle.x], surface.reflectance_uvs[triangle.y],
          surface.reflectance_uvs[triangle.z]};
}

// The longest side in pixels.
double pixels_across(const Corners& corner, const glm::dvec2& pixels) {
  return std::max({glm::length((corner[1] - corner[0]) * pixels), glm::length((corner[2] - corner[0]) * pixels),
                   glm::length((corner[2] - corner[1]) * pixels)});
}

// Mean over a triangle by n × n congruent parts, each evaluated at its centroid: exact where ρ is linear.
double mean_over(const Corners& corner, int n, const ReflectanceMap& reflectance_map) {
  const glm::dvec2 a = (corner[1] - corner[0]) / static_cast<double>(n);
  const glm::dvec2 b = (corner[2] - corner[0]) / static_cast<double>(n);
  const auto at = [&](double i, double j) {
    const glm::dvec2 uv = corner[0] + i * a + j * b;
    return reflectance_at(reflectance_map, uv.x, uv.y);
  };
  double sum = 0.0;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; i + j < n; ++j) {
      sum += at(i + 1.0 / 3.0, j + 1.0 / 3.0);
      if (i + j + 1 < n) sum += at(i + 2.0 / 3.0, j + 2.0 / 3.0);
    }
  }
  return sum / (double{1} * n * n);
}

}  // namespace

HighestReflectance::HighestReflectance(const Room& room) {
  for (const ReflectanceMap& reflectance_map : room.reflectance_maps)
    of_reflectance_map_.push_back(
        double{*std::max_element(reflectance_map.values.begin(), reflectance_map.values.end())});
}

double mean_reflectance(const Room& room, const Surface& surface) {
  if (!surface.reflectance_map) return surface.reflectance;
  const ReflectanceMap& reflectance_map = room.reflectance_maps[*surface.reflectance_map];
  const glm::dvec2 pixels(reflectance_map.columns, reflectance_map.rows);
  // One part per pixel, but no more than some million parts per surface.
  constexpr double most_parts = 0x1p21;
  double parts = 0.0;
  for (const glm::uvec3& t : surface.triangles) {
    const double across = std::ceil(pixels_across(reflectance_map_corners(surface, t), pixels));
    parts += across * across;
  }
  const double coarser = std::min(1.0, std::sqrt(most_parts / std::max(parts, 1.0)));

  double sum = 0.0;
  double area = 0.0;
  for (const glm::uvec3& t : surface.triangles) {
    const Corners corner = reflectance_map_corners(surface, t);
    const double across = std::ceil(coarser * pixels_across(corner, pixels));
    const int n = static_cast<int>(std::clamp(across, 1.0, 2048.0));
    const glm::dvec3& a = surface.positions[t.x];
    const double twice = glm::length(glm::cross(surface.positions[t.y] - a, surface.positions[t.z] - a));
    sum += twice * mean_over(corner, n, reflectance_map);
    area += twice;
  }
  return area > 0.0 ? sum / area : surface.reflectance;
}

}  // namespace lichtmc
