// The error of a run in one number: for the stop rule, the choice of the estimator, the study, the report.
//
// It is the rms of relative standard errors. A dark place has a large relative error and little importance: errors are
// relative to the irradiance there or to the error floor, whichever is greater. The floor is a share of the mean
// irradiance, or a given irradiance, see Settings::error_floor_share.
#pragma once

#include <cstddef>
#include <vector>

#include "lichtmc/result.hpp"
#include "lichtmc/room.hpp"
#include "lichtmc/settings.hpp"
#include "lichtmc/tiles.hpp"
#include "walk/unreached.hpp"

namespace lichtmc {

struct RunError {
  double relative = 0.0;       // rms, with the floor; NaN if it is not known
  double without_floor = 0.0;  // rms over the irradiances above 0
  double floor = 0.0;          // W/m² or lx
};

// The error floor for figures with this mean irradiance, W/m² or lx.
inline double error_floor(const Settings& settings, double mean) {
  return settings.error_floor.value_or(settings.error_floor_share * mean);
}

// What the errors of tiles are relative to.
struct ErrorReference {
  const std::vector<bool>& counted;             // of each tile
  const std::vector<double>& irradiance;        // of each tile, W/m² or lx
  double floor = 0.0;                           // W/m² or lx
  const std::vector<double>& powers_of_no_hit;  // of each tile map, see Scores; empty: no tile is without hits
};

// The rms of the tiles' relative errors, weighted by area. The tiles of a tile map that were never hit count as one
// tile of their joint area with the error of no hit: each for itself, the smallest would have the largest errors. With
// a floor of 0 they are left out.
double rms_relative_error(const Tiling& tiling, const std::vector<TileResult>& tiles, const ErrorReference& reference);

// The error of the tiles of one run.
class TileErrorMeasure {
 public:
  // Counts the tiles of measured surfaces that light can reach. The tiling must outlive this.
  TileErrorMeasure(const Room& room, const Tiling& tiling, const UnreachedSides& unreached, const Settings& settings);

  RunError of(const std::vector<TileResult>& tiles, const std::vector<double>& powers_of_no_hit) const;
  // The error floor if these are the irradiances of the tiles.
  double floor(const std::vector<double>& irradiances) const;
  bool counts(std::size_t tile) const { return counted_[tile]; }

 private:
  const Tiling* tiling_;
  Settings settings_;
  std::vector<bool> measured_;  // of each tile
  std::vector<bool> counted_;   // those of them that light can reach
};

}  // namespace lichtmc
