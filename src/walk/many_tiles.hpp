// The scores of a batch where tiles are many, and hardly any is hit twice in a batch.
//
// Each impact goes to one place in memory, and closing a batch to none: a tile's score stays beside the tile, with the
// number of the batch that it belongs to, and goes to the totals when another batch hits the tile.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "walk/totals.hpp"

namespace lichtmc {

class ManyTiles {
 public:
  ManyTiles(std::size_t tiles, std::size_t maps, Hits hits);

  // Tiles that will score soon are fetched from memory meanwhile.
  void expect(const std::uint32_t* tiles, std::size_t n) const {
    for (std::size_t i = 0; i < n; ++i) __builtin_prefetch(&tiles_[tiles[i]], 1);
  }

  void score(std::uint32_t tile, std::uint32_t map, std::uint64_t units, Totals& totals) {
    take(tile, units, totals);
    map_slots_[map * slots] += units;
    // 2³² hits at a time are moved to the totals.
    if (hits_ == Hits::apart && ++tiles_[tile].count == 0) totals.hits[tile] += std::uint64_t{1} << 32;
  }
  // One unit for each of n impacts, where hits are the score.
  void score_each(const std::uint32_t* tiles, const std::uint32_t* maps, std::size_t n, Totals& totals) {
    for (std::size_t i = 0; i < n; ++i) take(tiles[i], 1, totals);
    std::uint64_t* scores = map_slots_.data();
    for (std::size_t i = 0; i < n; ++i) ++scores[maps[i] * slots + i % slots];
  }

  // Ends a batch of n histories; returns the scores of the maps.
  const std::vector<std::uint64_t>& close_batch(std::uint32_t n, Totals& totals);

  // Adds what is not yet in the totals.
  void add_to(Totals& totals) const;

 private:
  struct BatchTile {
    std::uint64_t score = 0;
    std::uint32_t batch = 0;  // that hit the tile last
    std::uint32_t count = 0;  // not yet in the totals: hits, where they are counted apart; else full batches that scored
                              // 1, the commonest result
  };

  void take(std::uint32_t tile, std::uint64_t units, Totals& totals) {
    BatchTile& at = tiles_[tile];
    const bool again = at.batch == batch_;
    if (!again && at.score > most_counted_) settle(tile, batch_histories, totals);
    at.count += !again && at.score == 1 ? 1 : 0;
    at.score = again ? at.score + units : units;
    at.batch = batch_;
  }
  void settle(std::uint32_t tile, std::uint32_t n, Totals& totals);
  void settle_all(std::uint32_t n, Totals& totals);

  // Neighbours in the wave take turns: adding to a number waits for the addition before.
  static constexpr std::size_t slots = 4;

  Hits hits_;
  std::uint64_t most_counted_;  // scores up to this one are counted, not settled
  std::uint32_t batch_ = 1;     // number of the batch being simulated
  std::vector<BatchTile> tiles_;
  std::vector<std::uint64_t> map_slots_;
  std::vector<std::uint64_t> map_scores_;
};

}  // namespace lichtmc
