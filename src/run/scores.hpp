// From integer tallies to powers: what the counts of a run mean in W or lm.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "lichtmc/result.hpp"
#include "lichtmc/room.hpp"
#include "lichtmc/tiles.hpp"
#include "walk/tally.hpp"
#include "walk/walk.hpp"

namespace lichtmc {

// Reads the totals of a run with one estimator in one room.
class Scores {
 public:
  Scores(const Room& room, const Tiling& tiling, const ScoreLaw& law);

  // Power and irradiance of every tile, with error.
  std::vector<TileResult> tiles(const Totals& totals) const;
  std::vector<SurfaceResult> surfaces(const Totals& totals, const std::vector<TileResult>& tiles) const;
  Balance balance(const Totals& totals) const;
  // Sum over all tiles, with error.
  void incident(const Totals& totals, double& power, double& standard_error) const;

 private:
  double power_of_no_hit(std::size_t surface, std::uint64_t histories) const;
  Estimate incident_power(const Moments& moments, std::size_t surface, std::uint64_t histories) const;

  const Room* room_;
  const Tiling* tiling_;
  ScoreLaw law_;
  double power_;                // Φ, W or lm
  std::vector<double> factor_;  // per surface: impacts that a unit stands for
};

// Area-weighted rms of the tiles' relative standard errors, over the tiles that were hit; NaN where none has an error.
double rms_relative_error(const Tiling& tiling, const std::vector<TileResult>& tiles);

}  // namespace lichtmc
