// The weights of a wave's photons, by vector instructions (estimators.hpp explains the estimators).
#pragma once

#include <cstddef>
#include <cstdint>

namespace lichtmc {

// The effect of one reflection on the weights of a wave, in units (see totals.hpp).
struct WeightLoss {
  std::int64_t absorbed = 0;
  double lightest = 1.0;  // the smallest weight after it
};

// Multiplies every photon's weight by the reflectance of the surface that it has hit.
WeightLoss reflect_weights(std::size_t n, const std::uint32_t* surface, const double* reflectance_of, double* weight);

// Russian roulette for weights below `threshold`: a weight becomes `restored` with probability weight/restored,
// otherwise the history ends. chance: as from draw_many(). marks: 1 for photons that survive, else 0. Returns the units
// removed minus those added.
std::int64_t play_roulette(std::size_t n, const std::uint64_t* chance, double threshold, double restored,
                           double* weight, std::uint8_t* marks);

// Weights in units, rounded.
void units_of_each(std::size_t n, const double* weight, std::uint32_t* units);

}  // namespace lichtmc
