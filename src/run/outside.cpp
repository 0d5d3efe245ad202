#include "run/outside.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

#include <glm/geometric.hpp>

#include "room/bounds.hpp"
#include "room/close_triangles.hpp"
#include "room/cuboid_shape.hpp"
#include "room/emitter_shape.hpp"
#include "room/enclosure.hpp"
#include "tracer/touch.hpp"

namespace lichtmc {

namespace {

double largest_of(const glm::dvec3& size) {
  return std::max({size.x, size.y, size.z});
}

// Which points no closed shell contains; none if the room is not closed.
std::vector<bool> without_shell(const Room& room, const std::vector<glm::dvec3>& points, const Bounds& bounds) {
  constexpr double slack = 1e-6;  // of the room's size, as WeldedMesh
  const Enclosure enclosure(room);
  std::vector<bool> outside(points.size(), false);
  if (enclosure.has_shell_over(bounds, slack * largest_of(bounds.high - bounds.low))) {
    outside = enclosure.encloses_each(points);
    outside.flip();
    return outside;
  }
  // Walls that meet only in T-junctions are no closed shell.
  const std::optional<CuboidShape> cuboid = recognise_cuboid(room);
  for (std::size_t k = 0; cuboid && k < points.size(); ++k) {
    for (const glm::dvec3& edge : cuboid->edges) {
      const double along = glm::dot(points[k] - cuboid->corner, edge) / glm::dot(edge, edge);
      if (along < 0.0 || along > 1.0) outside[k] = true;
    }
  }
  return outside;
}

// Points just in front of some triangles of a surface, distributed over it.
std::vector<glm::dvec3> in_front_of(const Surface& surface) {
  constexpr std::size_t most = 16;
  constexpr double share = 1e-4;  // of the triangle's size
  std::vector<glm::dvec3> points;
  const std::size_t stride = std::max<std::size_t>(1, surface.triangles.size() / most);
  for (std::size_t n = 0; n < surface.triangles.size(); n += stride) {
    const glm::uvec3 t = surface.triangles[n];
    const glm::dvec3 a = surface.positions[t.x];
    const glm::dvec3 b = surface.positions[t.y] - a;
    const glm::dvec3 c = surface.positions[t.z] - a;
    const glm::dvec3 cross = glm::cross(b, c);
    const double length = glm::length(cross);
    if (length > 0.0) points.push_back(a + (b + c) / 3.0 + share * std::sqrt(length) * (cross / length));
  }
  return points;
}

}  // namespace

std::vector<bool> points_outside(const Room& room, const std::vector<glm::dvec3>& points_m) {
  if (points_m.empty()) return {};
  const Bounds bounds = bounds_of(room);
  const double extent = largest_of(bounds.high - bounds.low);
  std::vector<bool> outside = without_shell(room, points_m, bounds);
  std::vector<std::size_t> numbers;
  std::vector<glm::dvec3> candidates;
  for (std::size_t k = 0; k < points_m.size(); ++k) {
    if (!outside[k]) continue;
    numbers.push_back(k);
    candidates.push_back(points_m[k]);
  }
  const auto close = close_triangles(room, candidates, NearPlane::most_rounding * extent);
  for (std::size_t n = 0; n < numbers.size(); ++n) {
    for (const CloseTriangle& triangle : close[n]) {
      const NearPlane plane{candidates[n], triangle.corner, triangle.normal, extent};
      if (std::abs(triangle.distance_m) <= plane.rounding()) outside[numbers[n]] = false;
    }
  }
  return outside;
}

std::vector<bool> emitters_beyond_walls(const Room& room) {
  std::vector<glm::dvec3> points;
  std::vector<std::size_t> emitter_of;
  for (std::size_t k = 0; k < room.emitters.size(); ++k) {
    const auto add = [&](const glm::dvec3& point) {
      points.push_back(point);
      emitter_of.push_back(k);
    };
    visit_shape(
        room.emitters[k], [&](const auto& point) { add(point.position); },
        [&](const auto& area_light) {
          for (const glm::dvec3& point : in_front_of(room.surfaces[area_light.surface])) add(point);
        });
  }
  const std::vector<bool> outside = points_outside(room, points);
  std::vector<bool> beyond(room.emitters.size(), true);
  std::vector<bool> tested(room.emitters.size(), false);
  for (std::size_t n = 0; n < points.size(); ++n) {
    tested[emitter_of[n]] = true;
    if (!outside[n]) beyond[emitter_of[n]] = false;
  }
  for (std::size_t k = 0; k < beyond.size(); ++k) beyond[k] = beyond[k] && tested[k];
  return beyond;
}

}  // namespace lichtmc
