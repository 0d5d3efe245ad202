// Colour scale: the colour of each irradiance.
#include "view/scale.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/message.hpp"
#include "lichtmc/error.hpp"

namespace lichtmc {

namespace {

// The area-weighted quantile of the irradiance. Weighted by area because a single photon gives a very high irradiance
// on the small tiles at borders, which must not determine the scale.
double quantile(std::vector<std::pair<double, double>>& lit, double share) {
  double area = 0.0;
  for (const auto& [irradiance, own] : lit) area += own;
  double below = 0.0;
  for (const auto& [irradiance, own] : lit) {
    below += own;
    if (below >= share * area) return irradiance;
  }
  return lit.back().first;
}

// The next of 1, 1.5, 2, 3, 4, 5, 6, 8, 10 times a power of ten.
double round_up(double value) {
  const double decade = std::pow(10.0, std::floor(std::log10(value)));
  for (const double step : {1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0}) {
    if (value <= step * decade * (1.0 + 1e-12)) return step * decade;
  }
  return 10.0 * decade;
}

// The largest of these numbers that does not exceed the value.
double round_down(double value) {
  const double decade = std::pow(10.0, std::floor(std::log10(value)));
  double below = decade;
  for (const double step : {1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0}) {
    if (step * decade <= value) below = step * decade;
  }
  return below;
}

// If the top of the scale exceeds the median by this factor, a linear scale shows half of the lit area in its lowest
// tenth.
constexpr double contrast_for_logarithm = 10.0;
// Range of a logarithmic scale; lower values have the bottom colour.
constexpr double max_decades = 3.0;
// Shares of the lit area that are brighter than the scale's top, and darker than the bottom of a logarithmic one.
constexpr double above_top = 0.02;
constexpr double below_bottom = 0.05;

}  // namespace

double ColourScale::share(double irradiance) const {
  const double place =
      logarithmic ? std::log(irradiance / low) / std::log(high / low) : (irradiance - low) / (high - low);
  return place > 0.0 ? std::min(place, 1.0) : 0.0;
}

ColourScale scale_of(std::vector<std::pair<double, double>> lit, Quantity quantity, const ScaleOptions& options) {
  if (options.high && !(*options.high >= least_scale_top && *options.high <= greatest_scale_top)) {
    throw InputError("The top of the colour scale is " + to_text(*options.high) + " " +
                     std::string(irradiance_unit(quantity)) +
                     " (allowed: a number above 0, from 1e-300 to 1e300). Give --scale-max such a number, or omit it.");
  }
  std::sort(lit.begin(), lit.end());
  ColourScale scale;
  scale.colours = options.colours;
  const double top = lit.empty() ? 1.0 : quantile(lit, 1.0 - above_top);
  scale.high = options.high.value_or(round_up(top));
  const bool contrast = !lit.empty() && top > contrast_for_logarithm * quantile(lit, 0.5);
  scale.logarithmic = options.type == ScaleType::logarithmic || (options.type == ScaleType::automatic && contrast);
  if (scale.logarithmic) {
    const double least = scale.high / std::pow(10.0, max_decades);
    const double dark = lit.empty() ? least : round_down(quantile(lit, below_bottom));
    scale.low = std::clamp(dark, least, 0.1 * scale.high);
  }
  return scale;
}

ColourScale choose_scale(const Result& result, const ScaleOptions& options) {
  std::vector<std::pair<double, double>> lit;
  for (std::size_t t = 0; t < result.tiles.size(); ++t) {
    if (result.tiles[t].irradiance > 0.0) lit.emplace_back(result.tiles[t].irradiance, result.tiling.tiles[t].area_m2);
  }
  // Without results of tiles, the receivers determine the scale.
  if (lit.empty()) {
    for (const ReceiverResult& receiver : result.receiver_results) {
      if (receiver.irradiance > 0.0) lit.emplace_back(receiver.irradiance, 1.0);
    }
  }
  return scale_of(std::move(lit), result.quantity, options);
}

}  // namespace lichtmc
