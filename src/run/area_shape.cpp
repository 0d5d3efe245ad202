#include "run/area_shape.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "room/bounding_rectangle.hpp"
#include "run/outline_corners.hpp"

namespace lichtmc {

namespace {

constexpr glm::dvec3 upwards(0.0, 1.0, 0.0);

double side_of(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& p) {
  return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
}

}  // namespace

AreaPlane::AreaPlane(const glm::dvec3& point, const glm::dvec3& unit_normal) : normal(unit_normal) {
  // Within 0.06°, 1 cm in 10 m: level. Nobody models such a slope on purpose.
  constexpr double level = 1e-3;
  const double slope = glm::length(glm::dvec2(normal.x, normal.z));
  if (slope < level) {
    normal = {0.0, normal.y < 0.0 ? -1.0 : 1.0, 0.0};
    b = {0.0, 0.0, normal.y};
  } else {
    b = glm::normalize(glm::dot(upwards, normal) * normal - upwards);
  }
  a = glm::cross(normal, b);
  origin = glm::dot(point, normal) * normal;
}

glm::dvec2 AreaPlane::on_plane(const glm::dvec3& p) const {
  return {glm::dot(p - origin, a), glm::dot(p - origin, b)};
}

bool AreaPlane::is_level() const {
  return std::abs(normal.y) == 1.0;
}

AreaShape::AreaShape(const AreaPlane& in_plane, const std::vector<SpaceTriangle>& in_space, double rounding)
    : plane(in_plane) {
  using Corner = std::pair<std::int64_t, std::int64_t>;
  std::map<std::pair<Corner, Corner>, std::pair<int, PlanLine>> sides;
  const auto corner = [rounding](const glm::dvec2& p) {
    return Corner{std::llround(p.x / rounding), std::llround(p.y / rounding)};
  };
  for (const SpaceTriangle& triangle : in_space) {
    std::array<glm::dvec2, 3> flat;
    for (int k = 0; k < 3; ++k)
      flat[static_cast<std::size_t>(k)] = plane.on_plane(triangle[static_cast<std::size_t>(k)]);
    triangles.push_back(flat);
    for (std::size_t k = 0; k < 3; ++k) {
      const glm::dvec2& from = flat[k];
      const glm::dvec2& to = flat[(k + 1) % 3];
      auto& [count, line] = sides[std::minmax(corner(from), corner(to))];
      ++count;
      line = {from, to};
    }
  }
  for (const auto& [ends, side] : sides) {
    if (side.first == 1) outline.push_back(side.second);
  }
}

bool AreaShape::contains(const glm::dvec2& p) const {
  constexpr std::size_t many = 256;  // of a finer mesh, the outline has fewer lines
  if (triangles.size() > many) return is_within(outline, p);
  return std::any_of(triangles.begin(), triangles.end(), [&p](const auto& t) {
    const double whole = side_of(t[0], t[1], t[2]);
    const double sign = whole < 0.0 ? -1.0 : 1.0;
    const double slack = -1e-9 * std::abs(whole);  // a point on a side belongs to both triangles
    return sign * side_of(t[0], t[1], p) >= slack && sign * side_of(t[1], t[2], p) >= slack &&
           sign * side_of(t[2], t[0], p) >= slack;
  });
}

std::vector<glm::dvec2> AreaShape::corners() const {
  std::vector<glm::dvec2> points;
  for (const auto& triangle : triangles) points.insert(points.end(), triangle.begin(), triangle.end());
  return points;
}

namespace {

PlaneRectangle rectangle_along(const std::vector<glm::dvec2>& points, const glm::dvec2& along) {
  PlaneRectangle rectangle{along, glm::dvec2(std::numeric_limits<double>::infinity()),
                           glm::dvec2(-std::numeric_limits<double>::infinity())};
  for (const glm::dvec2& p : points) {
    const glm::dvec2 r(glm::dot(p, along), glm::dot(p, rectangle.across()));
    rectangle.low = glm::min(rectangle.low, r);
    rectangle.high = glm::max(rectangle.high, r);
  }
  return rectangle;
}

double area_of(const PlaneRectangle& rectangle) {
  return rectangle.size().x * rectangle.size().y;
}

}  // namespace

PlaneRectangle rectangle_around(const std::vector<glm::dvec2>& points) {
  // Coordinates have some millionths of error; the angle of a side of a tenth of the room then some 10⁻⁵.
  constexpr double noticeable = 1e-4;
  const PlaneRectangle upright = rectangle_along(points, {1.0, 0.0});
  const PlaneRectangle smallest = rectangle_along(points, smallest_rectangle(points));
  return area_of(upright) <= (1.0 + noticeable) * area_of(smallest) ? upright : smallest;
}

PlaneRectangle shrunk(PlaneRectangle rectangle, double margin) {
  rectangle.low += margin;
  rectangle.high -= margin;
  return rectangle;
}

PlaneRectangle shrunk_to(const PlaneRectangle& rectangle, const std::function<bool(const glm::dvec2&)>& allowed,
                         double rounding) {
  constexpr int places = 64;
  const auto across = [&](int side, double at) {  // whether a place on this line is allowed
    for (int k = 0; k < places; ++k) {
      glm::dvec2 r = rectangle.low + (k + 0.5) / places * rectangle.size();
      r[side] = at;
      if (allowed(rectangle.point(r))) return true;
    }
    return false;
  };
  PlaneRectangle result = rectangle;
  for (int side = 0; side < 2; ++side) {
    const double step = rectangle.size()[side] / places;
    int first = 0;
    while (first < places && !across(side, rectangle.low[side] + (first + 0.5) * step)) ++first;
    if (first == places) return {rectangle.along, {}, {}};
    int last = places - 1;
    while (!across(side, rectangle.low[side] + (last + 0.5) * step)) --last;
    const auto limit = [&](double inside, double outside) {
      if (across(side, outside)) return outside;
      while (std::abs(outside - inside) > rounding) {
        const double middle = 0.5 * (inside + outside);
        (across(side, middle) ? inside : outside) = middle;
      }
      return inside;
    };
    const double low = rectangle.low[side];
    result.low[side] = limit(low + (first + 0.5) * step, first == 0 ? low : low + (first - 0.5) * step);
    const double high = rectangle.high[side];
    result.high[side] = limit(low + (last + 0.5) * step, last + 1 == places ? high : low + (last + 1.5) * step);
    result.low[side] = short_decimal(result.low[side], 2.0 * rounding);
    result.high[side] = short_decimal(result.high[side], 2.0 * rounding);
  }
  return result;
}

}  // namespace lichtmc
