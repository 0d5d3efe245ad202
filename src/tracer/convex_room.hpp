// Inside and outside of a convex room: nothing casts a shadow between points inside it.
#pragma once

#include <optional>

#include <glm/vec3.hpp>

#include "lichtmc/room.hpp"
#include "tracer/tracer.hpp"

namespace lichtmc {

class ConvexRoom {
 public:
  // A room that is one closed convex shell, and its tracer, which must outlive this.
  ConvexRoom(const Room& room, const Tracer& tracer);

  // For a point outside (tracer's coordinates, not on a wall): a direction in which no ray from it meets the room, away
  // from a point within. No ray from a point inside misses the room: nothing.
  std::optional<glm::dvec3> way_out(const glm::vec3& point) const;

  // Whether all light that is emitted starts inside or on the walls: point emitters lie inside or touch a wall, and the
  // fronts of area lights are the inner sides of walls. Emitters with power 0 do not count.
  bool holds_all_emitters() const;

 private:
  bool emits_inwards(const Surface& surface) const;

  const Room* room_;
  const Tracer* tracer_;
  glm::dvec3 middle_m_{0.0};  // a point inside, m
};

}  // namespace lichtmc
