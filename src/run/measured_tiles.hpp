// The results of a walk for the tiles, forward or backward.
#pragma once

#include <cstdint>
#include <vector>

#include "lichtmc/result.hpp"

namespace lichtmc {

struct TileMeasurement {
  WalkReport report;
  std::vector<TileResult> tiles;
  std::vector<SurfaceResult> surfaces;
  Balance balance;
  double incident = 0.0;  // incident flux of all tiles, W or lm
  double incident_standard_error = 0.0;
  std::uint64_t lost_histories = 0;
};

}  // namespace lichtmc
