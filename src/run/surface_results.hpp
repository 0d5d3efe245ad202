// Results of surfaces and of the whole run from those of the tiles.
#pragma once

#include <vector>

#include "lichtmc/result.hpp"
#include "lichtmc/room.hpp"
#include "lichtmc/tiles.hpp"

namespace lichtmc {

// One per tile map: names, areas, direct light, hits, smallest and largest irradiance of the tiles. The caller sets
// power, mean irradiance, their errors and the share on the back, which depend on the correlation of the tiles.
std::vector<SurfaceResult> surface_results(const Room& room, const Tiling& tiling,
                                           const std::vector<TileResult>& tiles);

}  // namespace lichtmc
