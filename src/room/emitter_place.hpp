// Where an emitter is, for pictures.
#pragma once

#include <glm/vec3.hpp>

#include "lichtmc/room.hpp"

namespace lichtmc {

// Its point, or the middle of its surface by area, in m.
glm::dvec3 place_of(const Room& room, const Emitter& emitter);

}  // namespace lichtmc
