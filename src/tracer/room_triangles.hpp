// A room as triangles in float, one facet each: the input of Embree.
#pragma once

#include <cstddef>
#include <vector>

#include <glm/vec3.hpp>

#include "lichtmc/room.hpp"
#include "lichtmc/tiles.hpp"
#include "tracer/departure.hpp"
#include "tracer/facet.hpp"

namespace lichtmc {

// The room is moved to the origin and scaled by a power of two so that its largest half extent lies in [½, 1): its size
// and position cost no precision.
struct Placement {
  glm::dvec3 centre{0.0};  // of the room, m
  double scale = 1.0;      // 1/m

  // The world, in m → the tracer's coordinates.
  glm::dvec3 operator()(const glm::dvec3& world_m) const { return scale * (world_m - centre); }
};

Placement placement_of(const Room& room);

// The triangles of all surfaces, one surface after the other, in the order of Surface::triangles.
struct RoomTriangles {
  std::vector<glm::vec3> vertices;       // in the tracer's coordinates
  std::vector<glm::uvec3> corners;       // of each triangle, in `vertices`
  std::vector<Departure> departures;     // of each triangle
  std::vector<std::size_t> first_facet;  // of each surface
};

// A triangle without area cannot be hit. On up to `threads` (≥ 1) threads.
RoomTriangles make_triangles(const Room& room, const Placement& placement, unsigned threads);

// The facet of each triangle, in the same order; s and t run to its second and third corner.
std::vector<Facet> make_facets(const Room& room, const Tiling& tiling, const Placement& placement, unsigned threads);

}  // namespace lichtmc
