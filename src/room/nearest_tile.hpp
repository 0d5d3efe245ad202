// A tile for every cell.
#pragma once

#include <cstdint>
#include <vector>

#include "lichtmc/tiles.hpp"

namespace lichtmc {

// TileMap::tile_of_cell, where every empty cell gets the tile of the nearest cell that has one (counted in steps along
// columns and rows; among equals always the same): a hit that rounding moves outside its tile still counts. A tile map
// without any tile stays no_tile everywhere.
std::vector<std::uint32_t> nearest_tiles(const TileMap& tile_map);

}  // namespace lichtmc
