// A reflectance map as a picture.
#pragma once

#include <string>

#include "lichtmc/room.hpp"

namespace lichtmc {

// The map as a grey PNG of 8 bits a pixel, in sRGB as base colour textures are: ρ is rounded to one of 256 steps.
std::string png_of(const ReflectanceMap& map);

}  // namespace lichtmc
