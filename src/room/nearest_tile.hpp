// A tile for every cell.
#pragma once

#include <cstdint>
#include <vector>

#include "lichtmc/tiles.hpp"

namespace lichtmc {

// TileMap::tile_of_cell with every empty cell given the tile of the nearest cell that has one (counted in steps along
// columns and rows; among equals always the same): a hit that rounding puts beside its tile still counts. A map without
// any tile stays no_tile all over.
std::vector<std::uint32_t> nearest_tiles(const TileMap& map);

}  // namespace lichtmc
