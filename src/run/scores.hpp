// From integer tallies to powers in W or lm.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "lichtmc/result.hpp"
#include "lichtmc/room.hpp"
#include "lichtmc/tiles.hpp"
#include "run/tile_light.hpp"
#include "walk/choose_policy.hpp"
#include "walk/tally.hpp"

namespace lichtmc {

// Reads the totals of a run with one estimator in one room.
class Scores {
 public:
  // direct: of every tile if direct light was integrated, else empty.
  Scores(const Room& room, const Tiling& tiling, const ScoreLaw& law, std::vector<TileDirect> direct);

  // Incident power and irradiance of every tile, with standard errors.
  std::vector<TileResult> tiles(const Totals& totals) const;
  std::vector<SurfaceResult> surfaces(const Totals& totals, const std::vector<TileResult>& tiles) const;
  Balance balance(const Totals& totals) const;
  // Incident power of all tiles, with standard error.
  Estimate incident(const Totals& totals) const;
  // Of each tile map, W or lm: the error of the power of a tile without hits. With 1.148 expected hits the probability
  // of none is 1 − 0.6827 (Poisson): the true value is below that with the probability of one standard error.
  std::vector<double> powers_of_no_hit(std::uint64_t histories) const;

 private:
  struct DirectPower {   // integrated direct light of a tile map
    double power = 0.0;  // W or lm
    double behind = 0.0;
    double standard_error = 0.0;
  };
  Estimate counted(const Totals& totals) const;
  double power_per_unit(const Totals& totals) const;
  double power_of_no_hit(std::size_t surface, std::uint64_t histories) const;
  Estimate incident_power(const Moments& moments, std::size_t surface, std::uint64_t histories) const;

  const Room* room_;
  const Tiling* tiling_;
  ScoreLaw law_;
  std::vector<TileDirect> direct_;
  std::vector<DirectPower> direct_power_;  // per tile map
  double power_;                           // Φ, W or lm
  std::vector<double> factor_;             // per surface: impacts per unit
};

}  // namespace lichtmc
