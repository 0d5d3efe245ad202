#include "walk/tally.hpp"

#include <cassert>

namespace lichtmc {

void Ends::add(const Ends& other) {
  absorbed += other.absorbed;
  escaped += other.escaped;
  residual += other.residual;
  lost += other.lost;
  lost_histories += other.lost_histories;
}

void Counts::add(const Counts& other) {
  histories += other.histories;
  impacts += other.impacts;
  traced.add(other.traced);
  ends.add(other.ends);
  incident.add(other.incident);
}

Totals::Totals(std::size_t tile_count, std::size_t map_count, Hits hits_are)
    : tiles(tile_count), hits(hits_are == Hits::apart ? tile_count : 0), maps(map_count), behind(map_count) {}

void Totals::add(const Totals& other) {
  assert(tiles.size() == other.tiles.size() && maps.size() == other.maps.size());
  Counts::add(other);
  for (std::size_t i = 0; i < tiles.size(); ++i) tiles[i].add(other.tiles[i]);
  for (std::size_t i = 0; i < hits.size(); ++i) hits[i] += other.hits[i];
  for (std::size_t i = 0; i < maps.size(); ++i) maps[i].add(other.maps[i]);
  for (std::size_t i = 0; i < behind.size(); ++i) behind[i] += other.behind[i];
}

Tally::Tally(std::size_t tiles, std::size_t maps, Hits hits)
    : hits_(hits),
      sweeps_(tiles <= batch_histories),
      most_counted_(hits == Hits::are_the_score ? 1 : 0),
      tiles_(tiles),
      batch_maps_(maps * map_slots),
      totals_(tiles, maps, hits) {}

void Tally::close_batch(std::uint32_t n) {
  assert(n >= 1 && n <= batch_histories);
  // Scores wait for the next batch only if theirs was full.
  constexpr std::uint32_t last_number = 0xFFFFFFFFU;
  if (sweeps_ || n < batch_histories || batch_ == last_number) {
    settle_all(n);
  } else {
    ++batch_;
  }
  std::uint64_t all = 0;
  for (std::size_t map = 0; map < totals_.maps.size(); ++map) {
    std::uint64_t score = 0;
    for (std::size_t slot = 0; slot < map_slots; ++slot) {
      score += batch_maps_[map * map_slots + slot];
      batch_maps_[map * map_slots + slot] = 0;
    }
    if (score == 0) continue;
    totals_.maps[map].add(score, n);
    all += score;
  }
  totals_.incident.add(all, n);
  totals_.histories += n;
}

// The score of a batch of n histories goes to the totals.
void Tally::settle(std::uint32_t tile, std::uint32_t n) {
  totals_.tiles[tile].add(tiles_[tile].score, n);
  tiles_[tile].score = 0;
}

// The batch has n histories, those before it are full.
void Tally::settle_all(std::uint32_t n) {
  for (std::uint32_t tile = 0; tile < tiles_.size(); ++tile) {
    if (tiles_[tile].score != 0) settle(tile, sweeps_ || tiles_[tile].batch == batch_ ? n : batch_histories);
    tiles_[tile].batch = 0;
    if (hits_ == Hits::apart) continue;
    totals_.tiles[tile].add_singles(tiles_[tile].count);
    tiles_[tile].count = 0;
  }
  batch_ = 1;
}

void Tally::add_to(Totals& sum) const {
  sum.add(totals_);
  for (std::size_t k = 0; k < tiles_.size(); ++k) {
    const BatchTile& tile = tiles_[k];
    if (tile.score != 0) sum.tiles[k].add(tile.score, batch_histories);
    if (hits_ == Hits::apart) {
      sum.hits[k] += tile.count;
    } else {
      sum.tiles[k].add_singles(tile.count);
    }
  }
}

}  // namespace lichtmc
