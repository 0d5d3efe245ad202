// Reference points: points with the normal of the plane for which irradiance is computed.
#pragma once

#include <optional>

#include <glm/vec3.hpp>

#include "lichtmc/room.hpp"
#include "tracer/tracer.hpp"

namespace lichtmc {

struct ReferencePoint {
  glm::dvec3 point{0.0};             // m
  glm::dvec3 normal{0.0, 1.0, 0.0};  // length 1
  // Cosine of the half angle of the field of view, 0 for the whole hemisphere: light at a larger angle to the normal is
  // not included.
  double least_cosine = 0.0;
  // Start of rays, in the tracer's coordinates; if not set, one step along the normal.
  std::optional<glm::dvec3> start = std::nullopt;
  // Set outside a room in which nothing casts a shadow, whose emitters are all inside or on the walls: a direction (in
  // the tracer's coordinates) in which no surface lies. Reflected light and area lights do not reach such a point.
  std::optional<glm::dvec3> way_out = std::nullopt;

  // Of a cell (Receiver::is_cell()): `point` is its middle.
  glm::dvec3 cell_u{0.0};  // m
  glm::dvec3 cell_v{0.0};

  bool is_cell() const { return cell_u != glm::dvec3(0.0) || cell_v != glm::dvec3(0.0); }
  // The reference point at a point of the cell, by s and t in [0, 1).
  ReferencePoint in_cell(double s, double t, const Tracer& tracer) const {
    const glm::dvec3 shift = (s - 0.5) * cell_u + (t - 0.5) * cell_v;
    ReferencePoint moved = *this;
    moved.point += shift;
    if (start) moved.start = *start + tracer.tracer_vector(shift);
    return moved;
  }

  // The fraction of the irradiance by a hemisphere of uniform radiance that comes from the field of view.
  double squared_sine() const { return (1.0 - least_cosine) * (1.0 + least_cosine); }
};

// A receiver as reference point. Its field of view is a cone about the normal; one with a half angle of 0° has
// irradiance 0.
ReferencePoint reference_point_of(const Receiver& receiver);

// The start of rays from a reference point, in the tracer's coordinates, off the surface that it may lie on.
glm::dvec3 start_of(const ReferencePoint& reference, const Tracer& tracer);

}  // namespace lichtmc
