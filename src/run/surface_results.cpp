#include "run/surface_results.hpp"

#include <algorithm>
#include <limits>

namespace lichtmc {

std::vector<SurfaceResult> surface_results(const Room& room, const Tiling& tiling,
                                           const std::vector<TileResult>& tiles) {
  std::vector<SurfaceResult> results(tiling.maps.size());
  for (std::size_t m = 0; m < results.size(); ++m) {
    const TileMap& map = tiling.maps[m];
    const Surface& surface = room.surfaces[map.surface];
    SurfaceResult& result = results[m];
    result.name = map.name;
    result.material = surface.material;
    result.reflectance = surface.reflectance;
    result.mean_direct = 0.0;
    result.min_irradiance = std::numeric_limits<double>::infinity();
  }
  for (std::size_t i = 0; i < tiles.size(); ++i) {
    SurfaceResult& result = results[tiling.tiles[i].map];
    result.area_m2 += tiling.tiles[i].area_m2;
    result.tiles += 1;
    result.hits += tiles[i].hits;
    result.mean_direct += tiles[i].direct * tiling.tiles[i].area_m2;
    result.min_irradiance = std::min(result.min_irradiance, tiles[i].irradiance);
    result.max_irradiance = std::max(result.max_irradiance, tiles[i].irradiance);
  }
  for (SurfaceResult& result : results) {
    if (result.tiles == 0) result.min_irradiance = 0.0;
    if (result.area_m2 > 0.0) result.mean_direct /= result.area_m2;
  }
  return results;
}

}  // namespace lichtmc
