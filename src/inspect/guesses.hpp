// Guesses from a room's shape: in which unit it is, and which axis points up.
#pragma once

#include <optional>

#include <glm/vec3.hpp>

#include "lichtmc/room.hpp"

namespace lichtmc {

// A unit of length that files are written in.
struct LengthUnit {
  const char* name = "";  // "centimetres"
  double metres = 1.0;
};

// The unit that makes a room of this size (its height along Y) most like rooms that people build: none where metres do.
// `size`: the bounds' edges, in the file's unit.
std::optional<LengthUnit> guess_unit(const glm::dvec3& size);

// Whether a room rather stands on its Z axis than on Y: floors and ceilings are most of what lies flat, and rooms are
// lower than they are long.
bool looks_z_up(const Room& room, const glm::dvec3& size);

}  // namespace lichtmc
