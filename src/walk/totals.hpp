// Sums over batches: scores per tile and per tile map, and the balance of the photons.
//
// Scores are integers: 1 for an impact of an analog photon, the weight in units of 2⁻²⁴ for a weighted one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/fields.hpp"
#include "base/wide.hpp"
#include "chance/moments.hpp"
#include "tracer/tracer.hpp"

namespace lichtmc {

// Units of a weight of 1. A score is rounded by at most half a unit, 3·10⁻⁸. A batch's sum stays below 2⁶⁴ for up to
// 10⁹ impacts per history.
inline constexpr double weight_units = 0x1p24;

// Whether the hits of a tile are counted separately from its score.
enum class Hits {
  are_the_score,  // every hit scores 1
  apart,
};

// How the power that a surface absorbs is found.
enum class Absorption {
  by_reflectance,  // incident power times 1 − ρ
  counted,         // photon by photon: ρ varies over a surface of the room
};

// The balance of the photons, in units of the score. Emitted = absorbed + escaped + residual + lost, exactly.
struct Ends {
  int128 absorbed = 0;
  int128 escaped = 0;
  int128 residual = 0;  // weight cut off; with Russian roulette: removed minus added, may be negative
  int128 lost = 0;
  std::uint64_t lost_histories = 0;
};

template <class F, AllOf<Ends>... Things>
void visit_fields(const F& f, Things&... ends) {
  f(Field{"absorbed"}, ends.absorbed...);
  f(Field{"escaped"}, ends.escaped...);
  f(Field{"residual"}, ends.residual...);
  f(Field{"lost"}, ends.lost...);
  f(Field{"lost_histories"}, ends.lost_histories...);
}

// The counts for all tiles together.
struct Counts {
  std::uint64_t histories = 0;
  std::uint64_t impacts = 0;
  TraceCount traced;
  Ends ends;
  Moments incident;
};

// All sums over batches. Addition is exact: the order does not matter.
struct Totals : Counts {
  Totals() = default;
  Totals(std::size_t tiles, std::size_t tile_maps, Hits hits, Absorption absorption = Absorption::by_reflectance);

  std::vector<Moments> tiles;       // per tile
  std::vector<std::uint64_t> hits;  // per tile; empty if hits are the score
  std::vector<Moments> tile_maps;   // per tile map
  std::vector<uint128> behind;      // per tile map: score on the back
  // Per tile map: absorbed there, in units of the score; their sum is Ends::absorbed. Empty if not counted.
  std::vector<uint128> absorbed_by;

  void add(const Totals& other) { add_fields(*this, other); }
};

template <class F, AllOf<Totals>... Things>
void visit_fields(const F& f, Things&... totals) {
  f(Field{"histories"}, totals.histories...);
  f(Field{"impacts"}, totals.impacts...);
  f(Field{"traced"}, totals.traced...);
  f(Field{"ends"}, totals.ends...);
  f(Field{"incident"}, totals.incident...);
  f(Field{"tiles"}, totals.tiles...);
  f(Field{"hits"}, totals.hits...);
  f(Field{"tile_maps"}, totals.tile_maps...);
  f(Field{"behind"}, totals.behind...);
  f(Field{"absorbed_by"}, totals.absorbed_by...);
}

}  // namespace lichtmc
