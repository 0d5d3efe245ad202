// The scores of a batch in rooms with many tiles, if impacts score weights.
//
// Each impact accesses one address in memory, and closing a batch accesses none: a tile's score is stored with the
// number of the batch that it belongs to, and is added to the totals when another batch hits the tile. Hits are stored
// there until add_to(): the totals of a thread need no memory for them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "walk/totals.hpp"

namespace lichtmc {

class ManyScores {
 public:
  ManyScores(std::size_t tiles, std::size_t tile_maps);

  // Prefetches tiles that will score soon.
  void expect(const std::uint32_t* tiles, std::size_t n, const Totals& totals) const {
    for (std::size_t i = 0; i < n; ++i) {
      __builtin_prefetch(&tiles_[tiles[i]], 1);
      __builtin_prefetch(&totals.tiles[tiles[i]], 1);
    }
  }

  void score(std::uint32_t tile, std::uint32_t tile_map, std::uint64_t units, Totals& totals) {
    BatchTile& at = tiles_[tile];
    if (at.batch != batch_) {
      settle(tile, batch_histories, totals);
      at.batch = batch_;
    }
    at.score += units;
    tile_map_scores_[tile_map] += units;
    if (++at.hits == 0) carry(tile);
  }

  // Ends a batch of n histories; returns the scores of the tile maps.
  const std::vector<std::uint64_t>& close_batch(std::uint32_t n, Totals& totals);

  // Adds the scores that are not yet in the totals, and all hits.
  void add_to(Totals& totals) const;

 private:
  struct BatchTile {
    std::uint64_t score = 0;
    std::uint32_t batch = 0;  // the last batch that hit the tile
    std::uint32_t hits = 0;   // modulo 2³²
  };
  // Hits that exceed four bytes: times · 2³².
  struct Carried {
    std::uint32_t tile = 0;
    std::uint64_t times = 0;
  };
  void carry(std::uint32_t tile);

  void settle(std::uint32_t tile, std::uint32_t n, Totals& totals);

  std::uint32_t batch_ = 1;  // number of the batch being simulated
  std::vector<BatchTile> tiles_;
  std::vector<Carried> carried_;
  std::vector<std::uint64_t> tile_map_scores_;
  std::vector<std::uint64_t> closed_;
};

}  // namespace lichtmc
