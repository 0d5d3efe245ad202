// Texture maps as images: PNG files with 8 bits per channel, in sRGB like the textures of glTF.
#pragma once

#include <string>

#include "lichtmc/room.hpp"

namespace lichtmc {

// A map of reflectance: grey, or its colours if it has them. Each value is rounded to one of 256 steps.
std::string reflectance_png(const ReflectanceMap& map);

// A map of emission, grey: values divided by highest_value().
std::string emission_png(const EmissionMap& map);

// The highest value of a map; 1 if all are 0.
double highest_value(const TextureMap& map);

}  // namespace lichtmc
