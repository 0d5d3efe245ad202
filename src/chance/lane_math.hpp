// Logarithm and exponential as plain arithmetic, so that a loop over photons runs in lanes.
//
// Both are accurate to some 2·10⁻¹⁶ of their value in the ranges named, which tests compare with the C library's.
#pragma once

#include <bit>
#include <cstdint>

namespace lichtmc {

// ln x for 2⁻¹⁰⁰⁰ < x < 2¹⁰⁰⁰. x = 2^k (1 + f), 1 + f near 1; ln(1 + f) by the series of artanh with the coefficients of
// Sun's fdlibm (e_log.c, 1993).
inline double lane_log(double x) {
  constexpr double ln2_high = 6.93147180369123816490e-01;
  constexpr double ln2_low = 1.90821492927058770002e-10;
  const auto bits = std::bit_cast<std::uint64_t>(x);
  // Between √½ and √2: where the fraction is above that of √2 the exponent goes up by one.
  const std::uint64_t shifted = bits + (0x3FF0000000000000U - 0x3FE6A09E667F3BCDU);
  const auto k = static_cast<std::int32_t>(shifted >> 52) - 1023;
  const double one_f =
      std::bit_cast<double>((shifted & 0x000FFFFFFFFFFFFFU) + 0x3FE6A09E667F3BCDU);
  const double f = one_f - 1.0;
  const double s = f / (2.0 + f);
  const double z = s * s;
  const double w = z * z;
  const double odd = w * (3.999999999940941908e-01 + w * (2.222219843214978396e-01 + w * 1.531383769920937332e-01));
  const double even = z * (6.666666666666735130e-01 +
                           w * (2.857142874366239149e-01 + w * (1.818357216161805012e-01 + w * 1.479819860511658591e-01)));
  const double half = 0.5 * f * f;
  const double up = static_cast<double>(k);
  return up * ln2_high - ((half - (s * (half + (odd + even)) + up * ln2_low)) - f);
}

// e^x − 1 for −700 < x ≤ 0, exact for small x. x = k ln 2 + r, |r| ≤ ½ ln 2; e^r − 1 by Taylor's series, whose term of
// degree 14 is below 10⁻¹⁷.
inline double lane_expm1(double x) {
  constexpr double ln2_high = 6.93147180369123816490e-01;
  constexpr double ln2_low = 1.90821492927058770002e-10;
  constexpr double to_whole = 0x1.8p52;  // adding and taking it away rounds to a whole number
  const double rounded = x * 1.44269504088896338700e+00 + to_whole;
  const double k = rounded - to_whole;
  const double r = (x - k * ln2_high) - k * ln2_low;
  double sum = 1.0 / 6227020800.0;
  sum = sum * r + 1.0 / 479001600.0;
  sum = sum * r + 1.0 / 39916800.0;
  sum = sum * r + 1.0 / 3628800.0;
  sum = sum * r + 1.0 / 362880.0;
  sum = sum * r + 1.0 / 40320.0;
  sum = sum * r + 1.0 / 5040.0;
  sum = sum * r + 1.0 / 720.0;
  sum = sum * r + 1.0 / 120.0;
  sum = sum * r + 1.0 / 24.0;
  sum = sum * r + 1.0 / 6.0;
  sum = sum * r + 0.5;
  const double small = r + r * r * sum;  // e^r − 1
  // 2^k from the bits of the rounded number, whose lowest hold k.
  const double scale = std::bit_cast<double>((std::bit_cast<std::uint64_t>(rounded) + 1023U) << 52);
  return scale * small + (scale - 1.0);
}

}  // namespace lichtmc
