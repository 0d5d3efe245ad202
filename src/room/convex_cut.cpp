#include "room/convex_cut.hpp"

#include <cstddef>
#include <utility>

namespace lichtmc {

namespace {

double cross(const glm::dvec2& a, const glm::dvec2& b) {
  return a.x * b.y - a.y * b.x;
}

// The part where sign · (distance to the left of the line) ≥ 0 (I. Sutherland, G. Hodgman: Reentrant Polygon Clipping,
// 1974).
ConvexPolygon part(const glm::dvec2& a, const glm::dvec2& b, const ConvexPolygon& polygon, double sign) {
  ConvexPolygon kept;
  const glm::dvec2 along = b - a;
  for (std::size_t n = 0; n < polygon.size(); ++n) {
    const glm::dvec2& here = polygon[n];
    const glm::dvec2& next = polygon[(n + 1) % polygon.size()];
    const double at_here = sign * cross(along, here - a);
    const double at_next = sign * cross(along, next - a);
    if (at_here >= 0.0) kept.push_back(here);
    if ((at_here > 0.0 && at_next < 0.0) || (at_here < 0.0 && at_next > 0.0))
      kept.push_back(here + at_here / (at_here - at_next) * (next - here));
  }
  if (kept.size() < 3) kept.clear();
  return kept;
}

}  // namespace

double twice_signed_area(const ConvexPolygon& polygon) {
  double sum = 0.0;
  for (std::size_t n = 1; n + 1 < polygon.size(); ++n)
    sum += cross(polygon[n] - polygon[0], polygon[n + 1] - polygon[0]);
  return sum;
}

ConvexPolygon left_of(const glm::dvec2& a, const glm::dvec2& b, const ConvexPolygon& polygon) {
  return part(a, b, polygon, 1.0);
}

ConvexPolygon right_of(const glm::dvec2& a, const glm::dvec2& b, const ConvexPolygon& polygon) {
  return part(a, b, polygon, -1.0);
}

ConvexPolygon cut_out(const FlatTriangle& triangle, const ConvexPolygon& polygon, std::vector<ConvexPolygon>& outside) {
  const bool clockwise = cross(triangle[1] - triangle[0], triangle[2] - triangle[0]) < 0.0;
  ConvexPolygon inside = polygon;
  for (std::size_t n = 0; n < 3 && !inside.empty(); ++n) {
    const glm::dvec2& from = triangle[n];
    const glm::dvec2& to = triangle[(n + 1) % 3];
    const glm::dvec2& a = clockwise ? to : from;
    const glm::dvec2& b = clockwise ? from : to;
    ConvexPolygon beyond = right_of(a, b, inside);
    if (!beyond.empty()) outside.push_back(std::move(beyond));
    inside = left_of(a, b, inside);
  }
  return inside;
}

}  // namespace lichtmc
