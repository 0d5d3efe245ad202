// Colours as light.
#pragma once

#include <glm/vec3.hpp>

#include "lichtmc/picture.hpp"

namespace lichtmc {

// What a colour of a picture sends out, linear, 0 … 1 each.
glm::vec3 light_of(const Colour& colour);

}  // namespace lichtmc
