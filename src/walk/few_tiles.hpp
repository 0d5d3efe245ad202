// The scores of a batch where tiles are few: all are swept when the batch is closed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "walk/totals.hpp"

namespace lichtmc {

class FewTiles {
 public:
  // The tiles of map k are first_tile[k] … first_tile[k + 1] − 1; one number more than there are maps.
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

  // Ends a batch of n histories; returns the scores of the maps.
  const std::vector<std::uint64_t>& close_batch(std::uint32_t n, Totals& totals);

  // Adds what is not yet in the totals.
  void add_to(Totals& totals) const;

 private:
  void fold(std::size_t first, std::size_t last);

  std::vector<std::uint32_t> first_tile_;
  std::vector<std::uint64_t> scores_;
  std::vector<std::uint64_t> hits_;  // empty where hits are the score
  std::vector<std::uint64_t> map_scores_;
  // Of full batches with small scores, which 64 bits can add up for a while.
  std::vector<std::uint64_t> sums_;
  std::vector<std::uint64_t> squares_;
  std::uint32_t folded_ = 0;  // batches in them
};

}  // namespace lichtmc
