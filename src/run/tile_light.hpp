// The direct light of a room's tiles, integrated.
#pragma once

#include <vector>

#include "chance/stream.hpp"
#include "lichtmc/room.hpp"
#include "lichtmc/settings.hpp"
#include "lichtmc/simulate.hpp"
#include "lichtmc/tiles.hpp"
#include "run/stop_watch.hpp"
#include "walk/direct_light.hpp"
#include "walk/direct_tiles.hpp"
#include "walk/scene.hpp"
#include "walk/tile_faces.hpp"

namespace lichtmc {

// Direct irradiance of a tile, W/m² or lx.
struct TileDirect {
  double front = 0.0;
  double behind = 0.0;          // on the back of the surface
  double standard_error = 0.0;  // of their sum
};

class TileLight {
 public:
  // All references except the settings must outlive this.
  TileLight(const Room& room, const Tiling& tiling, const Scene& scene, const Settings& settings,
            WalkDirection direction);
  TileLight(const TileLight&) = delete;
  TileLight& operator=(const TileLight&) = delete;

  const DirectLight& direct_light() const { return light_; }
  const TileFaces& faces() const { return faces_; }

  // The mean direct irradiance of a face.
  DirectIrradiance mean(std::size_t face, TraceCount& count) const { return direct_.mean(face, count); }

  // That of every tile, by all threads. Throws RuntimeError if the watch requests a stop before
  // all are computed.
  std::vector<TileDirect> of_tiles(const Control& control, unsigned threads, StopWatch& watch, TraceCount& count) const;

 private:
  std::size_t tiles_;
  DirectLight light_;
  TileFaces faces_;
  DirectTiles direct_;
};

}  // namespace lichtmc
