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

Totals::Totals(std::size_t tile_count, std::size_t map_count, Hits hits_are)
    : tiles(tile_count), hits(hits_are == Hits::apart ? tile_count : 0), maps(map_count), behind(map_count) {}

void Totals::add(const Totals& other) {
  assert(tiles.size() == other.tiles.size() && maps.size() == other.maps.size());
  histories += other.histories;
  impacts += other.impacts;
  traced.add(other.traced);
  ends.add(other.ends);
  incident.add(other.incident);
  for (std::size_t i = 0; i < tiles.size(); ++i) tiles[i].add(other.tiles[i]);
  for (std::size_t i = 0; i < hits.size(); ++i) hits[i] += other.hits[i];
  for (std::size_t i = 0; i < maps.size(); ++i) maps[i].add(other.maps[i]);
  for (std::size_t i = 0; i < behind.size(); ++i) behind[i] += other.behind[i];
}

Tally::Tally(const std::vector<std::uint32_t>& map_of_tile, std::size_t maps, Hits hits)
    : map_of_tile_(&map_of_tile),
      batch_score_(map_of_tile.size()),
      batch_hits_(hits == Hits::apart ? map_of_tile.size() : 0),
      batch_maps_(maps),
      touched_(map_of_tile.size() + 1),
      totals_(map_of_tile.size(), maps, hits) {}

void Tally::close_batch(std::uint32_t n) {
  assert(n >= 1 && n <= batch_histories);
  std::uint64_t all = 0;
  for (std::size_t k = 0; k < touched_count_; ++k) {
    const std::uint32_t tile = touched_[k];
    const std::uint64_t score = batch_score_[tile];
    totals_.tiles[tile].add(score, n);
    batch_maps_[(*map_of_tile_)[tile]] += score;
    batch_score_[tile] = 0;
    if (batch_hits_.empty()) continue;
    totals_.hits[tile] += batch_hits_[tile];
    batch_hits_[tile] = 0;
  }
  touched_count_ = 0;
  for (std::size_t map = 0; map < batch_maps_.size(); ++map) {
    if (batch_maps_[map] == 0) continue;
    totals_.maps[map].add(batch_maps_[map], n);
    all += batch_maps_[map];
    batch_maps_[map] = 0;
  }
  totals_.incident.add(all, n);
  totals_.histories += n;
}

}  // namespace lichtmc
