// The position of an emitter, for pictures.
#pragma once

#include <glm/vec3.hpp>

#include "lichtmc/room.hpp"

namespace lichtmc {

// The position of a point emitter, or the area-weighted centroid of an emitting surface, in m.
glm::dvec3 place_of(const Room& room, const Emitter& emitter);

}  // namespace lichtmc
