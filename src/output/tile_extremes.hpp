// The lowest and the highest irradiance on each surface, as far as tiles tell.
#pragma once

#include <vector>

#include "lichtmc/result.hpp"

namespace lichtmc {

// W/m² or lx. Of tiles with few hits the values alone mean nothing: one hit on a narrow tile at a border would be the
// maximum of its surface, a tile without a hit the minimum. Extremes are those of tiles whose error is at most 20 %. If
// other tiles are certainly lower, or higher, by two standard errors, the extreme is their limit.
struct TileExtremes {
  double minimum = 0.0;
  double maximum = 0.0;
  bool below = false;  // the minimum is less than that
  bool above = false;  // the maximum is greater than that
};

// Of each tile map, without tiles that no light can reach.
std::vector<TileExtremes> tile_extremes(const Result& result);

}  // namespace lichtmc
