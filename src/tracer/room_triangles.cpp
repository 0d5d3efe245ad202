#include "tracer/room_triangles.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <glm/geometric.hpp>

#include "base/frame.hpp"
#include "base/parallel.hpp"
#include "room/bounds.hpp"

namespace lichtmc {

Placement placement_of(const Room& room) {
  const auto [low, high] = bounds_of(room);
  const glm::dvec3 half = 0.5 * (high - low);
  int exponent = 0;
  std::frexp(std::max({half.x, half.y, half.z}), &exponent);
  return {low + half, std::ldexp(1.0, -exponent)};
}

namespace {

// Triangles that a thread treats at a time: some milliseconds of work.
constexpr std::size_t at_a_time = 16384;

// The cross product of two sides, scaled first: otherwise that of a tiny room's edges would underflow.
glm::dvec3 scaled_cross(const Surface& surface, const glm::uvec3& triangle, const Placement& placement) {
  const glm::dvec3 a = surface.positions[triangle.x];
  return glm::cross(placement.scale * (surface.positions[triangle.y] - a),
                    placement.scale * (surface.positions[triangle.z] - a));
}

// A triangle without area has no tile, and any normal.
glm::dvec3 normal_of(const glm::dvec3& cross) {
  const double length = glm::length(cross);
  return length > 0.0 ? cross / length : glm::dvec3(0.0, 1.0, 0.0);
}

std::size_t triangles_of(const Room& room) {
  std::size_t count = 0;
  for (const Surface& surface : room.surfaces) count += surface.triangles.size();
  return count;
}

}  // namespace

RoomTriangles make_triangles(const Room& room, const Placement& placement, unsigned threads) {
  RoomTriangles made;
  const std::size_t count = triangles_of(room);
  made.corners.resize(count);
  made.departures.resize(count);
  std::size_t first = 0;
  for (const Surface& surface : room.surfaces) {
    const auto first_vertex = static_cast<std::uint32_t>(made.vertices.size());
    made.first_facet.push_back(first);
    for (const glm::dvec3& position : surface.positions) made.vertices.emplace_back(placement(position));
    for_each_range(threads, surface.triangles.size(), at_a_time, [&](std::size_t begin, std::size_t end) {
      for (std::size_t n = begin; n < end; ++n) {
        const glm::uvec3 triangle = surface.triangles[n];
        const glm::dvec3 cross = scaled_cross(surface, triangle, placement);
        // Rounded to float, a triangle without area could become a sliver that rays hit: it gets the same corner three
        // times.
        const glm::uvec3 corner = (glm::length(cross) > 0.0 ? triangle : glm::uvec3(triangle.x)) + first_vertex;
        made.corners[first + n] = corner;
        made.departures[first + n] =
            make_departure({made.vertices[corner.x], made.vertices[corner.y], made.vertices[corner.z]},
                           frame_about(normal_of(cross)).normal);
      }
    });
    first += surface.triangles.size();
  }
  return made;
}

std::vector<Facet> make_facets(const Room& room, const Tiling& tiling, const Placement& placement, unsigned threads) {
  std::vector<Facet> facets(triangles_of(room));
  std::size_t first = 0;
  for (std::size_t k = 0; k < room.surfaces.size(); ++k) {
    const Surface& surface = room.surfaces[k];
    for_each_range(threads, surface.triangles.size(), at_a_time, [&](std::size_t begin, std::size_t end) {
      for (std::size_t n = begin; n < end; ++n) {
        const Frame frame = frame_about(normal_of(scaled_cross(surface, surface.triangles[n], placement)));
        const auto& cells = tiling.cells[k][n];
        facets[first + n] = {glm::vec3(frame.tangent),
                             glm::vec3(frame.bitangent),
                             glm::vec3(frame.normal),
                             static_cast<std::uint32_t>(k),
                             cells[0],
                             cells[1] - cells[0],
                             cells[2] - cells[0]};
      }
    });
    first += surface.triangles.size();
  }
  return facets;
}

}  // namespace lichtmc
