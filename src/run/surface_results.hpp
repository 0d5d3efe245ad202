// What the tiles of a result say about their surfaces and about the run as a whole.
#pragma once

#include <vector>

#include "lichtmc/result.hpp"
#include "lichtmc/room.hpp"
#include "lichtmc/tiles.hpp"

namespace lichtmc {

// One per tile map: names, areas, direct light, hits, least and greatest irradiance of the tiles. Power, mean
// irradiance, their error and the share from behind are left to who knows how the tiles depend on each other.
std::vector<SurfaceResult> surface_results(const Room& room, const Tiling& tiling,
                                           const std::vector<TileResult>& tiles);

// Area-weighted rms of the tiles' relative standard errors, over the tiles that got light; NaN where none has an error.
double rms_relative_error(const Tiling& tiling, const std::vector<TileResult>& tiles);

}  // namespace lichtmc
