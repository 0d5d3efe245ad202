#include "output/tile_extremes.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "lichtmc/tiles.hpp"

namespace lichtmc {

namespace {

constexpr double resolved_error = 0.2;  // of the value: some 25 hits
constexpr double certain = 2.0;         // standard errors
constexpr double infinite = std::numeric_limits<double>::infinity();

TileExtremes extremes_of(const Result& result, const TileMap& map) {
  double lowest = infinite;  // of resolved tiles
  double highest = -infinite;
  double limit_below = infinite;  // the lowest value that is certainly not exceeded somewhere
  double limit_above = -infinite;
  for (const std::uint32_t tile : map.tile_of_cell) {
    if (tile == no_tile || (!result.unreached.empty() && result.unreached[tile])) continue;
    const TileResult& own = result.tiles[tile];
    if (!std::isfinite(own.standard_error)) continue;
    limit_below = std::min(limit_below, own.irradiance + certain * own.standard_error);
    limit_above = std::max(limit_above, own.irradiance - certain * own.standard_error);
    if (own.standard_error > resolved_error * own.irradiance) continue;
    lowest = std::min(lowest, own.irradiance);
    highest = std::max(highest, own.irradiance);
  }
  TileExtremes extremes;
  extremes.below = limit_below < lowest;
  extremes.above = limit_above > highest;
  extremes.minimum = extremes.below ? limit_below : lowest;
  extremes.maximum = extremes.above ? limit_above : highest;
  return extremes;
}

}  // namespace

std::vector<TileExtremes> tile_extremes(const Result& result) {
  std::vector<TileExtremes> all;
  all.reserve(result.tiling.maps.size());
  for (const TileMap& map : result.tiling.maps) all.push_back(extremes_of(result, map));
  return all;
}

}  // namespace lichtmc
