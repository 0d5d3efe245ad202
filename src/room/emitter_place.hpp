// The place, directions and photometric file of an emitter, for pictures and tables.
#pragma once

#include <optional>

#include <glm/vec3.hpp>

#include "lichtmc/luminous_opening.hpp"
#include "lichtmc/photometry.hpp"
#include "lichtmc/room.hpp"

namespace lichtmc {

// The position of a point emitter, or the area-weighted centroid of an emitting surface, in m.
glm::dvec3 place_of(const Room& room, const Emitter& emitter);

// Unit vectors of a point emitter; none where its light has no such direction, and for area lights.
struct EmitterDirections {
  std::optional<glm::dvec3> aim;
  std::optional<glm::dvec3> c0;  // of measured luminaires
};
EmitterDirections directions_of(const Emitter& emitter);

// The photometric file of a measured luminaire; null for other emitters.
const Photometry* photometry_of(const Emitter& emitter);

// The opening all over which the light of a point emitter starts; null: it starts at its position.
const LuminousOpening* opening_of(const Emitter& emitter);

}  // namespace lichtmc
