// Reflectance maps as images.
#pragma once

#include <string>

#include "lichtmc/room.hpp"

namespace lichtmc {

// The map as a grey PNG file with 8 bits per pixel, in sRGB like base colour textures: ρ is rounded to one of 256
// steps.
std::string png_of(const ReflectanceMap& map);

}  // namespace lichtmc
