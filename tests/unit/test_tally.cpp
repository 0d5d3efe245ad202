#include <cstdint>
#include <random>
#include <vector>

#include "support/catch.hpp"
#include "walk/tally.hpp"

using namespace lichtmc;

namespace {

struct Impact {
  std::uint32_t tile;
  std::uint32_t units;
};
struct Batch {
  std::uint32_t histories = batch_histories;
  std::vector<Impact> impacts;
};

// Tiles of three tile maps, the second twice as large as the first, and so on.
std::vector<std::uint32_t> three_maps(std::uint32_t tiles) {
  return {0, tiles / 6, tiles / 2, tiles};
}

std::uint32_t map_of(std::uint32_t tile, const std::vector<std::uint32_t>& first_tile) {
  std::uint32_t map = 0;
  while (tile >= first_tile[map + 1]) ++map;
  return map;
}

// Most hits are on the first tiles: some tiles get none, one or two in a batch, others hundreds.
std::vector<Batch> some_batches(std::uint32_t tiles, Hits hits) {
  std::mt19937 bits(17);
  std::vector<Batch> batches;
  for (int b = 0; b < 300; ++b) {
    Batch batch;
    if (b % 100 == 57) batch.histories = 3;
    for (int k = 0; k < 700; ++k) {
      const double share = static_cast<double>(bits()) * 0x1p-32;
      batch.impacts.push_back({static_cast<std::uint32_t>(share * share * share * tiles),
                               hits == Hits::apart ? static_cast<std::uint32_t>(bits() % 16'777'216 + 1) : 1U});
    }
    batches.push_back(std::move(batch));
  }
  return batches;
}

Totals tallied(const std::vector<Batch>& batches, const std::vector<std::uint32_t>& first_tile, Hits hits) {
  Tally tally(first_tile, hits);
  for (const Batch& batch : batches) {
    std::vector<std::uint32_t> tiles, maps, units;
    for (const Impact& impact : batch.impacts) {
      tiles.push_back(impact.tile);
      maps.push_back(map_of(impact.tile, first_tile));
      units.push_back(impact.units);
    }
    tally.expect(tiles.data(), tiles.size());
    if (hits == Hits::apart) {
      tally.score_each(tiles.data(), maps.data(), units.data(), tiles.size());
    } else {
      tally.score_each(tiles.data(), maps.data(), tiles.size());
    }
    tally.close_batch(batch.histories);
  }
  Totals totals(first_tile.back(), first_tile.size() - 1, hits);
  tally.add_to(totals);
  return totals;
}

// The same sums by definition.
Totals defined(const std::vector<Batch>& batches, const std::vector<std::uint32_t>& first_tile, Hits hits) {
  Totals totals(first_tile.back(), first_tile.size() - 1, hits);
  for (const Batch& batch : batches) {
    std::vector<std::uint64_t> scores(first_tile.back()), maps(first_tile.size() - 1);
    std::uint64_t all = 0;
    for (const Impact& impact : batch.impacts) {
      scores[impact.tile] += impact.units;
      maps[map_of(impact.tile, first_tile)] += impact.units;
      all += impact.units;
      if (hits == Hits::apart) ++totals.hits[impact.tile];
    }
    for (std::size_t k = 0; k < scores.size(); ++k) totals.tiles[k].add(scores[k], batch.histories);
    for (std::size_t k = 0; k < maps.size(); ++k) totals.tile_maps[k].add(maps[k], batch.histories);
    totals.incident.add(all, batch.histories);
    totals.histories += batch.histories;
  }
  return totals;
}

bool same(const Moments& a, const Moments& b) {
  return a.sum == b.sum && a.squares == b.squares;
}

void check_same(const Totals& a, const Totals& b) {
  for (std::size_t k = 0; k < a.tiles.size(); ++k) REQUIRE(same(a.tiles[k], b.tiles[k]));
  for (std::size_t k = 0; k < a.tile_maps.size(); ++k) CHECK(same(a.tile_maps[k], b.tile_maps[k]));
  CHECK(a.hits == b.hits);
  CHECK(same(a.incident, b.incident));
  CHECK(a.histories == b.histories);
}

}  // namespace

TEST_CASE("a tally sums the scores of its batches, for few tiles and many, hits and weights") {
  for (const Hits hits : {Hits::are_the_score, Hits::apart}) {
    for (const std::uint32_t tiles : {6U, 600U, 60'000U}) {
      const auto first_tile = three_maps(tiles);
      const auto batches = some_batches(tiles, hits);
      check_same(tallied(batches, first_tile, hits), defined(batches, first_tile, hits));
    }
  }
}

TEST_CASE("a tile gets more hits in a batch than two bytes can count") {
  const auto first_tile = three_maps(60'000);
  std::vector<Batch> batches(3);
  for (Batch& batch : batches) {
    for (int k = 0; k < 150'000; ++k) batch.impacts.push_back({k % 7 == 0 ? 59'999U : 5U, 1});
  }
  batches[1].histories = 1;
  batches[2].impacts.resize(1);
  check_same(tallied(batches, first_tile, Hits::are_the_score), defined(batches, first_tile, Hits::are_the_score));
}

TEST_CASE("a tile is hit in more batches than a byte can count") {
  const auto first_tile = three_maps(60'000);
  std::vector<Batch> batches(1000);
  for (std::size_t b = 0; b < batches.size(); ++b) {
    batches[b].impacts = {{7, 1}, {8, 1}, {8, 1}, {9, 1}};
    if (b % 3 == 0) batches[b].impacts.push_back({9, 1});
  }
  check_same(tallied(batches, first_tile, Hits::are_the_score), defined(batches, first_tile, Hits::are_the_score));
}

TEST_CASE("tiles are hit in more batches than a tile's number of its last batch can distinguish") {
  const auto first_tile = three_maps(4200);
  std::vector<Batch> batches(9000);
  for (std::uint32_t b = 0; b < batches.size(); ++b) {
    const std::uint32_t tile = b % 4095;  // again when the numbers begin anew
    batches[b].impacts.assign(1 + b % 5, {tile, 1});
    if (b == 4096 || b == 6000) batches[b].histories = 7;
  }
  check_same(tallied(batches, first_tile, Hits::are_the_score), defined(batches, first_tile, Hits::are_the_score));
}

TEST_CASE("scores are added even if the sum of their squares exceeds 64 bits") {
  const auto first_tile = three_maps(6);
  std::vector<Batch> batches(40);
  for (Batch& batch : batches) batch.impacts.assign(1000, {3, 16'777'216});
  check_same(tallied(batches, first_tile, Hits::apart), defined(batches, first_tile, Hits::apart));
  // More small batches than are summed in 64 bits at a time.
  std::vector<Batch> small(40'000);
  for (Batch& batch : small) batch.impacts = {{1, 1}, {1, 1}, {4, 1}};
  check_same(tallied(small, first_tile, Hits::are_the_score), defined(small, first_tile, Hits::are_the_score));
}
