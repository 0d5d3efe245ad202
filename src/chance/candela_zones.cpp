#include "chance/candela_zones.hpp"

#include <cmath>

namespace lichtmc {

double flux_between(const CandelaTable::Grid& grid, double from_deg, double to_deg) {
  double sum = 0.0;
  for_each_cell(grid, [&](std::size_t j, std::size_t next, std::size_t i, double width) {
    const double start = grid.vertical_deg[i];
    const double whole = grid.vertical_deg[i + 1] - start;
    const double from = std::max(start, from_deg);
    const double to = std::min(grid.vertical_deg[i + 1], to_deg);
    if (!(to > from)) return;
    const double first = 0.5 * (value(grid, j, i) + value(grid, next, i));
    const double last = 0.5 * (value(grid, j, i + 1) + value(grid, next, i + 1));
    const auto between = [&](double vertical) { return first + (vertical - start) / whole * (last - first); };
    const double middle = 0.5 * (from + to) * radians_per_degree;
    sum += width * weighted_interval(between(from), between(to), std::sin(middle), std::cos(middle),
                                     0.5 * (to - from) * radians_per_degree);
  });
  return sum * mirrors_of(grid).copies();
}

}  // namespace lichtmc
