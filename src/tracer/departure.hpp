// How photons leave facets whose corners are floats.
//
// The rule:
//  1. A photon keeps a margin from the sides of its facet: after a hit within rounding of an edge it would otherwise
//     start outside the room.
//  2. It starts one step off the facet's plane, on the side that was hit: otherwise the ray would hit the facet itself
//     at distance 0.
//
// Both are some 10⁻⁶ of the room's size, below the resolution of float coordinates, and do not affect scores: tiles
// count the true hit.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include "tracer/rays.hpp"

namespace lichtmc {

// What leaving a facet requires: its corners as the tracer has them, and the two lengths of the rule. It fills one
// cache line: in large rooms every access is a cache miss.
struct alignas(64) Departure {
  glm::vec3 corner{0.0F};
  glm::vec3 edge_s{0.0F};
  glm::vec3 edge_t{0.0F};
  glm::vec3 normal{0.0F};
  glm::vec3 margin{0.0F};  // least distance from the three sides, as barycentric coordinates: of 1 − s − t, s and t
  float step = 0.0F;       // off the plane
};

// Embree determines from (corner − start)·normal on which side of a plane a ray starts. With the start rounded to float
// and three differences and products the error is below 4 roundings (2⁻²⁴ each) of the distance between start and
// corner and one of the coordinates; twice that is the step.
inline constexpr double step_roundings = 8.0 * 0x1p-24;

// A facet by its corners and its normal, of length 1; both in the tracer's coordinates.
Departure make_departure(const std::array<glm::vec3, 3>& corners, const glm::dvec3& normal);

// Enlarges the step of a facet that has others in its plane, and its margin with it: a photon must start off all of
// them. step: in the tracer's coordinates; a smaller one than before changes nothing.
void raise_step(Departure& departure, double step);

// As Tracer::depart() and Tracer::scatter(); Rays::facet is an index into `departures`.
void depart_from(const std::vector<Departure>& departures, Rays& rays);
void scatter_from(const std::vector<Departure>& departures, Rays& rays, const std::uint32_t* polar,
                  const std::uint32_t* azimuth, float* cosines);

}  // namespace lichtmc
