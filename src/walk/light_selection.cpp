#include "walk/light_selection.hpp"

#include <algorithm>
#include <cassert>
#include <numeric>
#include <utility>

#include "chance/choice.hpp"

namespace lichtmc {

namespace {

constexpr double share_by_flux = 0.05;  // a
// The largest s, for cells whose table has all emitters.
constexpr double most_by_cell = 0.9;

// u, which is below `share`, as a number in [0, 1).
double stretched(double u, double share) {
  return std::min(u / share, 1.0 - 0x1p-53);
}

}  // namespace

LightSelection::LightSelection(const std::vector<double>& fluxes) : LightSelection(fluxes, PlaceTree({}, 1, 1), {}) {}

LightSelection::LightSelection(const std::vector<double>& fluxes, PlaceTree cells, const Tables& tables)
    : by_flux_(fluxes), flux_up_to_(cumulative(fluxes)), cells_(std::move(cells)) {
  const double sum = std::accumulate(fluxes.begin(), fluxes.end(), 0.0);
  for (double& share : by_flux_) share /= sum;
  std::vector<Table> of_regions;
  for (const std::vector<Weight>& weights : tables.of_regions) of_regions.push_back(add_table(weights));
  for (std::uint32_t cell = 0; cell < cells_.size(); ++cell) {
    const Table of_cell = add_table(tables.of_cells[cell].weights);
    const double share = of_cell.is_empty() ? 0.0 : most_by_cell * tables.of_cells[cell].share;
    tables_.push_back({of_cell, of_regions[cells_.region_of(cell)], share});
  }
  tables_.emplace_back();
}

// Probabilities are integers, so that they sum to 1 exactly and each follows from two neighbours. One below 2⁻³² is 0.
LightSelection::Table LightSelection::add_table(const std::vector<Weight>& weights) {
  const auto begin = static_cast<std::uint32_t>(entries_.size());
  double sum = 0.0;
  for (const Weight& one : weights) sum += one.weight;
  double before = 0.0;
  for (const Weight& one : weights) {
    if (!(one.weight > 0.0)) continue;
    entries_.push_back({one.emitter, static_cast<std::uint32_t>(std::min(before / sum * 0x1p32, 0x1p32 - 1.0))});
    before += one.weight;
  }
  return {begin, static_cast<std::uint32_t>(entries_.size())};
}

// u in [0, 1). The first entry begins at 0: one is at or before the place.
std::size_t LightSelection::choose_from(const Table& table, double u) const {
  assert(!table.is_empty());
  const double place = u * 0x1p32;
  const auto after = std::upper_bound(entries_.data() + table.begin, entries_.data() + table.end, place,
                                      [](double here, const Entry& entry) { return here < entry.from; });
  return (after - 1)->emitter;
}

double LightSelection::probability_in(const Table& table, std::size_t emitter) const {
  const Entry* const end = entries_.data() + table.end;
  const Entry* const found =
      std::lower_bound(entries_.data() + table.begin, end, emitter,
                       [](const Entry& entry, std::size_t wanted) { return entry.emitter < wanted; });
  if (found == end || found->emitter != emitter) return 0.0;
  const double to = found + 1 < end ? (found + 1)->from : 0x1p32;
  return (to - found->from) * 0x1p-32;
}

LightSelection::Choice LightSelection::choose(std::uint32_t cell, double u) const {
  const CellTables& tables = tables_[cell];
  std::size_t emitter = 0;
  if (tables.region.is_empty()) {
    emitter = lichtmc::choose(flux_up_to_, u);
  } else if (u < tables.share) {
    emitter = choose_from(tables.cell, stretched(u, tables.share));
  } else if (u < tables.share + share_by_flux) {
    emitter = lichtmc::choose(flux_up_to_, stretched(u - tables.share, share_by_flux));
  } else {
    const double before = tables.share + share_by_flux;
    emitter = choose_from(tables.region, stretched(u - before, 1.0 - before));
  }
  return {emitter, probability(cell, emitter)};
}

double LightSelection::probability(std::uint32_t cell, std::size_t emitter) const {
  const CellTables& tables = tables_[cell];
  if (tables.region.is_empty()) return by_flux_[emitter];
  return tables.share * probability_in(tables.cell, emitter) +
         (1.0 - share_by_flux - tables.share) * probability_in(tables.region, emitter) +
         share_by_flux * by_flux_[emitter];
}

}  // namespace lichtmc
