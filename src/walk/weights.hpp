// The weights of a wave's photons, several at a time (see estimators.hpp for what happens to them and why).
#pragma once

#include <cstddef>
#include <cstdint>

namespace lichtmc {

// What surfaces did to weights, in units (see totals.hpp).
struct WeightLoss {
  std::int64_t absorbed = 0;
  double lightest = 1.0;  // weight left
};

// Every photon's weight falls by the reflectance of the surface it is on.
WeightLoss reflect_weights(std::size_t n, const std::uint32_t* surface, const double* reflectance_of, double* weight);

// Russian roulette for weights below `threshold`: they become `restored` with probability weight/restored, or end.
// chance: as draw_many() draws them. marks: 1 for those that fly on, else 0. Returns the units removed less those
// added.
std::int64_t play_roulette(std::size_t n, const std::uint64_t* chance, double threshold, double restored,
                           double* weight, std::uint8_t* marks);

// Weights in units, rounded.
void units_of_each(std::size_t n, const double* weight, std::uint32_t* units);

}  // namespace lichtmc
