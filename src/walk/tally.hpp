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

// What concerns all tiles together.
struct Counts {
  std::uint64_t histories = 0;
  std::uint64_t impacts = 0;
  TraceCount traced;
  Ends ends;
  Moments incident;

  void add(const Counts& other);
};

// Everything that batches add up to. Adding two is exact: the order does not matter.
struct Totals : Counts {
  Totals(std::size_t tiles, std::size_t maps, Hits hits);

  std::vector<Moments> tiles;       // per tile
  std::vector<std::uint64_t> hits;  // per tile; empty where hits are the score
  std::vector<Moments> maps;        // per tile map
  std::vector<uint128> behind;      // per tile map: score that came from behind

  void add(const Totals& other);
};

// A batch being simulated, and the totals of those that were.
class Tally {
 public:
  Tally(std::size_t tiles, std::size_t maps, Hits hits);

  // Tiles that will score soon: where they are many, they are fetched from memory meanwhile.
  void expect(const std::uint32_t* tiles, std::size_t n) const {
    if (sweeps_) return;
    for (std::size_t i = 0; i < n; ++i) __builtin_prefetch(&tiles_[tiles[i]], 1);
  }

  // An impact on a tile of a tile map scores `units` (> 0).
  void score(std::uint32_t tile, std::uint32_t map, std::uint64_t units) {
    take(tile, units);
    batch_maps_[map * map_slots] += units;
    // 2³² hits at a time are moved to the totals.
    if (hits_ == Hits::apart && ++tiles_[tile].count == 0) totals_.hits[tile] += std::uint64_t{1} << 32;
  }
  // One unit for each of n impacts, where hits are the score.
  void score_each(const std::uint32_t* tiles, const std::uint32_t* maps, std::size_t n) {
    BatchTile* batch = tiles_.data();
    if (sweeps_) {
      for (std::size_t i = 0; i < n; ++i) ++batch[tiles[i]].score;
    } else {
      for (std::size_t i = 0; i < n; ++i) take(tiles[i], 1);
    }
    std::uint64_t* batch_maps = batch_maps_.data();
    for (std::size_t i = 0; i < n; ++i) ++batch_maps[maps[i] * map_slots + i % map_slots];
  }
  void score_behind(std::uint32_t map, std::uint64_t units) { totals_.behind[map] += units; }

  // Ends a batch of n histories (1 … batch_histories).
  void close_batch(std::uint32_t n);

  Counts& counts() { return totals_; }
  const Counts& counts() const { return totals_; }

  // Adds all batches that were closed.
  void add_to(Totals& sum) const;

 private:
  // A tile's score in the batch that hit it last. It goes to the totals when another batch hits the tile: so each impact
  // goes to one place in memory, and closing a batch to none. Few tiles are swept when a batch is closed instead.
  struct BatchTile {
    std::uint64_t score = 0;
    std::uint32_t batch = 0;  // number of that batch
    std::uint32_t count = 0;  // not yet in the totals: hits, where they are counted apart; else full batches that scored
                              // 1, the commonest result where tiles are many
  };

  void take(std::uint32_t tile, std::uint64_t units) {
    BatchTile& at = tiles_[tile];
    const bool again = sweeps_ || at.batch == batch_;
    if (!again && at.score > most_counted_) settle(tile, batch_histories);
    at.count += !again && at.score == 1 ? 1 : 0;
    at.score = again ? at.score + units : units;
    at.batch = batch_;
  }
  void settle(std::uint32_t tile, std::uint32_t n);
  void settle_all(std::uint32_t n);

  // Neighbours in the array take turns: adding to a number waits for the addition before.
  static constexpr std::size_t map_slots = 4;

  Hits hits_;
  bool sweeps_;
  std::uint64_t most_counted_;  // scores up to this one are counted, not settled
  std::uint32_t batch_ = 1;     // number of the batch being simulated
  std::vector<BatchTile> tiles_;
  std::vector<std::uint64_t> batch_maps_;
  Totals totals_;
};

}  // namespace lichtmc
