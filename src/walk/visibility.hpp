// Shadow rays, and the geometry of a flight that has hit an area light.
#pragma once

#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "tracer/rays.hpp"
#include "tracer/tracer.hpp"
#include "walk/reference_point.hpp"

namespace lichtmc {

// The segment from a start point (tracer's coordinates, one step off its surface) to a point of an emitter (m, world)
// that must be free for the light to arrive: it ends two steps before the emitter, which may lie on a surface. None if
// the emitter is closer than that.
inline std::optional<glm::vec3> shadow_segment(const Tracer& tracer, const glm::dvec3& start,
                                               const glm::dvec3& target) {
  const double short_of = 2.0 * tracer.step();
  const glm::dvec3 segment = tracer.tracer_point(target) - start;
  const double length = glm::length(segment);
  if (length <= short_of) return std::nullopt;
  return glm::vec3(segment * (1.0 - short_of / length));
}

// Whether a surface is between a reference point and a point of an emitter.
inline bool is_blocked(const Tracer& tracer, const ReferencePoint& reference, const glm::dvec3& target,
                       TraceCount& count) {
  if (!tracer.casts_shadows() && !reference.way_out) return false;
  const glm::dvec3 start = start_of(reference, tracer);
  const std::optional<glm::vec3> segment = shadow_segment(tracer, start, target);
  return segment && tracer.is_blocked(glm::vec3(start), *segment, count);
}

// Normal of a facet in the world, length 1. (Normals of the cuboid's facets are parallel to the axes, and remain so.)
inline glm::dvec3 world_normal(const Tracer& tracer, const Facet& facet) {
  return glm::normalize(tracer.world_vector(glm::dvec3(facet.normal)));
}

// Normal of the side that flight i has hit, in the world, length 1.
inline glm::dvec3 hit_normal(const Tracer& tracer, const Rays& rays, std::size_t i) {
  const glm::dvec3 normal = world_normal(tracer, tracer.facets()[rays.facet[i]]);
  return rays.behind[i] != 0 ? -normal : normal;
}

// A flight that has ended on a surface: its length and the cosine of its angle to the surface's normal.
struct FlightGeometry {
  double length_m = 0.0;
  double cosine_there = 0.0;

  bool degenerate() const { return !(length_m > 0.0) || !(cosine_there > 0.0); }
  // Density per area of the surface that was hit, for a flight by Lambert's law that left a surface at an angle of this
  // cosine.
  double pdf_bsdf(double cosine_here) const {
    return cosine_here * cosine_there / (std::numbers::pi * length_m * length_m);
  }
};

inline FlightGeometry flight_geometry(const Tracer& tracer, const Rays& rays, std::size_t i) {
  const glm::dvec3 flight = tracer.world_vector(glm::dvec3(rays.direction(i)) * double{rays.length[i]});
  const double length = glm::length(flight);
  return {length, std::abs(glm::dot(flight, world_normal(tracer, tracer.facets()[rays.facet[i]]))) / length};
}

}  // namespace lichtmc
