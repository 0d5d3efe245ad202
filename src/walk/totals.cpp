#include "walk/totals.hpp"

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
  assert(other.hits.empty() || hits.size() == other.hits.size());
  Counts::add(other);
  for (std::size_t i = 0; i < tiles.size(); ++i) tiles[i].add(other.tiles[i]);
  for (std::size_t i = 0; i < other.hits.size(); ++i) hits[i] += other.hits[i];
  for (std::size_t i = 0; i < maps.size(); ++i) maps[i].add(other.maps[i]);
  for (std::size_t i = 0; i < behind.size(); ++i) behind[i] += other.behind[i];
}

}  // namespace lichtmc
