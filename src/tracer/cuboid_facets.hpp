// The walls of a cuboid as facets, and the triangles of the room on them.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "lichtmc/room.hpp"
#include "lichtmc/tiles.hpp"
#include "room/cuboid_shape.hpp"
#include "tracer/facet.hpp"
#include "tracer/tracer.hpp"

namespace lichtmc {

// A face's own coordinates: s along the next axis, t along the one after, in cyclic order.
constexpr std::size_t axis_of(std::size_t face) {
  return face / 2;
}
constexpr std::size_t s_axis(std::size_t axis) {
  return (axis + 1) % 3;
}
constexpr std::size_t t_axis(std::size_t axis) {
  return (axis + 2) % 3;
}

struct CuboidFacets {
  std::vector<Facet> facets;                            // of the six faces
  std::vector<std::vector<TriangleOnFacet>> triangles;  // [surface][triangle]
};

// None if a face consists of several surfaces, or if its UVs are not one affine transformation.
std::optional<CuboidFacets> facets_of_cuboid(const Room& room, const Tiling& tiling, const CuboidShape& shape);

}  // namespace lichtmc
