// The hits of a batch in rooms with many tiles, if hits are the score.
//
// Each impact accesses another address in memory: a tile takes four bytes, so that as many tiles as possible fit into
// the cache. With many tiles, most batches that hit a tile hit it once, some twice: these batches are counted and added
// to the totals from time to time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "walk/totals.hpp"

namespace lichtmc {

class ManyHits {
 public:
  ManyHits(std::size_t tiles, std::size_t tile_maps);

  // A hit for each of n impacts.
  void score_each(const std::uint32_t* tiles, const std::uint32_t* tile_maps, std::size_t n) {
    std::uint32_t* touched = touched_.data();
    std::size_t count = touched_count_;
    for (std::size_t i = 0; i < n; ++i) {
      std::uint32_t& at = tiles_[tiles[i]];
      // Without a branch: the element is kept only if the tile is new in this batch.
      touched[count] = tiles[i];
      count += (at & most_hits) == 0 ? std::size_t{1} : std::size_t{0};
      if ((++at & most_hits) == most_hits) carry(tiles[i]);
    }
    touched_count_ = count;
    score_tile_maps(tile_maps, n);
  }

  // Ends a batch of n histories; returns the scores of the tile maps.
  const std::vector<std::uint64_t>& close_batch(std::uint32_t n, Totals& totals);

  // Adds the hits that are not yet in the totals.
  void add_to(Totals& totals) const;

 private:
  // A tile's four bytes: two for its hits in the batch, one each for full batches with one hit and with two that are
  // not yet in the totals.
  static constexpr std::uint32_t most_hits = 0xFFFFU;
  static constexpr std::uint32_t once = 0x1'0000U;
  static constexpr std::uint32_t most_once = 0xFF'0000U;
  static constexpr std::uint32_t twice = 0x100'0000U;
  static constexpr std::uint32_t most_twice = 0xFF00'0000U;

  // Hits of one batch that exceed two bytes; one hit remains in the tile's own bytes.
  struct Carried {
    std::uint32_t tile = 0;
    std::uint64_t hits = 0;
  };
  void carry(std::uint32_t tile);
  std::uint64_t take_carried(std::uint32_t tile);
  void settle(std::uint32_t tile, std::uint64_t hits, std::uint32_t n, Totals& totals);
  void add_counted(std::uint32_t tile, Totals& totals) const;

  void score_tile_maps(const std::uint32_t* tile_maps, std::size_t n);

  std::vector<std::uint32_t> tiles_;
  std::vector<std::uint32_t> touched_;  // tiles that the batch has hit; one element more than there are tiles
  std::size_t touched_count_ = 0;
  std::vector<Carried> carried_;
  std::vector<std::uint64_t> tile_map_scores_;
  std::vector<std::uint64_t> closed_;
};

}  // namespace lichtmc
