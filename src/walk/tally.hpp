// What one thread has counted: scores per tile and per tile map, and where the photons ended.
//
// Scores are integers: 1 for an impact of an analog photon, the weight in units of 2⁻²⁴ for a weighted one. A batch's
// scores are collected first and folded into the moments when the batch is closed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/wide.hpp"
#include "chance/moments.hpp"
#include "tracer/tracer.hpp"

namespace lichtmc {

// Units of a weight of 1. A score is rounded by at most half a unit, 3·10⁻⁸. A batch's sum stays below 2⁶⁴ for up to
// 10⁹ impacts per history.
inline constexpr double weight_units = 0x1p24;

// Whether a tile's hits are counted apart from its score.
enum class Hits {
  are_the_score,  // every hit scores 1
  apart,
};

// Where photons ended, in the units of the score. Emitted = absorbed + escaped + residual + lost, exactly.
struct Ends {
  int128 absorbed = 0;
  int128 escaped = 0;
  int128 residual = 0;  // cut off; roulette: removed less added, may be negative
  int128 lost = 0;
  std::uint64_t lost_histories = 0;

  void add(const Ends& other);
};

// Everything that the batches of a thread add up to. Adding two is exact: the order does not matter.
struct Totals {
  Totals(std::size_t tiles, std::size_t maps, Hits hits);

  std::uint64_t histories = 0;
  std::uint64_t impacts = 0;
  TraceCount traced;
  Ends ends;
  Moments incident;                 // all tiles together
  std::vector<Moments> tiles;       // per tile
  std::vector<std::uint64_t> hits;  // per tile; empty where hits are the score
  std::vector<Moments> maps;        // per tile map
  std::vector<uint128> behind;      // per tile map: score that came from behind

  void add(const Totals& other);
};

// A batch being simulated, and the totals of those that were.
class Tally {
 public:
  // map_of_tile: for every tile the index of its tile map, below `maps`.
  Tally(const std::vector<std::uint32_t>& map_of_tile, std::size_t maps, Hits hits);

  // An impact on a tile scores `units` (> 0).
  void score(std::uint32_t tile, std::uint64_t units) {
    touch(tile);
    batch_score_[tile] += units;
    if (!batch_hits_.empty()) ++batch_hits_[tile];
  }
  // One unit for each of n impacts, where hits are the score.
  void score_each(const std::uint32_t* tiles, std::size_t n) {
    std::uint64_t* scores = batch_score_.data();
    std::uint32_t* touched = touched_.data();
    std::size_t count = touched_count_;
    for (std::size_t i = 0; i < n; ++i) {
      const std::uint32_t tile = tiles[i];
      touched[count] = tile;
      count += scores[tile] == 0 ? std::size_t{1} : std::size_t{0};
      ++scores[tile];
    }
    touched_count_ = count;
  }
  void score_behind(std::uint32_t tile, std::uint64_t units) { totals_.behind[(*map_of_tile_)[tile]] += units; }

  // Ends a batch of n histories (1 … batch_histories).
  void close_batch(std::uint32_t n);

  Totals& totals() { return totals_; }
  const Totals& totals() const { return totals_; }

 private:
  // Without a branch: the place is taken only if the tile is new in this batch.
  void touch(std::uint32_t tile) {
    touched_[touched_count_] = tile;
    touched_count_ += batch_score_[tile] == 0 ? std::size_t{1} : std::size_t{0};
  }

  const std::vector<std::uint32_t>* map_of_tile_;
  std::vector<std::uint64_t> batch_score_;
  std::vector<std::uint64_t> batch_hits_;
  std::vector<std::uint64_t> batch_maps_;
  std::vector<std::uint32_t> touched_;  // tiles that the batch has scored on, one place more than there are tiles
  std::size_t touched_count_ = 0;
  Totals totals_;
};

}  // namespace lichtmc
