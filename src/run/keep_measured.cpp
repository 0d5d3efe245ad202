#include "run/keep_measured.hpp"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "room/measured_surfaces.hpp"

namespace lichtmc {

namespace {

// Moves the elements for which keep(index) is true to the front and removes the others.
template <class Element, class Keep>
void keep_elements(std::vector<Element>& elements, const Keep& keep) {
  std::size_t kept = 0;
  for (std::size_t k = 0; k < elements.size(); ++k) {
    if (!keep(k)) continue;
    if (kept != k) elements[kept] = std::move(elements[k]);
    ++kept;
  }
  elements.resize(kept);
}

}  // namespace

void keep_measured(const Room& room, Result& result) {
  if (measures_all(room)) return;
  Tiling& tiling = result.tiling;
  constexpr std::uint32_t removed = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> new_map;
  std::uint32_t maps = 0;
  for (const TileMap& map : tiling.maps) new_map.push_back(room.surfaces[map.surface].measured ? maps++ : removed);
  std::vector<std::uint32_t> new_tile;
  std::uint32_t tiles = 0;
  for (const Tile& tile : tiling.tiles) new_tile.push_back(new_map[tile.map] != removed ? tiles++ : removed);
  const auto keeps_map = [&](std::size_t m) { return new_map[m] != removed; };
  const auto keeps_tile = [&](std::size_t i) { return new_tile[i] != removed; };
  keep_elements(result.tiles, keeps_tile);
  keep_elements(result.surfaces, keeps_map);
  keep_elements(tiling.tiles, keeps_tile);
  keep_elements(tiling.maps, keeps_map);
  for (Tile& tile : tiling.tiles) tile.map = new_map[tile.map];
  for (TileMap& map : tiling.maps) {
    for (std::uint32_t& tile : map.tile_of_cell) {
      if (tile != no_tile) tile = new_tile[tile];
    }
  }
  result.incident = std::numeric_limits<double>::quiet_NaN();
  result.incident_standard_error = std::numeric_limits<double>::quiet_NaN();
}

}  // namespace lichtmc
