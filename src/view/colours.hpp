// Conversion of colours to linear values.
#pragma once

#include <glm/vec3.hpp>

#include "lichtmc/picture.hpp"

namespace lichtmc {

// Linear red, green and blue of an sRGB colour, 0 … 1 each.
glm::vec3 light_of(const Colour& colour);

}  // namespace lichtmc
