// Convex polygons in a plane, cut by lines and triangles.
#pragma once

#include <vector>

#include <glm/vec2.hpp>

#include "room/overlap.hpp"

namespace lichtmc {

using ConvexPolygon = std::vector<glm::dvec2>;  // corners in order, in either sense; empty: nothing

// Twice the signed area: above 0 if the corners are in counter-clockwise order.
double twice_signed_area(const ConvexPolygon& polygon);

// The part of a polygon on the left of the line from a to b (or on it); and the part on the right.
ConvexPolygon left_of(const glm::dvec2& a, const glm::dvec2& b, const ConvexPolygon& polygon);
ConvexPolygon right_of(const glm::dvec2& a, const glm::dvec2& b, const ConvexPolygon& polygon);

// Cuts a triangle out of a polygon: returns the part inside it; the parts outside, at most three, are added to
// `outside`. Neighbouring parts share exactly the same cuts.
ConvexPolygon cut_out(const FlatTriangle& triangle, const ConvexPolygon& polygon, std::vector<ConvexPolygon>& outside);

}  // namespace lichtmc
