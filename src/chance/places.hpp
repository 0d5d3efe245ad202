// Uniform points on triangles and cosine-weighted directions in cones.
#pragma once

#include <cmath>
#include <numbers>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "base/frame.hpp"

namespace lichtmc {

// Barycentric coordinates of the second and third corner of a point uniform over a triangle's area: √u is the share of
// the way from the first corner to the opposite side, v the place along it. 0 ≤ u, v ≤ 1.
inline glm::dvec2 uniform_on_triangle(double u, double v) {
  const double root = std::sqrt(u);
  return {root * (1.0 - v), root * v};
}

// The point of the triangle a, b, c at these coordinates.
inline glm::dvec3 point_of_triangle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                                    const glm::dvec2& weights) {
  return a + weights.x * (b - a) + weights.y * (c - a);
}

// A direction in the cone about the normal of a frame whose half angle has this squared sine, with a density
// proportional to the cosine of its angle to the normal: cos θ/(π squared_sine). 0 < u < 1 chooses the angle, turns the
// azimuth.
struct ConeDirection {
  glm::dvec3 direction;
  double cosine;  // of its angle to the normal
};
inline ConeDirection sample_cosine_cone(const Frame& frame, double squared_sine, double u, double turns) {
  const double squared = u * squared_sine;
  const double azimuth = 2.0 * std::numbers::pi * turns;
  const double sine = std::sqrt(squared);
  const double cosine = std::sqrt(1.0 - squared);
  return {sine * std::cos(azimuth) * frame.tangent + sine * std::sin(azimuth) * frame.bitangent + cosine * frame.normal,
          cosine};
}

}  // namespace lichtmc
