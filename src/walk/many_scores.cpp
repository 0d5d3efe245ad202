#include "walk/many_scores.hpp"

#include <algorithm>
#include <utility>

namespace lichtmc {

ManyScores::ManyScores(std::size_t tiles, std::size_t tile_maps)
    : tiles_(tiles), tile_map_scores_(tile_maps), closed_(tile_maps) {}

const std::vector<std::uint64_t>& ManyScores::close_batch(std::uint32_t n, Totals& totals) {
  constexpr std::uint32_t last_number = 0xFFFFFFFFU;
  if (n == batch_histories && batch_ != last_number) {
    ++batch_;
  } else {
    // Only scores of full batches may be added later, and no batch number is used twice.
    for (std::uint32_t tile = 0; tile < tiles_.size(); ++tile) {
      settle(tile, tiles_[tile].batch == batch_ ? n : batch_histories, totals);
      tiles_[tile].batch = 0;
    }
    batch_ = 1;
  }
  std::swap(tile_map_scores_, closed_);
  std::fill(tile_map_scores_.begin(), tile_map_scores_.end(), 0);
  return closed_;
}

// Adds the score of a batch of n histories to the totals.
void ManyScores::settle(std::uint32_t tile, std::uint32_t n, Totals& totals) {
  totals.tiles[tile].add(std::exchange(tiles_[tile].score, 0), n);
}

void ManyScores::add_to(Totals& totals) const {
  for (std::size_t tile = 0; tile < tiles_.size(); ++tile) {
    totals.tiles[tile].add(tiles_[tile].score, batch_histories);
    totals.hits[tile] += tiles_[tile].hits;
  }
  for (const Carried& carried : carried_) totals.hits[carried.tile] += carried.times << 32;
}

void ManyScores::carry(std::uint32_t tile) {
  auto carried = std::find_if(carried_.begin(), carried_.end(), [tile](const Carried& c) { return c.tile == tile; });
  if (carried == carried_.end()) carried = carried_.insert(carried_.end(), {tile, 0});
  ++carried->times;
}

}  // namespace lichtmc
