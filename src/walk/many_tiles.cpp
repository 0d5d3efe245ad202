#include "walk/many_tiles.hpp"

#include <utility>

namespace lichtmc {

ManyTiles::ManyTiles(std::size_t tiles, std::size_t maps, Hits hits)
    : hits_(hits),
      most_counted_(hits == Hits::are_the_score ? 1 : 0),
      tiles_(tiles),
      map_slots_(maps * slots),
      map_scores_(maps) {}

const std::vector<std::uint64_t>& ManyTiles::close_batch(std::uint32_t n, Totals& totals) {
  // Scores wait for the next batch only if theirs was full.
  constexpr std::uint32_t last_number = 0xFFFFFFFFU;
  if (n < batch_histories || batch_ == last_number) {
    settle_all(n, totals);
  } else {
    ++batch_;
  }
  for (std::size_t map = 0; map < map_scores_.size(); ++map) {
    map_scores_[map] = 0;
    for (std::size_t slot = 0; slot < slots; ++slot)
      map_scores_[map] += std::exchange(map_slots_[map * slots + slot], 0);
  }
  return map_scores_;
}

// The score of a batch of n histories goes to the totals.
void ManyTiles::settle(std::uint32_t tile, std::uint32_t n, Totals& totals) {
  totals.tiles[tile].add(std::exchange(tiles_[tile].score, 0), n);
}

// The batch has n histories, those before it are full.
void ManyTiles::settle_all(std::uint32_t n, Totals& totals) {
  for (std::uint32_t k = 0; k < tiles_.size(); ++k) {
    BatchTile& tile = tiles_[k];
    settle(k, tile.batch == batch_ ? n : batch_histories, totals);
    tile.batch = 0;
    if (hits_ == Hits::are_the_score) totals.tiles[k].add_singles(std::exchange(tile.count, 0));
  }
  batch_ = 1;
}

void ManyTiles::add_to(Totals& totals) const {
  for (std::size_t k = 0; k < tiles_.size(); ++k) {
    const BatchTile& tile = tiles_[k];
    totals.tiles[k].add(tile.score, batch_histories);
    if (hits_ == Hits::apart) {
      totals.hits[k] += tile.count;
    } else {
      totals.tiles[k].add_singles(tile.count);
    }
  }
}

}  // namespace lichtmc
