#include "walk/tally.hpp"

#include <cassert>

namespace lichtmc {

namespace {

std::variant<FewTiles, ManyTiles> tiles_for(const std::vector<std::uint32_t>& first_tile, Hits hits) {
  // Up to about as many as a batch has impacts, most are hit: to look at all costs less than to remember which.
  if (first_tile.back() <= batch_histories) return FewTiles(first_tile, hits);
  return ManyTiles(first_tile.back(), first_tile.size() - 1, hits);
}

}  // namespace

Tally::Tally(const std::vector<std::uint32_t>& first_tile, Hits hits)
    : batch_(tiles_for(first_tile, hits)), totals_(first_tile.back(), first_tile.size() - 1, hits) {}

void Tally::close_batch(std::uint32_t n) {
  assert(n >= 1 && n <= batch_histories);
  const std::vector<std::uint64_t>& map_scores = std::visit(
      [&](auto& tiles) -> const std::vector<std::uint64_t>& { return tiles.close_batch(n, totals_); }, batch_);
  std::uint64_t all = 0;
  for (std::size_t map = 0; map < map_scores.size(); ++map) {
    if (map_scores[map] == 0) continue;
    totals_.maps[map].add(map_scores[map], n);
    all += map_scores[map];
  }
  totals_.incident.add(all, n);
  totals_.histories += n;
}

void Tally::add_to(Totals& sum) const {
  sum.add(totals_);
  std::visit([&](const auto& tiles) { tiles.add_to(sum); }, batch_);
}

}  // namespace lichtmc
