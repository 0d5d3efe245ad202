// The bounding box of a room.
#pragma once

#include <limits>

#include <glm/common.hpp>
#include <glm/vec3.hpp>
#include <glm/vector_relational.hpp>

#include "lichtmc/room.hpp"

namespace lichtmc {

// A box along the axes; in an empty one low is above high.
struct Bounds {
  glm::dvec3 low{std::numeric_limits<double>::infinity()};
  glm::dvec3 high{-std::numeric_limits<double>::infinity()};

  void add(const glm::dvec3& point) {
    low = glm::min(low, point);
    high = glm::max(high, point);
  }
  // Whether a point lies in the box, or outside by no more than `slack`.
  bool holds(const glm::dvec3& point, double slack = 0.0) const {
    return glm::all(glm::greaterThanEqual(point, low - slack)) && glm::all(glm::lessThanEqual(point, high + slack));
  }
};

// The bounding box of all triangles of a room, in m; positions that no triangle uses do not count.
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
