#include "walk/few_tiles.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "base/lanes.hpp"

namespace lichtmc {

namespace {

// Squares of scores below 2²⁴, of 2¹⁵ batches, add up to less than 2⁶³.
constexpr std::uint64_t small_score = std::uint64_t{1} << 24;
constexpr std::uint32_t most_folded = std::uint32_t{1} << 15;

LICHTMC_LANES std::uint64_t sum_of(std::size_t n, const std::uint64_t* LICHTMC_APART scores) {
  std::uint64_t sum = 0;
  for (std::size_t k = 0; k < n; ++k) sum += scores[k];
  return sum;
}

// Adds scores below 2³² to the sums and their squares to the sums of squares, then sets them to 0.
LICHTMC_LANES void fold_lanes(std::size_t n, std::uint64_t* LICHTMC_APART scores, std::uint64_t* LICHTMC_APART sums,
                              std::uint64_t* LICHTMC_APART squares) {
  for (std::size_t k = 0; k < n; ++k) {
    const std::uint64_t score = scores[k] & 0xFFFFFFFFU;
    sums[k] += score;
    squares[k] += score * score;
    scores[k] = 0;
  }
}

}  // namespace

FewTiles::FewTiles(std::vector<std::uint32_t> first_tile, Hits hits)
    : first_tile_(std::move(first_tile)),
      scores_(first_tile_.back()),
      hits_(hits == Hits::apart ? first_tile_.back() : 0),
      tile_map_scores_(first_tile_.size() - 1),
      sums_(first_tile_.back()),
      squares_(first_tile_.back()) {}

const std::vector<std::uint64_t>& FewTiles::close_batch(std::uint32_t n, Totals& totals) {
  for (std::size_t tile_map = 0; tile_map < tile_map_scores_.size(); ++tile_map) {
    const std::uint32_t first = first_tile_[tile_map];
    const std::uint32_t last = first_tile_[tile_map + 1];
    tile_map_scores_[tile_map] = sum_of(last - first, &scores_[first]);
    if (tile_map_scores_[tile_map] == 0) continue;
    if (n == batch_histories && tile_map_scores_[tile_map] < small_score) {
      fold_lanes(last - first, &scores_[first], &sums_[first], &squares_[first]);
      continue;
    }
    for (std::uint32_t tile = first; tile < last; ++tile) totals.tiles[tile].add(std::exchange(scores_[tile], 0), n);
  }
  if (++folded_ == most_folded) {
    add_to(totals);
    std::fill(sums_.begin(), sums_.end(), 0);
    std::fill(squares_.begin(), squares_.end(), 0);
    std::fill(hits_.begin(), hits_.end(), 0);
    folded_ = 0;
  }
  return tile_map_scores_;
}

void FewTiles::add_to(Totals& totals) const {
  for (std::size_t tile = 0; tile < scores_.size(); ++tile) totals.tiles[tile].add_sums(sums_[tile], squares_[tile]);
  for (std::size_t tile = 0; tile < hits_.size(); ++tile) totals.hits[tile] += hits_[tile];
}

}  // namespace lichtmc
