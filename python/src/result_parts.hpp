// Parts of results as Python sees them: each is a reference into a result, which it keeps alive.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "lichtmc/area.hpp"
#include "lichtmc/result.hpp"
#include "lichtmc/room.hpp"
#include "lichtmc/tiles.hpp"
#include "lichtmc/units.hpp"
#include "run_result.hpp"

namespace lichtmc::python {

// The first tile of a map; the others are next to it. no_tile: it has none.
inline std::uint32_t first_tile(const TileMap& map) {
  const std::vector<std::uint32_t>& cells = map.tile_of_cell;
  const auto first = std::find_if(cells.begin(), cells.end(), [](std::uint32_t tile) { return tile != no_tile; });
  return first == cells.end() ? no_tile : *first;
}

// The tile maps of a result, and one of them.
struct Surfaces {
  RunResultPtr run;
};
struct OneSurface {
  RunResultPtr run;
  std::size_t map = 0;

  const SurfaceResult& figures() const { return run->result.surfaces[map]; }
  const TileMap& grid() const { return run->result.tiling.maps[map]; }
};

// Receivers and areas with their figures, of a run or of a scene with dimmed emitters.
struct Measurements {
  std::shared_ptr<const void> owner;  // of all that follows
  Quantity quantity = Quantity::photometric;
  const std::vector<Receiver>* receivers = nullptr;
  const std::vector<ReceiverResult>* results = nullptr;  // of each receiver; empty if they were not measured
  const std::vector<AreaResult>* areas = nullptr;
};

inline Measurements measurements_of(const RunResultPtr& run) {
  const Result& result = run->result;
  return {run, result.quantity, &result.receivers, &result.receiver_results, &result.areas};
}

struct ReceiverResults {
  Measurements of;
};
struct OneReceiver {
  Measurements of;
  std::size_t index = 0;

  const Receiver& receiver() const { return (*of.receivers)[index]; }
  const ReceiverResult& figures() const { return (*of.results)[index]; }
};

struct AreaResults {
  Measurements of;
};
struct OneArea {
  Measurements of;
  std::size_t index = 0;

  const AreaResult& figures() const { return (*of.areas)[index]; }
  const Area& area() const { return figures().area; }
};

}  // namespace lichtmc::python
