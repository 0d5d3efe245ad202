#include "walk/weights.hpp"

#include "base/lanes.hpp"
#include "walk/totals.hpp"

namespace lichtmc {

namespace {

// The same number as WeightPolicy::units(): weights are at most 1.
inline std::int32_t units_of(double weight) {
  return static_cast<std::int32_t>(weight * weight_units + 0.5);
}

// A number below 2³² as double; only conversions of signed numbers have a vector instruction.
inline double to_double(std::uint32_t x) {
  return static_cast<double>(static_cast<std::int32_t>(x ^ 0x80000000U)) + 0x1p31;
}

LICHTMC_LANES std::int64_t reflect_lanes(std::size_t n, const std::uint32_t* LICHTMC_APART surface,
                                         const double* LICHTMC_APART reflectance_of, double* LICHTMC_APART weight) {
  std::int64_t absorbed = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const double before = weight[i];
    const double after = before * reflectance_of[surface[i]];
    absorbed += units_of(before) - units_of(after);
    weight[i] = after;
  }
  return absorbed;
}

LICHTMC_LANES double smallest_of(std::size_t n, const double* LICHTMC_APART weight) {
  constexpr std::size_t side_by_side = 8;
  double smallest[side_by_side] = {1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0};
  std::size_t i = 0;
  for (; i + side_by_side <= n; i += side_by_side) {
    for (std::size_t k = 0; k < side_by_side; ++k)
      smallest[k] = weight[i + k] < smallest[k] ? weight[i + k] : smallest[k];
  }
  for (; i < n; ++i) smallest[0] = weight[i] < smallest[0] ? weight[i] : smallest[0];
  double least = 1.0;
  for (const double one : smallest) least = one < least ? one : least;
  return least;
}

LICHTMC_LANES std::int64_t roulette_lanes(std::size_t n, const std::uint64_t* LICHTMC_APART chance, double threshold,
                                          double restored, double* LICHTMC_APART weight,
                                          std::uint8_t* LICHTMC_APART marks) {
  std::int64_t removed = 0;
  const std::int64_t added = units_of(restored);
  for (std::size_t i = 0; i < n; ++i) {
    const double before = weight[i];
    // unit_fine() of the words 2 and 3.
    const double draw = to_double(static_cast<std::uint32_t>(chance[i] >> 32)) * 0x1p-32 +
                        to_double(static_cast<std::uint32_t>(chance[i]) >> 11) * 0x1p-53;
    const bool below = before < threshold;
    const bool survives = below & (draw * restored < before);
    removed += below ? units_of(before) - (survives ? added : 0) : 0;
    weight[i] = survives ? restored : before;
    marks[i] = static_cast<std::uint8_t>(!below | survives);
  }
  return removed;
}

LICHTMC_LANES void units_lanes(std::size_t n, const double* LICHTMC_APART weight, std::uint32_t* LICHTMC_APART units) {
  for (std::size_t i = 0; i < n; ++i) units[i] = static_cast<std::uint32_t>(units_of(weight[i]));
}

}  // namespace

WeightLoss reflect_weights(std::size_t n, const std::uint32_t* surface, const double* reflectance_of, double* weight) {
  const std::int64_t absorbed = reflect_lanes(n, surface, reflectance_of, weight);
  return {absorbed, smallest_of(n, weight)};
}

std::int64_t play_roulette(std::size_t n, const std::uint64_t* chance, double threshold, double restored,
                           double* weight, std::uint8_t* marks) {
  return roulette_lanes(n, chance, threshold, restored, weight, marks);
}

void units_of_each(std::size_t n, const double* weight, std::uint32_t* units) {
  units_lanes(n, weight, units);
}

}  // namespace lichtmc
