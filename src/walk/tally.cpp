#include "walk/tally.hpp"

#include <cassert>

namespace lichtmc {

namespace {

// Up to this many tiles, visiting all of them at the end of a batch costs less than recording which tiles were hit.
constexpr std::size_t few_tiles = std::size_t{4} * batch_histories;

Tally::TileScores tiles_for(const std::vector<std::uint32_t>& first_tile, Hits hits) {
  const std::size_t tiles = first_tile.back();
  const std::size_t tile_maps = first_tile.size() - 1;
  if (tiles <= few_tiles) return FewTiles(first_tile, hits);
  if (hits == Hits::are_the_score) return ManyHits(tiles, tile_maps);
  return ManyScores(tiles, tile_maps);
}

// ManyScores stores hits beside the scores.
Hits hits_in_totals(const Tally::TileScores& tiles, Hits hits) {
  return std::holds_alternative<ManyScores>(tiles) ? Hits::are_the_score : hits;
}

}  // namespace

Tally::Tally(const std::vector<std::uint32_t>& first_tile, Hits hits, Absorption absorption)
    : batch_(tiles_for(first_tile, hits)),
      totals_(first_tile.back(), first_tile.size() - 1, hits_in_totals(batch_, hits), absorption) {}

void Tally::close_batch(std::uint32_t n) {
  assert(n >= 1 && n <= batch_histories);
  const std::vector<std::uint64_t>& tile_map_scores = std::visit(
      [&](auto& tiles) -> const std::vector<std::uint64_t>& { return tiles.close_batch(n, totals_); }, batch_);
  std::uint64_t all = 0;
  for (std::size_t tile_map = 0; tile_map < tile_map_scores.size(); ++tile_map) {
    if (tile_map_scores[tile_map] == 0) continue;
    totals_.tile_maps[tile_map].add(tile_map_scores[tile_map], n);
    all += tile_map_scores[tile_map];
  }
  totals_.incident.add(all, n);
  totals_.histories += n;
}

void Tally::add_to(Totals& sum) const {
  sum.add(totals_);
  std::visit([&](const auto& tiles) { tiles.add_to(sum); }, batch_);
}

}  // namespace lichtmc
