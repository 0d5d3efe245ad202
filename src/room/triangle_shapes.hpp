// Size, direction and thinness of a surface's triangles.
#pragma once

#include <vector>

#include <glm/vec3.hpp>

#include "lichtmc/room.hpp"

namespace lichtmc {

// How far two places can appear from each other, relative to the largest coordinate, because coordinates are floats:
// each coordinate of each is off by at most 2⁻²⁵, together at most √2·2⁻²⁴; 2⁻²² leaves room for a transform. Shapes
// thinner than that, and overlaps shallower than that, mean nothing.
inline constexpr double float_noise = 0x1p-22;

struct TriangleShape {
  double area_m2 = 0.0;      // 0 also where the corners are so far out that the area is no finite number
  double thickness_m = 0.0;  // the smallest of its heights
  glm::dvec3 normal{0.0};    // towards the front, length 1; zero where there is no area
};

// The shapes of a surface's triangles, in their order.
std::vector<TriangleShape> triangle_shapes(const Surface& surface);

// The largest edge in metres of the box about all triangles of a surface; 0 where there is none.
double largest_extent_m(const Surface& surface);

}  // namespace lichtmc
