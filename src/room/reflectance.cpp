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

// Mean over a triangle by n × n congruent parts, each evaluated at its centroid: exact where ρ is linear. at(i, j): ρ
// at i/n of the way to the second corner and j/n to the third.
template <class At>
double mean_over(int n, const At& at) {
  double sum = 0.0;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; i + j < n; ++j) {
      sum += at(i + 1.0 / 3.0, j + 1.0 / 3.0);
      if (i + j + 1 < n) sum += at(i + 2.0 / 3.0, j + 2.0 / 3.0);
    }
  }
  return sum / (double{1} * n * n);
}

// Mean of a surface whose ρ varies by vertex colours alone. Without a limit ρ is linear over each triangle, and one
// part is exact. With one it has a kink; 64 × 64 parts leave an error below 1e-4 of the range of ρ: only the 2 · 64
// parts that the kink crosses have one, and in them it is below a sixth of the change of ρ over a part, which is 1/64
// of the range.
double mean_by_colours(const Surface& surface, const glm::uvec3& t, bool limited) {
  const glm::dvec3& c = surface.vertex_colours[t.x];
  const int n = limited ? 64 : 1;
  const glm::dvec3 a = (surface.vertex_colours[t.y] - c) / static_cast<double>(n);
  const glm::dvec3 b = (surface.vertex_colours[t.z] - c) / static_cast<double>(n);
  return mean_over(n, [&](double i, double j) {
    return coloured_reflectance(c + i * a + j * b, nullptr, {}, surface.highest_reflectance);
  });
}

// Mean of a surface whose ρ varies by a map, in n × n parts.
double mean_by_map(const Surface& surface, const glm::uvec3& t, int n, const ReflectanceMap& map) {
  const Corners corner = reflectance_map_corners(surface, t);
  const glm::dvec2 a = (corner[1] - corner[0]) / static_cast<double>(n);
  const glm::dvec2 b = (corner[2] - corner[0]) / static_cast<double>(n);
  const auto uv_at = [&](double i, double j) { return corner[0] + i * a + j * b; };
  if (surface.vertex_colours.empty()) {
    return mean_over(n, [&](double i, double j) {
      const glm::dvec2 uv = uv_at(i, j);
      return reflectance_at(map, uv.x, uv.y);
    });
  }
  const glm::dvec3& c = surface.vertex_colours[t.x];
  const glm::dvec3 c_a = (surface.vertex_colours[t.y] - c) / static_cast<double>(n);
  const glm::dvec3 c_b = (surface.vertex_colours[t.z] - c) / static_cast<double>(n);
  return mean_over(n, [&](double i, double j) {
    return coloured_reflectance(c + i * c_a + j * c_b, &map, uv_at(i, j), surface.highest_reflectance);
  });
}

// Parts per side of each triangle: one per pixel, but no more than some million parts per surface.
class Parts {
 public:
  Parts(const Surface& surface, const ReflectanceMap& map) : surface_(surface), pixels_(map.columns, map.rows) {
    constexpr double most_parts = 0x1p21;
    double parts = 0.0;
    for (const glm::uvec3& t : surface.triangles) {
      const double across = std::ceil(pixels_across(reflectance_map_corners(surface, t), pixels_));
      parts += across * across;
    }
    coarser_ = std::min(1.0, std::sqrt(most_parts / std::max(parts, 1.0)));
  }
  int of(const glm::uvec3& t) const {
    const double across = std::ceil(coarser_ * pixels_across(reflectance_map_corners(surface_, t), pixels_));
    return static_cast<int>(std::clamp(across, 1.0, 2048.0));
  }

 private:
  const Surface& surface_;
  glm::dvec2 pixels_;
  double coarser_ = 1.0;
};

// The mean over a surface of the means of its triangles.
template <class MeanOf>
double mean_over_area(const Surface& surface, const MeanOf& mean_of) {
  double sum = 0.0;
  double area = 0.0;
  for (const glm::uvec3& t : surface.triangles) {
    const glm::dvec3& a = surface.positions[t.x];
    const double twice = glm::length(glm::cross(surface.positions[t.y] - a, surface.positions[t.z] - a));
    sum += twice * mean_of(t);
    area += twice;
  }
  return area > 0.0 ? sum / area : surface.reflectance;
}

double highest_luminance(const Surface& surface) {
  double highest = 0.0;
  for (const glm::dvec3& c : surface.vertex_colours) highest = std::max(highest, luminance(c.x, c.y, c.z));
  return highest;
}

}  // namespace

HighestReflectance::HighestReflectance(const Room& room) {
  for (const ReflectanceMap& reflectance_map : room.reflectance_maps)
    of_reflectance_map_.push_back(
        double{*std::max_element(reflectance_map.values.begin(), reflectance_map.values.end())});
}

double HighestReflectance::of(const Surface& surface) const {
  if (surface.vertex_colours.empty())
    return surface.reflectance_map ? of_reflectance_map_[*surface.reflectance_map] : surface.reflectance;
  const double of_map = surface.reflectance_map ? of_reflectance_map_[*surface.reflectance_map] : 1.0;
  return std::min(of_map * highest_luminance(surface), surface.highest_reflectance);
}

double mean_reflectance(const Room& room, const Surface& surface) {
  if (!has_varying_reflectance(surface)) return surface.reflectance;
  if (!surface.reflectance_map) {
    const bool limited = highest_luminance(surface) > surface.highest_reflectance;
    return mean_over_area(surface, [&](const glm::uvec3& t) { return mean_by_colours(surface, t, limited); });
  }
  const ReflectanceMap& map = room.reflectance_maps[*surface.reflectance_map];
  const Parts parts(surface, map);
  return mean_over_area(surface, [&](const glm::uvec3& t) { return mean_by_map(surface, t, parts.of(t), map); });
}

}  // namespace lichtmc
