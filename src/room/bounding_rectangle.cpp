#include "room/bounding_rectangle.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include <glm/geometric.hpp>

namespace lichtmc {

namespace {

// A rectangle must be smaller by more than this share to be preferred: the rounding of float coordinates makes no
// difference.
constexpr double noticeable = 1e-6;

double turn(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

// Appends one side of the hull; its first `keep` points stay.
template <class Points>
void add_chain(const Points& points, std::size_t keep, std::vector<glm::dvec2>& hull) {
  for (const glm::dvec2& point : points) {
    while (hull.size() >= keep + 2 && turn(hull[hull.size() - 2], hull.back(), point) <= 0.0) hull.pop_back();
    hull.push_back(point);
  }
  hull.pop_back();
}

// A. M. Andrew: Another efficient algorithm for convex hulls in two dimensions. Information Processing Letters 9(5),
// 1979. Counter-clockwise, without points between corners.
std::vector<glm::dvec2> convex_hull(std::vector<glm::dvec2> points) {
  std::sort(points.begin(), points.end(),
            [](const glm::dvec2& a, const glm::dvec2& b) { return std::tie(a.x, a.y) < std::tie(b.x, b.y); });
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return points;
  std::vector<glm::dvec2> hull;
  add_chain(points, 0, hull);
  std::reverse(points.begin(), points.end());
  add_chain(points, hull.size(), hull);
  return hull;
}

// Advances along the hull while the next corner is further in a direction; at most once around.
std::size_t furthest(const std::vector<glm::dvec2>& hull, const glm::dvec2& direction, std::size_t from) {
  for (std::size_t n = 0; n < hull.size(); ++n) {
    const std::size_t next = (from + 1) % hull.size();
    if (glm::dot(direction, hull[next] - hull[from]) <= 0.0) break;
    from = next;
  }
  return from;
}

// Rotates a direction by quarter turns to within 45° of (1, 0): these are all directions of the same rectangle's sides.
glm::dvec2 near_first_axis(glm::dvec2 direction) {
  if (std::abs(direction.y) > std::abs(direction.x)) direction = {direction.y, -direction.x};
  return direction.x < 0.0 ? -direction : direction;
}

double area_along_axes(const std::vector<glm::dvec2>& points) {
  const auto [left, right] =
      std::minmax_element(points.begin(), points.end(), [](const auto& a, const auto& b) { return a.x < b.x; });
  const auto [bottom, top] =
      std::minmax_element(points.begin(), points.end(), [](const auto& a, const auto& b) { return a.y < b.y; });
  return (right->x - left->x) * (top->y - bottom->y);
}

}  // namespace

// The smallest rectangle has a side along a side of the convex hull (H. Freeman, R. Shapira: Determining the
// minimum-area encasing rectangle for an arbitrary closed curve. Communications of the ACM 18(7), 1975). The four
// points that it touches advance with the side (G. T. Toussaint: Solving geometric problems with the rotating calipers.
// MELECON 1983).
glm::dvec2 smallest_rectangle(const std::vector<glm::dvec2>& points) {
  glm::dvec2 best(1.0, 0.0);
  const std::vector<glm::dvec2> hull = convex_hull(points);
  if (hull.size() < 3) return best;
  double least = area_along_axes(hull);
  std::size_t right = 0;
  std::size_t top = 0;
  std::size_t left = 0;
  for (std::size_t n = 0; n < hull.size(); ++n) {
    const glm::dvec2 along = glm::normalize(hull[(n + 1) % hull.size()] - hull[n]);
    const glm::dvec2 across(-along.y, along.x);
    right = furthest(hull, along, n == 0 ? 0 : right);
    top = furthest(hull, across, n == 0 ? right : top);
    left = furthest(hull, -along, n == 0 ? top : left);
    const double area = glm::dot(along, hull[right] - hull[left]) * glm::dot(across, hull[top] - hull[n]);
    if (area >= least * (1.0 - noticeable)) continue;
    least = area;
    best = near_first_axis(along);
  }
  return best;
}

}  // namespace lichtmc
