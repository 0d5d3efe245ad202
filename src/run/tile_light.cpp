#include "run/tile_light.hpp"

#include <algorithm>
#include <cmath>

#include "run/backward_work.hpp"

namespace lichtmc {

namespace {

// Relative accuracy of integrated direct light: 3·10⁻³, or a third of the target error, so that it adds little to the
// error of the walks; at least 10⁻⁴, because a higher accuracy costs too many rays.
double accuracy_for(const Settings& settings) {
  constexpr double coarsest = 3e-3;
  constexpr double finest = 1e-4;
  return settings.target_error ? std::clamp(*settings.target_error / 3.0, finest, coarsest) : coarsest;
}

// The emitters' power over the area of all surfaces.
double level_of(const Room& room) {
  double area = 0.0;
  for (const Surface& surface : room.surfaces) area += surface_area(surface);
  return total_power(room) / area;
}

}  // namespace

TileLight::TileLight(const Room& room, const Tiling& tiling, const Scene& scene, const Settings& settings,
                     WalkDirection direction)
    : tiles_(tiling.tiles.size()),
      light_(room, *scene.tracer),
      faces_(room, tiling, *scene.tracer),
      direct_(light_, faces_, *scene.tracer, Stream(settings.seed, direction), accuracy_for(settings), level_of(room)) {
  if (direction == WalkDirection::backward) light_.learn_selection(scene);
}

std::vector<TileDirect> TileLight::of_tiles(const Control& control, unsigned threads, StopWatch& watch,
                                            TraceCount& count) const {
  const std::vector<DirectIrradiance> found = direct_light_of(
      faces_.size(), [this](std::size_t face, TraceCount& traced) { return mean(face, traced); }, control, threads,
      watch, count);
  std::vector<TileDirect> tiles(tiles_);
  for (std::size_t face = 0; face < faces_.size(); ++face) {
    TileDirect& tile = tiles[faces_[face].tile];
    (faces_[face].behind ? tile.behind : tile.front) += found[face].value;
    tile.standard_error = std::hypot(tile.standard_error, found[face].standard_error);
  }
  return tiles;
}

}  // namespace lichtmc
