// Reference points: where irradiance is asked for, with the normal of the plane that it arrives on.
#pragma once

#include <glm/vec3.hpp>

#include "lichtmc/room.hpp"
#include "tracer/tracer.hpp"

namespace lichtmc {

struct ReferencePoint {
  glm::dvec3 point{0.0};             // m
  glm::dvec3 normal{0.0, 1.0, 0.0};  // length 1
  // Cosine of the half angle of the field of view, 0 for the whole hemisphere: light from directions at a larger angle
  // to the normal does not count.
  double least_cosine = 0.0;

  // The share of the irradiance by a hemisphere of uniform radiance that comes from the field of view.
  double squared_sine() const { return (1.0 - least_cosine) * (1.0 + least_cosine); }
};

// A receiver as reference point. Its field of view is a cone about the normal; one with a half angle of 0° receives
// nothing.
ReferencePoint reference_point_of(const Receiver& receiver);

// Where rays from a reference point start, in the tracer's coordinates: one step off the surface that it may lie on, on
// the side of its normal.
glm::dvec3 start_of(const ReferencePoint& reference, const Tracer& tracer);

}  // namespace lichtmc
