// Orthonormal frames about a given normal.
#pragma once

#include <cmath>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace lichtmc {

// Right-handed: tangent × bitangent = normal, each of length 1.
struct Frame {
  glm::dvec3 tangent;
  glm::dvec3 bitangent;
  glm::dvec3 normal;
};

// A frame whose normal is `normal` (length 1). Directions about a normal are uniform in azimuth, so any such frame
// serves.
//
// T. Duff, J. Burgess, P. Christensen, C. Hery, A. Kensler, M. Liani, R. Villemin: Building an Orthonormal Basis,
// Revisited. JCGT 6(1), 2017: accurate to rounding for every normal, also for normal.z → −1.
inline Frame frame_about(const glm::dvec3& normal) {
  const double sign = std::copysign(1.0, normal.z);
  const double a = -1.0 / (sign + normal.z);
  const double b = normal.x * normal.y * a;
  return {{1.0 + sign * normal.x * normal.x * a, sign * b, -sign * normal.x},
          {b, sign + normal.y * normal.y * a, -normal.y},
          normal};
}

}  // namespace lichtmc
