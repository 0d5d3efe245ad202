// What both formats have in common: angles that rise, and a table of intensities.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include "base/message.hpp"
#include "lichtmc/photometry.hpp"
#include "photometry/origin.hpp"

namespace lichtmc {

namespace photometry_limits {
inline constexpr std::size_t bytes = std::size_t{16} << 20;
inline constexpr long angles = 20'000;
inline constexpr std::size_t values = 4'000'000;
}  // namespace photometry_limits

// Angles closer than this, in degrees, are not told apart: no photometer does.
inline constexpr double least_step_deg = 1e-6;

// Refuses more values than are read.
void check_size(const Origin& origin, std::size_t line, std::size_t vertical, std::size_t horizontal);

// Reads angles, each within limits and greater than the one before. Numbers: NumberStream or NumberLines.
template <class Numbers>
std::vector<double> read_angles(Numbers& numbers, std::size_t count, const std::string& which, double low, double high,
                                const std::string& hint) {
  std::vector<double> angles;
  angles.reserve(std::min(count, numbers.bytes_left() / 2 + 1));
  for (std::size_t k = 0; k < count; ++k) {
    const double angle = numbers.number(which + " angle");
    if (k > 0 && !(angle >= angles.back() + least_step_deg))
      numbers.origin().refuse(numbers.line(), which + " angles must rise: " + to_text(angle) + " follows " +
                                                  to_text(angles.back()) + " " + hint + ".");
    if (!(angle >= low && angle <= high))
      numbers.origin().refuse(numbers.line(), "a " + which + " angle is " + to_text(angle) + "°. Allowed: " +
                                                  to_text(low) + " to " + to_text(high) + "°. Correct the angle.");
    angles.push_back(angle);
  }
  return angles;
}

// Numbers of a table, plane by plane.
struct MeasuredValues {
  std::vector<double> values;
  double lowest = 0.0;
  std::size_t lowest_line = 0;
  double highest = 0.0;
  std::size_t negative = 0;
};

template <class Numbers>
MeasuredValues read_values(Numbers& numbers, std::size_t vertical, std::size_t horizontal, const std::string& planes) {
  const std::size_t count = vertical * horizontal;
  MeasuredValues table;
  // With room for one more plane.
  table.values.reserve(std::min(count, numbers.bytes_left() / 2 + 1) + vertical);
  for (std::size_t k = 0; k < count; ++k) {
    if (numbers.at_end())
      numbers.origin().refuse(to_text(count, "candela value") + (count == 1 ? " is" : " are") + " announced (" +
                              std::to_string(vertical) + " vertical x " + std::to_string(horizontal) + " " + planes +
                              "), the file ends after " + std::to_string(k) + ". Get the whole file.");
    const double value = numbers.number("candela");
    table.values.push_back(value);
    table.highest = std::max(table.highest, value);
    if (value < 0.0) ++table.negative;
    if (value < table.lowest) {
      table.lowest = value;
      table.lowest_line = numbers.line();
    }
  }
  return table;
}

// The widest step between adjacent angles.
double widest_step(const std::vector<double>& angles);

// Appends the first plane after a whole turn.
void repeat_first_plane(CandelaTable::Grid& grid, MeasuredValues& table);

// Notes first and last planes of a turn that differ: the intensity then jumps there.
void compare_seam(const CandelaTable::Grid& grid, const MeasuredValues& table, std::vector<std::string>& warnings);

// Checks the values, multiplies them, and makes the table of the luminaire. grid: without its values.
void set_candela(Photometry& photometry, const Origin& origin, CandelaTable::Grid grid, MeasuredValues table,
                 double factor);

// Warns if the flux that a file states differs from that of its table by more than 5 %.
void compare_stated_flux(Photometry& photometry, const std::string& origin_of_statement);

}  // namespace lichtmc
