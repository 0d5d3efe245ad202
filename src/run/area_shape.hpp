// Shapes of calculation areas in their planes, and the rectangles of their grids.
#pragma once

#include <array>
#include <functional>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "lichtmc/area.hpp"
#include "run/floor_outline.hpp"

namespace lichtmc {

// A plane with coordinates (a, b), m. Seen from the side of its normal, a points to the right and b down; in a level
// plane seen from above they are x and z.
struct AreaPlane {
  AreaPlane(const glm::dvec3& point, const glm::dvec3& unit_normal);

  glm::dvec3 in_space(const glm::dvec2& p) const { return origin + p.x * a + p.y * b; }
  glm::dvec2 on_plane(const glm::dvec3& p) const;
  bool is_level() const;

  glm::dvec3 normal;
  glm::dvec3 origin{0.0};
  glm::dvec3 a{0.0};
  glm::dvec3 b{0.0};
};

using SpaceTriangle = std::array<glm::dvec3, 3>;

struct AreaShape {
  // Triangles of a plane; `rounding` (m): corners that are nearer to each other are the same.
  AreaShape(const AreaPlane& plane, const std::vector<SpaceTriangle>& in_space, double rounding);

  bool contains(const glm::dvec2& p) const;
  std::vector<glm::dvec2> corners() const;

  AreaPlane plane;
  std::vector<std::array<glm::dvec2, 3>> triangles;
  std::vector<PlanLine> outline;  // the sides of triangles that no other has
};

// A rectangle in a plane: low … high along a direction of length 1 and across it.
struct PlaneRectangle {
  glm::dvec2 along{1.0, 0.0};
  glm::dvec2 low{0.0};
  glm::dvec2 high{0.0};

  glm::dvec2 across() const { return {-along.y, along.x}; }
  glm::dvec2 point(const glm::dvec2& r) const { return r.x * along + r.y * across(); }
  glm::dvec2 size() const { return high - low; }
  bool empty() const { return size().x <= 0.0 || size().y <= 0.0; }
};

// The smallest rectangle around points; with sides along the axes if no other is noticeably smaller.
PlaneRectangle rectangle_around(const std::vector<glm::dvec2>& points);
// Less a margin on each side.
PlaneRectangle shrunk(PlaneRectangle rectangle, double margin);
// The part of a rectangle with all places that are allowed, to `rounding`; places are tried on a raster of 64 × 64.
// Empty if none is.
PlaneRectangle shrunk_to(const PlaneRectangle& rectangle, const std::function<bool(const glm::dvec2&)>& allowed,
                         double rounding);

}  // namespace lichtmc
