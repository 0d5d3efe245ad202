// Area, normal and thickness of a surface's triangles.
#pragma once

#include <vector>

#include <glm/vec3.hpp>

#include "lichtmc/room.hpp"

namespace lichtmc {

// The largest distance that float rounding can make between two equal positions, relative to the largest coordinate:
// each coordinate of each has an error of at most 2⁻²⁵, together at most √2·2⁻²⁴; 2⁻²² includes a transformation.
// Thinner shapes and shallower overlaps have no meaning.
inline constexpr double float_noise = 0x1p-22;

struct TriangleShape {
  double area_m2 = 0.0;      // 0 also if the corners are so far out that the area is not finite
  double thickness_m = 0.0;  // the smallest of its heights
  glm::dvec3 normal{0.0};    // towards the front, length 1; zero if there is no area
};

// The shapes of a surface's triangles, in their order.
std::vector<TriangleShape> triangle_shapes(const Surface& surface);

// A triangle of a surface that stands for its neighbours.
struct TriangleSample {
  glm::dvec3 middle{0.0};  // m, its centroid
  glm::dvec3 normal{0.0};  // towards the front, length 1
  double size_m = 0.0;     // √ of twice its area
};

// Some 16 triangles with an area, distributed over a surface: for tests of where it lies.
std::vector<TriangleSample> sample_triangles(const Surface& surface);

// The largest edge, in metres, of the bounding box of all triangles of a surface; 0 if there are none.
double largest_extent_m(const Surface& surface);

}  // namespace lichtmc
