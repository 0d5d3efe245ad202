#include "run/unreached_tiles.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

#include "base/message.hpp"
#include "room/triangle_shapes.hpp"

namespace lichtmc {

namespace {

// m², of each tile map. Whole patches of triangles are counted, not tiles: a tile at an edge may have parts of both.
std::vector<double> unreached_areas(const Room& room, const Tiling& tiling, const UnreachedSides& unreached) {
  std::vector<double> areas(tiling.maps.size(), 0.0);
  for (std::size_t m = 0; m < areas.size(); ++m) {
    const TileMap& map = tiling.maps[m];
    const std::vector<TriangleShape> shapes = triangle_shapes(room.surfaces[map.surface]);
    for (std::size_t n = 0; n < shapes.size(); ++n) {
      if (unreached.holds(map.surface, n, map.side)) areas[m] += shapes[n].area_m2;
    }
  }
  return areas;
}

// The mean of a smaller area.
void refer_to_rest(SurfaceResult& surface, double unreached_m2) {
  constexpr double rounding = 1e-9;  // of a sum of up to 10⁷ areas
  const double rest = surface.area_m2 - unreached_m2;
  if (!(rest > rounding * surface.area_m2)) {
    surface.unreached_area_m2 = surface.area_m2;
    return;
  }
  surface.unreached_area_m2 = unreached_m2;
  const double factor = surface.area_m2 / rest;
  surface.mean_irradiance *= factor;
  surface.standard_error *= factor;
  surface.mean_direct *= factor;
}

}  // namespace

void leave_out_unreached(const Room& room, const UnreachedSides& unreached, Result& result) {
  if (unreached.none()) return;
  const Tiling& tiling = result.tiling;
  const std::vector<double> areas = unreached_areas(room, tiling, unreached);
  for (std::size_t m = 0; m < areas.size(); ++m) {
    if (areas[m] > 0.0) refer_to_rest(result.surfaces[m], areas[m]);
  }
  result.unreached.assign(result.tiles.size(), false);
  constexpr double nothing = std::numeric_limits<double>::infinity();
  std::vector<double> lowest(result.surfaces.size(), nothing);
  for (std::size_t i = 0; i < result.tiles.size(); ++i) {
    const Tile& tile = tiling.tiles[i];
    const TileMap& map = tiling.maps[tile.map];
    const double irradiance = result.tiles[i].irradiance;
    if (unreached.holds(map.surface, tile.triangle, map.side)) {
      result.unreached[i] = true;
      ++result.unreached_tiles;
      if (!(irradiance > 0.0)) --result.tiles_without_hits;
    } else {
      lowest[tile.map] = std::min(lowest[tile.map], irradiance);
    }
  }
  for (std::size_t m = 0; m < lowest.size(); ++m) {
    if (lowest[m] < nothing) result.surfaces[m].min_irradiance = lowest[m];
  }
}

std::string unreached_text(const Result& result) {
  double area = 0.0;
  std::size_t surfaces = 0;
  for (const SurfaceResult& surface : result.surfaces) {
    area += surface.unreached_area_m2;
    surfaces += surface.unreached_area_m2 > 0.0 ? 1 : 0;
  }
  if (surfaces == 0) return {};
  return short_number(area) + " m² of " + to_text(surfaces, "surface") +
         " cannot be reached by light (outer faces, undersides) and are left out of the means and lowest values.";
}

}  // namespace lichtmc
