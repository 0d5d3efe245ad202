#include "room/cuboid_shape.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "room/triangle_shapes.hpp"

namespace lichtmc {

namespace {

constexpr std::size_t most_triangles = 20'000;  // pairs whose ranges meet in one coordinate are tested for overlap

struct Corners {
  std::size_t surface = 0;
  std::size_t triangle = 0;
  std::array<glm::dvec3, 3> position;
  glm::dvec3 cross{0.0};  // normal times twice the area
};

// Ends when there are too many.
std::vector<Corners> solid_triangles(const Room& room) {
  std::vector<Corners> all;
  for (std::size_t k = 0; k < room.surfaces.size(); ++k) {
    const Surface& surface = room.surfaces[k];
    for (std::size_t n = 0; n < surface.triangles.size() && all.size() <= most_triangles; ++n) {
      const glm::uvec3 t = surface.triangles[n];
      Corners corners{k, n, {surface.positions[t.x], surface.positions[t.y], surface.positions[t.z]}, {}};
      corners.cross = glm::cross(corners.position[1] - corners.position[0], corners.position[2] - corners.position[0]);
      if (glm::length(corners.cross) > 0.0) all.push_back(corners);
    }
  }
  return all;
}

// Largest distance of a position from its wall, relative to the largest coordinate: float_noise for the position, and
// the same for each of the three corners that define the wall.
constexpr double rounding = 4.0 * float_noise;

// A vector's direction. Exactly ±1 for one along an axis, because √(x²) = |x| in floating point; glm::normalize
// multiplies by 1/√(x²), which is not.
glm::dvec3 direction_of(const glm::dvec3& v) {
  return v / glm::length(v);
}

// Direction of the vector area of all triangles with normals along `direction` or against it. Positions inside a wall
// and their rounding cancel: only its outline counts.
glm::dvec3 common_normal(const std::vector<Corners>& triangles, const glm::dvec3& direction) {
  glm::dvec3 sum(0.0);
  for (const Corners& t : triangles) {
    const double cosine = glm::dot(direction_of(t.cross), direction);
    if (std::abs(cosine) > 0.9) sum += cosine > 0.0 ? t.cross : -t.cross;
  }
  return direction_of(sum);
}

// Directions of the edges: the normals of the wall with the largest triangle and of the wall with the largest one
// perpendicular to it, and their cross product.
std::optional<std::array<glm::dvec3, 3>> find_axes(const std::vector<Corners>& triangles) {
  const auto larger = [](const Corners& a, const Corners& b) { return glm::length(a.cross) < glm::length(b.cross); };
  const Corners& first = *std::max_element(triangles.begin(), triangles.end(), larger);
  const glm::dvec3 n0 = common_normal(triangles, direction_of(first.cross));
  const Corners* second = nullptr;
  for (const Corners& t : triangles) {
    // In a cuboid a normal is along n0 or perpendicular to it.
    if (std::abs(glm::dot(direction_of(t.cross), n0)) > 0.5) continue;
    if (second == nullptr || larger(*second, t)) second = &t;
  }
  if (second == nullptr) return std::nullopt;
  const glm::dvec3 tilted = common_normal(triangles, direction_of(second->cross));
  const glm::dvec3 n1 = direction_of(tilted - glm::dot(tilted, n0) * n0);
  std::array<glm::dvec3, 3> axes{n0, n1, glm::cross(n0, n1)};
  // In the order and sense of the world's axes, as far as possible.
  for (int k = 0; k < 3; ++k) {
    const auto place = static_cast<std::size_t>(k);
    std::size_t best = place;
    for (std::size_t j = place; j < 3; ++j) {
      if (std::abs(axes[j][k]) > std::abs(axes[best][k])) best = j;
    }
    std::swap(axes[place], axes[best]);
    if (axes[place][k] < 0.0) axes[place] = -axes[place];
  }
  if (glm::dot(glm::cross(axes[0], axes[1]), axes[2]) < 0.0) axes[2] = -axes[2];
  return axes;
}

using Flat = std::array<glm::dvec2, 3>;

double twice_area(const Flat& t) {
  const glm::dvec2 a = t[1] - t[0];
  const glm::dvec2 b = t[2] - t[0];
  return std::abs(a.x * b.y - a.y * b.x);
}

// Whether some side of a keeps b on its outer side, up to a tolerance.
bool separates(const Flat& a, const Flat& b, double tolerance) {
  const glm::dvec2 middle = (a[0] + a[1] + a[2]) / 3.0;
  for (std::size_t k = 0; k < 3; ++k) {
    const glm::dvec2 side = a[(k + 1) % 3] - a[k];
    const double length = glm::length(side);
    if (!(length > 0.0)) continue;
    glm::dvec2 outward = glm::dvec2(side.y, -side.x) / length;
    if (glm::dot(outward, middle - a[k]) > 0.0) outward = -outward;
    const bool outside =
        std::all_of(b.begin(), b.end(), [&](const glm::dvec2& p) { return glm::dot(outward, p - a[k]) >= -tolerance; });
    if (outside) return true;
  }
  return false;
}

struct Placed {
  Flat corners;
  glm::dvec2 low;
  glm::dvec2 high;
};

// Whether two triangles have more in common than their outlines.
bool overlap(const Placed& a, const Placed& b, double tolerance) {
  if (a.high.y <= b.low.y || b.high.y <= a.low.y) return false;
  return !separates(a.corners, b.corners, tolerance) && !separates(b.corners, a.corners, tolerance);
}

// Triangles cover the unit square exactly once if their areas add up to 1 and no two overlap.
bool cover_the_square(const std::vector<Flat>& triangles, const glm::dvec2& tolerance) {
  double area = 0.0;
  std::vector<Placed> placed;
  for (const Flat& t : triangles) {
    area += 0.5 * twice_area(t);
    placed.push_back({t, glm::min(t[0], glm::min(t[1], t[2])), glm::max(t[0], glm::max(t[1], t[2]))});
  }
  // The outline may deviate by the tolerance on each of four sides.
  if (std::abs(area - 1.0) > 2.0 * (tolerance.x + tolerance.y)) return false;
  // From left to right, a triangle is compared with those that begin before it ends.
  std::sort(placed.begin(), placed.end(), [](const Placed& a, const Placed& b) { return a.low.x < b.low.x; });
  const double widest = std::max(tolerance.x, tolerance.y);
  for (std::size_t i = 0; i < placed.size(); ++i) {
    for (std::size_t j = i + 1; j < placed.size() && placed[j].low.x < placed[i].high.x; ++j) {
      if (overlap(placed[i], placed[j], widest)) return false;
    }
  }
  return true;
}

// The face that a triangle lies in, given its corners in the unit cube; 6 if it lies in none.
std::uint8_t face_of(const std::array<glm::dvec3, 3>& p, const glm::dvec3& tolerance) {
  for (int axis = 0; axis < 3; ++axis) {
    for (int end = 0; end < 2; ++end) {
      const bool in_plane = std::all_of(
          p.begin(), p.end(), [&](const glm::dvec3& q) { return std::abs(q[axis] - end) <= tolerance[axis]; });
      if (in_plane) return static_cast<std::uint8_t>(2 * axis + end);
    }
  }
  return 6;
}

// Triangles in the axes of a cuboid, relative to one corner, so that the distance from the origin costs no precision.
struct AlongAxes {
  glm::dvec3 origin{0.0};
  std::vector<std::array<glm::dvec3, 3>> corners;  // of each triangle
  glm::dvec3 low{std::numeric_limits<double>::infinity()};
  glm::dvec3 high{-std::numeric_limits<double>::infinity()};
  glm::dvec3 largest{0.0};  // size of a coordinate in the room's own axes
};

AlongAxes lay_along(const std::array<glm::dvec3, 3>& axes, const std::vector<Corners>& triangles) {
  AlongAxes along;
  along.origin = triangles.front().position[0];
  const auto in_axes = [&](const glm::dvec3& p) {
    const glm::dvec3 d = p - along.origin;
    return glm::dvec3(glm::dot(d, axes[0]), glm::dot(d, axes[1]), glm::dot(d, axes[2]));
  };
  for (const Corners& t : triangles) {
    along.corners.push_back({in_axes(t.position[0]), in_axes(t.position[1]), in_axes(t.position[2])});
    for (const glm::dvec3& p : along.corners.back()) {
      along.low = glm::min(along.low, p);
      along.high = glm::max(along.high, p);
    }
    for (const glm::dvec3& p : t.position) along.largest = glm::max(along.largest, glm::abs(p));
  }
  return along;
}

// Tolerances as shares of the edges, from the largest coordinates' sizes. In a rotated room rounding mixes the
// coordinates: the error along the shortest edge depends on the longest one. This does not apply if the edges lie along
// the world's axes.
glm::dvec3 tolerances(const std::array<glm::dvec3, 3>& axes, const glm::dvec3& size, const glm::dvec3& largest) {
  const bool aligned = axes[0].x == 1.0 && axes[1].y == 1.0 && axes[2].z == 1.0;
  if (aligned) return rounding * largest / size;
  return rounding * std::max({largest.x, largest.y, largest.z}) / size;
}

// Larger deviations are not rounding: the areas of a wall would not reveal a hole of 1 % of it.
constexpr double largest_tolerance = 0.002;

}  // namespace

std::optional<CuboidShape> recognise_cuboid(const Room& room) {
  const std::vector<Corners> triangles = solid_triangles(room);
  if (triangles.size() < 12 || triangles.size() > most_triangles) return std::nullopt;
  const auto axes = find_axes(triangles);
  if (!axes) return std::nullopt;

  AlongAxes along = lay_along(*axes, triangles);
  const glm::dvec3 size = along.high - along.low;
  const glm::dvec3 tolerance = tolerances(*axes, size, along.largest);
  // An edge must be well above the rounding.
  if (!(std::min({size.x, size.y, size.z}) > 0.0) ||
      std::max({tolerance.x, tolerance.y, tolerance.z}) > largest_tolerance)
    return std::nullopt;

  CuboidShape shape;
  for (const Surface& surface : room.surfaces)
    shape.face_of_triangle.emplace_back(surface.triangles.size(), std::uint8_t{0});
  std::array<std::vector<Flat>, 6> faces;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    auto& p = along.corners[i];
    for (glm::dvec3& corner : p) corner = (corner - along.low) / size;
    const std::uint8_t face = face_of(p, tolerance);
    if (face == 6) return std::nullopt;
    shape.face_of_triangle[triangles[i].surface][triangles[i].triangle] = face;
    const int s = (face / 2 + 1) % 3;
    const int t = (face / 2 + 2) % 3;
    faces[face].push_back({glm::dvec2(p[0][s], p[0][t]), glm::dvec2(p[1][s], p[1][t]), glm::dvec2(p[2][s], p[2][t])});
  }
  for (std::size_t face = 0; face < 6; ++face) {
    const int axis = static_cast<int>(face / 2);
    if (!cover_the_square(faces[face], {tolerance[(axis + 1) % 3], tolerance[(axis + 2) % 3]})) return std::nullopt;
  }
  const glm::dvec3& low = along.low;
  shape.corner = along.origin + low.x * (*axes)[0] + low.y * (*axes)[1] + low.z * (*axes)[2];
  for (int k = 0; k < 3; ++k) shape.edges[static_cast<std::size_t>(k)] = size[k] * (*axes)[static_cast<std::size_t>(k)];
  return shape;
}

}  // namespace lichtmc
