// Emitters closer to a surface than the coordinates resolve.
#pragma once

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace lichtmc {

// An emitter and a plane near it, in world coordinates: m.
struct NearPlane {
  glm::dvec3 emitter{0.0};
  glm::dvec3 on_plane{0.0};
  glm::dvec3 normal{0.0, 1.0, 0.0};  // length 1, to either side
  double extent = 1.0;               // of the room

  static constexpr double float_roundings = 4.0 * 0x1p-24;
  // A rounding is at most this share of the extent: the components of a normal add up to √3 at most.
  static constexpr double most_rounding = 1.75 * float_roundings;

  double distance() const { return glm::dot(normal, emitter - on_plane); }

  // Largest error of their distance if the coordinates, or the steps of a transformation to them, were floats.
  // Coordinates count with at most the extent of the room: a translation far from the origin counts as exact.
  double rounding() const {
    double sum = 0.0;
    for (int k = 0; k < 3; ++k)
      sum += std::abs(normal[k]) * std::min(extent, std::max(std::abs(emitter[k]), std::abs(on_plane[k])));
    return float_roundings * sum;
  }
};

// Whether an emitter stays on its side of a plane that is too near for the tracer, or counts as lying on it. It stays
// if the distance is more than a rounding and its beam (`axis`, of length 1, 0 for none) does not go through the plane:
// a luminaire flush with a ceiling that lies a little behind it is meant to emit into the room.
inline bool stays_before(const NearPlane& plane, const glm::dvec3& axis) {
  constexpr double along_plane = 1e-6;  // sine of the angle up to which an axis counts as parallel
  const double distance = plane.distance();
  if (!(std::abs(distance) > plane.rounding())) return false;
  return std::copysign(1.0, distance) * glm::dot(axis, plane.normal) >= -along_plane;
}

}  // namespace lichtmc
