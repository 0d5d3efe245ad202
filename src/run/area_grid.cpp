// The number of points of calculation areas.
#include <algorithm>
#include <cmath>

#include "base/message.hpp"
#include "lichtmc/error.hpp"
#include "lichtmc/lay_areas.hpp"

namespace lichtmc {

namespace {

constexpr double most_cells = 1e6;

// Lengths are differences of coordinates that are known to a millionth of the room's size (run/columns.hpp), so that 5
// m may be 5.000005 m: limits hold to ten times that share.
constexpr double rounding_share = 1e-5;

void check_cells(double columns, double rows, double width_m, double height_m) {
  if (columns * rows <= most_cells) return;  // false for NaN
  throw InputError("An area of " + short_number(width_m) + " m × " + short_number(height_m) + " m would have " +
                   short_number(columns * rows) +
                   " points (allowed: up to 1e6). Give it a greater spacing, or divide it.");
}

// Whole numbers of cells along two sides, so that no cell is more than twice as long as wide: the longer side of the
// cell is divided.
GridSize grid_of(double columns, double rows, double width_m, double height_m) {
  constexpr double rounding = 1e-9;  // of the quotients: a ratio of exactly 2 is allowed
  columns = std::max({1.0, columns, std::ceil(0.5 * width_m / (height_m / rows) - rounding)});
  rows = std::max({1.0, rows, std::ceil(0.5 * height_m / (width_m / columns) - rounding)});
  check_cells(columns, rows, width_m, height_m);
  return {static_cast<std::uint32_t>(columns), static_cast<std::uint32_t>(rows)};
}

}  // namespace

GridSize grid_of_en_12464(double width_m, double height_m) {
  const double longer = std::max(width_m, height_m);
  const double shorter = std::min(width_m, height_m);
  const double d = longer >= 2.0 * (1.0 - rounding_share) * shorter ? shorter : longer;
  constexpr double greatest_m = 10.0;
  const double p = std::min(greatest_m, 0.2 * std::pow(5.0, std::log10(d)));
  const double cell = d / std::max(1.0, std::round(d / p));
  return grid_of(std::max(1.0, std::round(width_m / cell)), std::max(1.0, std::round(height_m / cell)), width_m,
                 height_m);
}

GridSize grid_with_spacing(double width_m, double height_m, double spacing_m) {
  const auto along = [&](double length) {
    return std::max(1.0, std::ceil(length / spacing_m * (1.0 - rounding_share)));
  };
  return grid_of(along(width_m), along(height_m), width_m, height_m);
}

}  // namespace lichtmc
