// Estimates the unit of length and the vertical axis of a room from its shape.
#pragma once

#include <optional>

#include <glm/vec3.hpp>

#include "lichtmc/room.hpp"

namespace lichtmc {

// A unit of length.
struct LengthUnit {
  const char* name = "";  // "centimetres"
  double metres = 1.0;
};

// The unit for which a room of this size (height along Y) has the most plausible height; none if metres are plausible,
// or if no unit is. `size`: edges of the bounding box, in the file's unit.
std::optional<LengthUnit> guess_unit(const glm::dvec3& size);

// Whether a room is probably Z-up: its extent along Z does not exceed that along Y, and the area perpendicular to Z
// exceeds 1.5 times the area perpendicular to Y. Floors and ceilings have the largest area, and rooms are lower than
// long.
bool looks_z_up(const Room& room, const glm::dvec3& size);

}  // namespace lichtmc
