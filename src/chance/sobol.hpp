// Points of Sobol's sequence with a random digital shift: randomised quasi-Monte Carlo.
//
// The first 2^k points of the sequence are spread more evenly than random ones. A random word per dimension, added
// without carries to all points of a set (a digital shift), makes each of them uniform, so that the mean over a set is
// unbiased; sets with independent shifts are independent, and give the error.
//
// I. M. Sobol', USSR Comput. Math. Math. Phys. 7 (1967) 86; direction numbers of S. Joe, F. Y. Kuo, SIAM J. Sci.
// Comput. 30 (2008) 2635; digital shift: P. L'Ecuyer, C. Lemieux, Recent Advances in Randomized Quasi-Monte Carlo
// Methods, 2002.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace lichtmc {

inline constexpr std::size_t sobol_dimensions = 6;

namespace sobol_detail {

using Directions = std::array<std::uint32_t, 32>;

// The direction numbers of a dimension from its primitive polynomial of degree s, whose inner coefficients are the bits
// of a, and the first s odd numbers m.
constexpr Directions directions(std::uint32_t s, std::uint32_t a, std::array<std::uint32_t, 4> m) {
  Directions v{};
  for (std::uint32_t k = 0; k < 32; ++k) {
    if (k < s) {
      v[k] = m[k] << (31 - k);
      continue;
    }
    v[k] = v[k - s] ^ (v[k - s] >> s);
    for (std::uint32_t j = 1; j < s; ++j) v[k] ^= (a >> (s - 1 - j) & 1U) * v[k - j];
  }
  return v;
}

constexpr Directions van_der_corput() {
  Directions v{};
  for (std::uint32_t k = 0; k < 32; ++k) v[k] = std::uint32_t{1} << (31 - k);
  return v;
}

inline constexpr std::array<Directions, sobol_dimensions> all{van_der_corput(),
                                                              directions(1, 0, {1, 0, 0, 0}),
                                                              directions(2, 1, {1, 3, 0, 0}),
                                                              directions(3, 1, {1, 3, 1, 0}),
                                                              directions(3, 2, {1, 1, 1, 0}),
                                                              directions(4, 1, {1, 1, 3, 3})};

}  // namespace sobol_detail

// Coordinate `dimension` (below sobol_dimensions) of point `index`, in units of 2⁻³². The shift is added by ^.
constexpr std::uint32_t sobol(std::uint32_t index, std::size_t dimension) {
  std::uint32_t point = 0;
  for (std::size_t k = 0; index != 0; ++k, index >>= 1) point ^= (index & 1U) * sobol_detail::all[dimension][k];
  return point;
}

}  // namespace lichtmc
