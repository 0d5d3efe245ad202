#include "photometry/measured_values.hpp"

#include <cmath>
#include <memory>
#include <utility>

#include "lichtmc/error.hpp"

namespace lichtmc {

namespace {

// Below −1 % of the maximum a negative value is no noise of the photometer.
constexpr double largest_noise = 0.01;
// Of what any luminaire has, by far: below and above this a number has slipped.
constexpr double least_candela = 1e-9;
constexpr double most_candela = 1e12;

}  // namespace

void check_size(const Origin& origin, std::size_t line, std::size_t vertical, std::size_t horizontal) {
  if (vertical * horizontal > photometry_limits::values)
    origin.refuse(line, std::to_string(vertical) + " vertical x " + std::to_string(horizontal) +
                            " horizontal angles are " + std::to_string(vertical * horizontal) + " values; at most " +
                            std::to_string(photometry_limits::values) + " are read. Use a file with a coarser grid.");
}

double widest_step(const std::vector<double>& angles) {
  double widest = 0.0;
  for (std::size_t k = 1; k < angles.size(); ++k) widest = std::max(widest, angles[k] - angles[k - 1]);
  return widest;
}

void repeat_first_plane(CandelaTable::Grid& grid, MeasuredValues& table) {
  grid.horizontal_deg.push_back(grid.horizontal_deg.front() + 360.0);
  const auto first = table.values.begin();
  table.values.insert(table.values.end(), first, first + static_cast<std::ptrdiff_t>(grid.vertical_deg.size()));
}

void compare_seam(const CandelaTable::Grid& grid, const MeasuredValues& table, std::vector<std::string>& warnings) {
  const std::size_t rows = grid.vertical_deg.size();
  const std::size_t last = (grid.horizontal_deg.size() - 1) * rows;
  double most = 0.0;
  for (std::size_t i = 0; i < rows; ++i) most = std::max(most, std::abs(table.values[i] - table.values[last + i]));
  if (most > 0.0)
    warnings.push_back("The planes at 0° and 360° (C0 and C360) differ, by up to " + percent(most / table.highest) +
                       " of the maximum; each counts on its side.");
}

void set_candela(Photometry& photometry, const Origin& origin, CandelaTable::Grid grid, MeasuredValues table,
                 double factor) {
  if (!(table.highest > 0.0))
    origin.refuse(table.negative > 0
                      ? "no candela value is above 0. Get a file of a measurement."
                      : "every candela value is 0, the luminaire gives no light. Get a file of a measurement.");
  if (table.lowest < -largest_noise * table.highest)
    origin.refuse(table.lowest_line, "a candela value is " + to_text(table.lowest) +
                                         ". Allowed: 0 or more, and down to -1 % of the maximum (" +
                                         to_text(table.highest) + ") as noise of the measurement. Correct the value.");
  if (table.negative > 0)
    photometry.warnings.push_back((table.negative == 1 ? std::string("1 negative candela value is")
                                                       : to_text(table.negative, "negative candela value") + " are") +
                                  " set to 0; the lowest is " + to_text(table.lowest) + ", " +
                                  percent(-table.lowest / table.highest) + " of the maximum.");
  const double most = table.highest * factor;
  if (!(most >= least_candela && most <= most_candela))
    origin.refuse("the maximum is " + to_text(most) + " " + photometry.intensity_unit + " (table " +
                  to_text(table.highest) + " times factors " + to_text(factor) +
                  "). Allowed: " + to_text(least_candela) + " to " + to_text(most_candela) + ". Correct the factors.");
  for (double& value : table.values) value = std::max(value, 0.0) * factor;
  grid.candela = std::move(table.values);
  photometry.factor = factor;
  try {
    photometry.candela = std::make_shared<const CandelaTable>(std::move(grid));
  } catch (const InputError& error) {
    origin.refuse(error.what());
  }
}

void compare_stated_flux(Photometry& photometry, const std::string& origin_of_statement) {
  constexpr double allowed = 0.05;
  if (!photometry.stated_lm) return;
  const double flux = photometry.flux();
  const std::string& per_steradian = photometry.intensity_unit;
  const std::size_t slash = per_steradian.find('/');
  const std::string unit = per_steradian == "cd" || slash == std::string::npos ? "lm" : per_steradian.substr(0, slash);
  const double off = flux / *photometry.stated_lm - 1.0;
  if (std::abs(off) <= allowed) return;
  photometry.warnings.push_back("The file states " + rounded(*photometry.stated_lm, 4) + " " + unit + " (" +
                                origin_of_statement + "); the integral of its table is " + rounded(flux, 4) + " " +
                                unit + ", " + percent(std::abs(off)) + (off > 0.0 ? " more" : " less") +
                                ". The table counts; scale the luminaire if the other is right.");
}

}  // namespace lichtmc
