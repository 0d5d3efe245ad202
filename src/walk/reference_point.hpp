// Reference points: points with the normal of the plane for which irradiance is computed, or with another law by which
// a receiver weighs light (lichtmc/room.hpp, ReceiverLaw).
#pragma once

#include <algorithm>
#include <optional>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "lichtmc/room.hpp"
#include "tracer/tracer.hpp"

namespace lichtmc {

struct ReferencePoint {
  glm::dvec3 point{0.0};             // m
  glm::dvec3 normal{0.0, 1.0, 0.0};  // length 1; of a cylinder its axis
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

  ReceiverLaw law = ReceiverLaw::planar;
  glm::dvec3 facing{0.0};  // of a half cylinder, length 1, at right angles to the normal; else 0
  // Of a cylinder on surfaces, in m: it receives nothing from surfaces that it is closer to, measured at right angles
  // to them. They cover a part of its field of view, of which a planar receiver has none behind it.
  double least_height_m = 0.0;

  // w, by which the radiance from a direction (length 1) counts; 0 outside the field of view. Its integral over all
  // directions is π times squared_sine(): a Lambertian surface as first impact is reached with the density w cos θ/(π
  // squared_sine() r²) by flights with a density proportional to w.
  double weight(const glm::dvec3& towards) const {
    if (law != ReceiverLaw::planar) return weight_around(towards);
    const double cosine = glm::dot(towards, normal);
    return cosine < least_cosine ? 0.0 : std::max(cosine, 0.0);
  }

  bool is_cell() const { return cell_u != glm::dvec3(0.0) || cell_v != glm::dvec3(0.0); }
  // The reference point at a point of the cell, by s and t in [0, 1).
  ReferencePoint in_cell(double s, double t, const Tracer& tracer) const {
    const glm::dvec3 shift = (s - 0.5) * cell_u + (t - 0.5) * cell_v;
    ReferencePoint moved = *this;
    moved.point += shift;
    if (start) moved.start = *start + tracer.tracer_vector(shift);
    return moved;
  }

  // The fraction of the irradiance by a hemisphere of uniform radiance that comes from the field of view. A cylinder
  // and a half cylinder receive π times a uniform radiance of the sphere: 1.
  double squared_sine() const { return (1.0 - least_cosine) * (1.0 + least_cosine); }

 private:
  double weight_around(const glm::dvec3& towards) const;
};

// A receiver as reference point. Its field of view is a cone about the normal; one with a half angle of 0° has
// irradiance 0.
ReferencePoint reference_point_of(const Receiver& receiver);

// Whether its irradiance is that of a plane by the whole hemisphere, for which area lights have closed forms.
inline bool sees_hemisphere(const ReferencePoint& reference) {
  return reference.law == ReceiverLaw::planar && reference.least_cosine <= 0.0;
}

// A direction from a reference point with the density weight()/(π squared_sine()); u and v in (0, 1) choose it.
struct FirstFlight {
  glm::dvec3 direction{0.0};  // length 1
  double weight = 0.0;
};
FirstFlight first_flight(const ReferencePoint& reference, double u, double v);

// The same of a cylinder (facing: 0) or half cylinder.
FirstFlight first_flight_around(const glm::dvec3& axis, const glm::dvec3& facing, double u, double v);

// The start of rays from a reference point, in the tracer's coordinates, off the surface that it may lie on.
glm::dvec3 start_of(const ReferencePoint& reference, const Tracer& tracer);

}  // namespace lichtmc
