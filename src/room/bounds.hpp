// The box about a room.
#pragma once

#include <limits>

#include <glm/common.hpp>
#include <glm/vec3.hpp>

#include "lichtmc/room.hpp"

namespace lichtmc {

// A box along the axes; without a point in it low is above high.
struct Bounds {
  glm::dvec3 low{std::numeric_limits<double>::infinity()};
  glm::dvec3 high{-std::numeric_limits<double>::infinity()};

  void add(const glm::dvec3& point) {
    low = glm::min(low, point);
    high = glm::max(high, point);
  }
  bool holds(const glm::dvec3& point) const { return glm::min(point, low) == low && glm::max(point, high) == high; }
};

// The box about all triangles of a room, in m; positions that no triangle uses do not count.
inline Bounds bounds_of(const Room& room) {
  Bounds bounds;
  for (const Surface& surface : room.surfaces) {
    for (const glm::uvec3& triangle : surface.triangles) {
      for (int k = 0; k < 3; ++k) bounds.add(surface.positions[triangle[k]]);
    }
  }
  return bounds;
}

}  // namespace lichtmc
