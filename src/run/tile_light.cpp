#include "run/tile_light.hpp"

#include <cmath>

#include "run/backward_work.hpp"
#include "run/direct_error.hpp"
#include "run/error_measure.hpp"
#include "run/rough_tiles.hpp"
#include "walk/backward.hpp"

namespace lichtmc {

namespace {

// The mean direct irradiance stands for the mean irradiance, of which the error floor is a share: that is not known
// before the walks, and more.
TileAccuracy accuracy_for(const Room& room, const Tiling& tiling, const Scene& scene, const Settings& settings) {
  return {direct_error_of_tiles(settings), error_floor(settings, BackwardScale(room).mean_irradiance()),
          rough_irradiance(room, tiling, scene)};
}

}  // namespace

TileLight::TileLight(const Room& room, const Tiling& tiling, const Scene& scene, const Settings& settings,
                     WalkDirection direction)
    : tiles_(tiling.tiles.size()),
      light_(room, *scene.tracer),
      faces_(room, tiling, *scene.tracer),
      direct_(light_, faces_, *scene.tracer, Stream(settings.seed, direction),
              accuracy_for(room, tiling, scene, settings)) {
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
