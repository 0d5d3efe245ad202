// Emitter laws that are sampled for many photons in one loop of plain arithmetic, in float: laws that are the same at
// all azimuths by their polar angles, others by whole directions.
//
// An option of a law: Launcher samples a law without an overload here photon by photon.
#pragma once

#include <cstddef>
#include <cstdint>

#include "lichtmc/emitter_law.hpp"

namespace lichtmc {

// Sine and cosine of the angle to the axis, one for each of n random words; the arrays do not overlap.
void polar_angles(const LambertLaw& law, std::size_t n, const std::uint32_t* words, float* sine, float* cosine);
void polar_angles(const IsotropicLaw& law, std::size_t n, const std::uint32_t* words, float* sine, float* cosine);

// Directions in the emitter's frame for n pairs of random words; arrays of whole_lanes(n) elements, as above.
void lane_directions(const MeasuredLaw& law, std::size_t n, const std::uint32_t* polar, const std::uint32_t* azimuth,
                     float* x, float* y, float* z);

// Whether two laws have the same angles: photons of many emitters with one law are then sampled together.
inline bool same_angles(const LambertLaw& a, const LambertLaw& b) {
  return a.exponent == b.exponent;
}
inline bool same_angles(const IsotropicLaw& /*a*/, const IsotropicLaw& /*b*/) {
  return true;
}
inline bool same_angles(const MeasuredLaw& a, const MeasuredLaw& b) {
  return a.table == b.table;
}

template <class Law>
concept PolarLaneLaw = requires(const Law& law, const std::uint32_t* words, float* numbers) {
  polar_angles(law, std::size_t{1}, words, numbers, numbers);
};
template <class Law>
concept DirectionLaneLaw = requires(const Law& law, const std::uint32_t* words, float* numbers) {
  lane_directions(law, std::size_t{1}, words, words, numbers, numbers, numbers);
};
template <class Law>
concept LaneLaw = (PolarLaneLaw<Law> || DirectionLaneLaw<Law>)&&requires(const Law& law) {
  same_angles(law, law);
};

}  // namespace lichtmc
