#include "walk/many_hits.hpp"

#include <algorithm>
#include <utility>

#include "base/lanes.hpp"

namespace lichtmc {

ManyHits::ManyHits(std::size_t tiles, std::size_t tile_maps)
    : tiles_(tiles), tile_map_scores_(tile_maps), closed_(tile_maps) {}

const std::vector<std::uint64_t>& ManyHits::close_batch(std::uint32_t n, Totals& totals) {
  if (n == batch_histories && batch_ != batch_mask) {
    batch_ += batch_unit;
  } else {
    // Only hits of full batches may be added later, and no number is used twice.
    settle_all(n, totals);
    batch_ = batch_unit;
  }
  std::swap(tile_map_scores_, closed_);
  std::fill(tile_map_scores_.begin(), tile_map_scores_.end(), 0);
  return closed_;
}

namespace {

LICHTMC_LANES std::uint32_t count_of(std::uint32_t tile_map, const std::uint32_t* LICHTMC_APART tile_maps,
                                     std::size_t n) {
  std::uint32_t count = 0;
  for (std::size_t i = 0; i < n; ++i) count += tile_maps[i] == tile_map ? 1U : 0U;
  return count;
}

}  // namespace

void ManyHits::score_tile_maps(const std::uint32_t* tile_maps, std::size_t n) {
  // Counting a few tile maps one after the other in vectorised loops costs less than one increment per impact.
  constexpr std::size_t few_tile_maps = 8;
  if (tile_map_scores_.size() <= few_tile_maps) {
    for (std::uint32_t tile_map = 0; tile_map < tile_map_scores_.size(); ++tile_map)
      tile_map_scores_[tile_map] += count_of(tile_map, tile_maps, n);
  } else {
    for (std::size_t i = 0; i < n; ++i) ++tile_map_scores_[tile_maps[i]];
  }
}

void ManyHits::add(std::uint32_t at, std::uint32_t tile, std::uint32_t n, Totals& totals) const {
  Moments& sums = totals.tiles[tile];
  const std::uint32_t hits = hits_of(at);
  if (n != batch_histories) {  // its last batch was counted as full
    if (hits == 1) at -= once;
    if (hits == 2) at -= twice;
  }
  sums.add_full_batches((at & once_mask) / once, 1);
  sums.add_full_batches(at / twice, 2);
  if (hits > 2 || (n != batch_histories && hits > 0)) sums.add(hits + carried(tile), n);
}

void ManyHits::settle(std::uint32_t at, std::uint32_t tile, std::uint32_t n, Totals& totals) {
  add(at, tile, n, totals);
  if (!carried_.empty()) std::erase_if(carried_, [tile](const Carried& one) { return one.tile == tile; });
}

// Of the batch being simulated there are n histories; all others are full.
void ManyHits::settle_all(std::uint32_t n, Totals& totals) {
  for (std::uint32_t tile = 0; tile < tiles_.size(); ++tile) {
    std::uint32_t& at = tiles_[tile];
    if (at == 0) continue;
    settle(at, tile, (at & batch_mask) == batch_ ? n : batch_histories, totals);
    at = 0;
  }
}

void ManyHits::carry(std::uint32_t tile) {
  constexpr std::uint32_t left = no_hit + 3;  // as many as show that they are several
  auto carried = std::find_if(carried_.begin(), carried_.end(), [tile](const Carried& c) { return c.tile == tile; });
  if (carried == carried_.end()) carried = carried_.insert(carried_.end(), {tile, 0});
  carried->hits += hits_mask - left;
  tiles_[tile] -= hits_mask - left;
}

std::uint64_t ManyHits::carried(std::uint32_t tile) const {
  const auto found =
      std::find_if(carried_.begin(), carried_.end(), [tile](const Carried& c) { return c.tile == tile; });
  return found == carried_.end() ? 0 : found->hits;
}

void ManyHits::add_to(Totals& totals) const {
  for (std::uint32_t tile = 0; tile < tiles_.size(); ++tile) {
    if (tiles_[tile] != 0) add(tiles_[tile], tile, batch_histories, totals);
  }
}

}  // namespace lichtmc
