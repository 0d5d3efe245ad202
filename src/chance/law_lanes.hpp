// Emitter laws whose polar angles are sampled for many photons in one loop of plain arithmetic, in float.
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

// Whether two laws have the same angles: photons of many emitters with one law are then sampled together.
inline bool same_angles(const LambertLaw& a, const LambertLaw& b) {
  return a.exponent == b.exponent;
}
inline bool same_angles(const IsotropicLaw& /*a*/, const IsotropicLaw& /*b*/) {
  return true;
}

template <class Law>
concept LaneLaw = requires(const Law& law, const std::uint32_t* words, float* numbers) {
  polar_angles(law, std::size_t{1}, words, numbers, numbers);
  same_angles(law, law);
};

}  // namespace lichtmc
