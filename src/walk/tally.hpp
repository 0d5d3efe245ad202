// The tally of one thread.
//
// The scores of a batch are first summed per tile, then added to the moments as one batch.
#pragma once

#include <cstddef>
#include <cstdint>
#include <variant>
#include <vector>

#include "walk/few_tiles.hpp"
#include "walk/many_hits.hpp"
#include "walk/many_scores.hpp"
#include "walk/totals.hpp"

namespace lichtmc {

class Tally {
 public:
  using TileScores = std::variant<FewTiles, ManyHits, ManyScores>;

  // The tiles of tile map k are first_tile[k] … first_tile[k + 1] − 1: one element more than there are tile maps.
  Tally(const std::vector<std::uint32_t>& first_tile, Hits hits, Absorption absorption = Absorption::by_reflectance);

  // Prefetches tiles that will score soon.
  void expect(const std::uint32_t* tiles, std::size_t n) const {
    if (const auto* scores = std::get_if<ManyScores>(&batch_)) scores->expect(tiles, n, totals_);
  }

  // One unit for each of n impacts on tiles of tile maps, if hits are the score.
  void score_each(const std::uint32_t* tiles, const std::uint32_t* tile_maps, std::size_t n) {
    if (auto* few = std::get_if<FewTiles>(&batch_)) {
      few->score_each(tiles, n);
    } else {
      std::get<ManyHits>(batch_).score_each(tiles, tile_maps, n, totals_);
    }
  }
  // units[i] (> 0) for impact i, if hits are counted separately.
  void score_each(const std::uint32_t* tiles, const std::uint32_t* tile_maps, const std::uint32_t* units,
                  std::size_t n) {
    for (std::size_t i = 0; i < n; ++i) score(tiles[i], tile_maps[i], units[i]);
  }
  void score(std::uint32_t tile, std::uint32_t tile_map, std::uint64_t units) {
    if (auto* few = std::get_if<FewTiles>(&batch_)) {
      few->score(tile, units);
    } else {
      std::get<ManyScores>(batch_).score(tile, tile_map, units, totals_);
    }
  }
  void score_behind(std::uint32_t tile_map, std::uint64_t units) { totals_.behind[tile_map] += units; }
  // units (≥ 0) absorbed by the surface of a tile map, if absorption is counted.
  void absorb(std::uint32_t tile_map, int128 units) { totals_.absorbed_by[tile_map] += static_cast<uint128>(units); }

  // Ends a batch of n histories (1 … batch_histories).
  void close_batch(std::uint32_t n);

  Counts& counts() { return totals_; }
  const Counts& counts() const { return totals_; }

  // Adds all closed batches.
  void add_to(Totals& sum) const;

 private:
  TileScores batch_;
  Totals totals_;
};

}  // namespace lichtmc
