// The scores of a batch in rooms with few tiles: closing the batch visits all tiles.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "walk/totals.hpp"

namespace lichtmc {

class FewTiles {
 public:
  // The tiles of tile map k are first_tile[k] … first_tile[k + 1] − 1: one element more than there are tile maps.
  FewTiles(std::vector<std::uint32_t> first_tile, Hits hits);

  void score(std::uint32_t tile, std::uint64_t units) {
    scores_[tile] += units;
    if (!hits_.empty()) ++hits_[tile];
  }
  // One unit for each of n impacts.
  void score_each(const std::uint32_t* tiles, std::size_t n) {
    std::uint64_t* scores = scores_.data();
    for (std::size_t i = 0; i < n; ++i) ++scores[tiles[i]];
  }

  // Ends a batch of n histories; returns the scores of the tile maps.
  const std::vector<std::uint64_t>& close_batch(std::uint32_t n, Totals& totals);

  // Adds the scores and hits that are not yet in the totals.
  void add_to(Totals& totals) const;

 private:
  std::vector<std::uint32_t> first_tile_;
  std::vector<std::uint64_t> scores_;
  std::vector<std::uint64_t> hits_;  // empty if hits are the score
  std::vector<std::uint64_t> tile_map_scores_;
  // Sums over full batches with small scores; 64 bits suffice for most_folded batches.
  std::vector<std::uint64_t> sums_;
  std::vector<std::uint64_t> squares_;
  std::uint32_t folded_ = 0;  // batches in sums_ and squares_
};

}  // namespace lichtmc
