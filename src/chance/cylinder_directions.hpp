// Directions with the density of the light that small cylinders and half cylinders weigh.
//
// ε is the angle to the axis, α the angle about it, from the direction that a half cylinder faces. The densities are
// sin ε/π² and sin ε (1 + cos α)/π², 1/sr.
#pragma once

#include <glm/vec3.hpp>

namespace lichtmc {

struct CylinderDirection {
  glm::dvec3 direction{0.0};  // length 1; x towards the direction faced, z along the axis
  double weight = 0.0;        // π times its density; above 0
};

// u and v, in (0, 1), choose ε and α: equal parts of the unit square have equal shares of the directions.
CylinderDirection cylinder_direction(double u, double v);
CylinderDirection half_cylinder_direction(double u, double v);

// The solution x of x − sin x = m, for m from 0 to 2π.
double cycloid_angle(double m);

}  // namespace lichtmc
