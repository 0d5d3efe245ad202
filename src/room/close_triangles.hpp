// The surfaces that points lie on, or so close to that a tracer cannot separate them.
#pragma once

#include <cstddef>
#include <vector>

#include <glm/vec3.hpp>

#include "lichtmc/room.hpp"

namespace lichtmc {

// The plane of a triangle close to a point. World coordinates, m.
struct CloseTriangle {
  std::size_t surface = 0;  // index into Room::surfaces
  glm::dvec3 corner{0.0};   // a point of the plane
  glm::dvec3 normal{0.0};   // length 1, to the front of the surface
  double distance_m = 0.0;  // of the point from the plane, > 0 in front of it
};

// For each of several points the triangles that lie within reach_m ≥ 0 of it: the point's distance from the plane and
// its distance from the outline, measured in the plane, are at most reach_m. Triangles without area are left out. The
// time grows with n log n for n points and triangles, as long as few boxes of triangles contain many points.
std::vector<std::vector<CloseTriangle>> close_triangles(const Room& room, const std::vector<glm::dvec3>& points,
                                                        double reach_m);

}  // namespace lichtmc
