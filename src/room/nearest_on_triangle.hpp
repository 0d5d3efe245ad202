// The point of a triangle that is nearest to another point.
#pragma once

#include <glm/vec3.hpp>

namespace lichtmc {

// Of the triangle a, b, c to p (C. Ericson, Real-Time Collision Detection, 2005, 5.1.5).
glm::dvec3 nearest_on_triangle(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c);

}  // namespace lichtmc
