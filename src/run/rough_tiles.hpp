// What some photons tell about the irradiance of tiles: how accurate direct light has to be.
#pragma once

#include <vector>

#include "lichtmc/room.hpp"
#include "lichtmc/tiles.hpp"
#include "walk/scene.hpp"

namespace lichtmc {

// An irradiance, W/m² or lx, that each tile exceeds in most cases: from some photons and their first flights, less one
// standard deviation. 0 where that is not known. The photons depend on the room alone, not on the seed of a run, so
// that all parts of a run find the same.
std::vector<double> rough_irradiance(const Room& room, const Tiling& tiling, const Scene& scene);

}  // namespace lichtmc
