#include "walk/many_hits.hpp"

#include <algorithm>
#include <utility>

#include "base/lanes.hpp"

namespace lichtmc {

ManyHits::ManyHits(std::size_t tiles, std::size_t tile_maps)
    : tiles_(tiles), touched_(tiles + 1), tile_map_scores_(tile_maps), closed_(tile_maps) {}

const std::vector<std::uint64_t>& ManyHits::close_batch(std::uint32_t n, Totals& totals) {
  const std::uint32_t most_counted = n == batch_histories ? 2 : 0;
  for (std::size_t k = 0; k < touched_count_; ++k) {
    std::uint32_t& at = tiles_[touched_[k]];
    const std::uint32_t hits = at & most_hits;
    if (hits > most_counted) {
      settle(touched_[k], hits, n, totals);
      continue;
    }
    at += (hits == 1 ? once : twice) - hits;
    if ((at & most_once) == most_once || at >= most_twice) settle(touched_[k], 0, n, totals);
  }
  touched_count_ = 0;
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

// Adds the hits of a batch of n histories, and the batches counted before, to the totals.
void ManyHits::settle(std::uint32_t tile, std::uint64_t hits, std::uint32_t n, Totals& totals) {
  if (hits != 0) totals.tiles[tile].add(hits + take_carried(tile), n);
  add_counted(tile, totals);
  tiles_[tile] = 0;
}

void ManyHits::add_counted(std::uint32_t tile, Totals& totals) const {
  totals.tiles[tile].add_full_batches((tiles_[tile] & most_once) / once, 1);
  totals.tiles[tile].add_full_batches(tiles_[tile] / twice, 2);
}

void ManyHits::carry(std::uint32_t tile) {
  auto carried = std::find_if(carried_.begin(), carried_.end(), [tile](const Carried& c) { return c.tile == tile; });
  if (carried == carried_.end()) carried = carried_.insert(carried_.end(), {tile, 0});
  carried->hits += most_hits - 1;
  tiles_[tile] -= most_hits - 1;
}

std::uint64_t ManyHits::take_carried(std::uint32_t tile) {
  const auto carried =
      std::find_if(carried_.begin(), carried_.end(), [tile](const Carried& c) { return c.tile == tile; });
  if (carried == carried_.end()) return 0;
  const std::uint64_t hits = carried->hits;
  carried_.erase(carried);
  return hits;
}

void ManyHits::add_to(Totals& totals) const {
  for (std::uint32_t tile = 0; tile < tiles_.size(); ++tile) add_counted(tile, totals);
}

}  // namespace lichtmc
