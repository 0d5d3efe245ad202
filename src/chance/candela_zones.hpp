// Cells of a candela table, and the flux of zones about the aim.
#pragma once

#include <algorithm>
#include <cstddef>

#include "chance/candela_grid.hpp"
#include "lichtmc/candela_table.hpp"

namespace lichtmc {

// The intensity in the table at a plane and a vertical angle, by their numbers.
inline double value(const CandelaTable::Grid& grid, std::size_t plane, std::size_t row) {
  return grid.candela[plane * grid.vertical_deg.size() + row];
}

// Calls add(plane, plane', row, Δφ in rad) for the cells between adjacent angles; a single plane turns all round.
template <class Add>
void for_each_cell(const CandelaTable::Grid& grid, const Add& add) {
  const std::size_t planes = grid.horizontal_deg.size();
  for (std::size_t j = 0; j + 1 < std::max<std::size_t>(planes, 2); ++j) {
    const bool one = planes == 1;
    const double width = one ? 360.0 : grid.horizontal_deg[j + 1] - grid.horizontal_deg[j];
    for (std::size_t i = 0; i + 1 < grid.vertical_deg.size(); ++i)
      add(j, one ? j : j + 1, i, width * radians_per_degree);
  }
}

// Of a table of type C: its flux at γ from … to, 0 ≤ from ≤ to ≤ 180°, in lm. Exact, cell by cell.
double flux_between(const CandelaTable::Grid& grid, double from_deg, double to_deg);

}  // namespace lichtmc
