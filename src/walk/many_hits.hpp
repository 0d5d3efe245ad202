// The hits of a batch in rooms with many tiles, if hits are the score.
//
// Each impact accesses another address in memory, once: a tile takes four bytes, so that as many tiles as possible fit
// into the cache, and closing a batch accesses none. A tile's hits are kept with the number of their batch until
// another batch hits the tile. With many tiles, most batches that hit a tile hit it once, some twice: these batches are
// counted in the same four bytes and added to the totals from time to time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/large_pages.hpp"
#include "chance/moments.hpp"
#include "walk/totals.hpp"

namespace lichtmc {

class ManyHits {
 public:
  ManyHits(std::size_t tiles, std::size_t tile_maps);

  // A hit for each of n impacts.
  void score_each(const std::uint32_t* tiles, const std::uint32_t* tile_maps, std::size_t n, Totals& totals) {
    constexpr std::size_t ahead = 8;  // measured; 16 and 32 are 1 to 4 % slower
    for (std::size_t i = 0; i < n; ++i) {
      __builtin_prefetch(&tiles_[tiles[i + ahead < n ? i + ahead : n - 1]], 1);
      std::uint32_t& tile = tiles_[tiles[i]];
      const std::uint32_t at = tile;
      if ((at & batch_mask) == batch_) {
        hit_again(tiles[i]);
        continue;
      }
      const std::uint32_t next = (at & counted_mask) + (batch_ + once + first_hit);
      tile = next;
      if (((at & several) | (next & full)) != 0) [[unlikely]] {
        settle(at, tiles[i], batch_histories, totals);
        tile = batch_ + once + first_hit;
      }
    }
    score_tile_maps(tile_maps, n);
  }

  // Ends a batch of n histories; returns the scores of the tile maps.
  const std::vector<std::uint64_t>& close_batch(std::uint32_t n, Totals& totals);

  // Adds the hits that are not yet in the totals.
  void add_to(Totals& totals) const;

 private:
  // A tile's four bytes. From the lowest bit: 6 bits for its hits in the last batch that hit it, if any, plus 5, so
  // that a bit of `several` is set from the third hit on; 12 bits for the number of this batch, from 1; 8 bits for the
  // number of full batches with one hit that are not yet in the totals, this batch included, and 6 for those with two.
  // The highest bits of these numbers show that they are full.
  static constexpr std::uint32_t first_hit = 6;
  static constexpr std::uint32_t no_hit = first_hit - 1;
  static constexpr std::uint32_t hits_mask = 0x3F;
  static constexpr std::uint32_t several = 0x38;
  static constexpr std::uint32_t batch_unit = 0x40;
  static constexpr std::uint32_t batch_mask = 0x3'FFC0;
  static constexpr std::uint32_t once = 0x4'0000;
  static constexpr std::uint32_t once_mask = 0x3FC'0000;
  static constexpr std::uint32_t twice = 0x400'0000;
  static constexpr std::uint32_t counted_mask = ~(hits_mask | batch_mask);
  static constexpr std::uint32_t full = 0x200'0000U | 0x8000'0000U;

  // Hits in the last batch, without those that are carried.
  static std::uint32_t hits_of(std::uint32_t at) { return (at & hits_mask) == 0 ? 0 : (at & hits_mask) - no_hit; }

  // A further hit in this batch: it does not have one hit any more, or two.
  void hit_again(std::uint32_t tile) {
    std::uint32_t& at = tiles_[tile];
    const std::uint32_t hits = at & hits_mask;
    if (hits == first_hit) at += twice - once;
    if (hits == first_hit + 1) at -= twice;
    if ((++at & hits_mask) == hits_mask) carry(tile);
  }

  // Hits of one batch that its tile's bits do not hold.
  struct Carried {
    std::uint32_t tile = 0;
    std::uint64_t hits = 0;
  };
  void carry(std::uint32_t tile);
  std::uint64_t carried(std::uint32_t tile) const;

  // Adds to the totals of a tile what its four bytes hold. Its last batch has n histories.
  void add(std::uint32_t at, std::uint32_t tile, std::uint32_t n, Totals& totals) const;
  // The same, and forgets the hits that are carried.
  void settle(std::uint32_t at, std::uint32_t tile, std::uint32_t n, Totals& totals);
  void settle_all(std::uint32_t n, Totals& totals);

  void score_tile_maps(const std::uint32_t* tile_maps, std::size_t n);

  std::uint32_t batch_ = batch_unit;  // number of the batch being simulated, in its place
  std::vector<std::uint32_t, LargePages<std::uint32_t>> tiles_;
  std::vector<Carried> carried_;
  std::vector<std::uint64_t> tile_map_scores_;
  std::vector<std::uint64_t> closed_;
};

}  // namespace lichtmc
