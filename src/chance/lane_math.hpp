// Functions as plain arithmetic, so that a loop over photons vectorises; tests compare them with the C library's.
//
// Logarithm and exponential in float have relative errors of some 2·10⁻⁷, like the directions that they are used for;
// the angle in double has an error of some 3·10⁻¹⁶.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace lichtmc {

// ln u of u = (word + ½)/2³². Near u = 1 it is computed from 1 − u, which float represents as precisely as u near 0. u
// = 2^k (1 + f), 1 + f between √½ and √2; ln(1 + f) by S. Moshier's polynomial (Cephes, logf.c).
inline float lane_log_unit(std::uint32_t word) {
  constexpr std::uint32_t sqrt_half = 0x3F3504F3U;
  const float u = (static_cast<float>(word) + 0.5F) * 0x1p-32F;
  const float rest = (static_cast<float>(~word) + 0.5F) * 0x1p-32F;
  const std::uint32_t shifted = std::bit_cast<std::uint32_t>(u) + (0x3F800000U - sqrt_half);
  const auto k = static_cast<std::int32_t>(shifted >> 23) - 127;
  const float one_f = std::bit_cast<float>((shifted & 0x007FFFFFU) + sqrt_half);
  const float f = k == 0 ? -rest : one_f - 1.0F;
  const float z = f * f;
  float sum = 7.0376836292e-2F;
  sum = sum * f - 1.1514610310e-1F;
  sum = sum * f + 1.1676998740e-1F;
  sum = sum * f - 1.2420140846e-1F;
  sum = sum * f + 1.4249322787e-1F;
  sum = sum * f - 1.6668057665e-1F;
  sum = sum * f + 2.0000714765e-1F;
  sum = sum * f - 2.4999993993e-1F;
  sum = sum * f + 3.3333331174e-1F;
  const auto up = static_cast<float>(k);
  const float low = f * z * sum + up * -2.12194440e-4F - 0.5F * z;
  return (f + low) + up * 0.693359375F;
}

// e^x − 1 for −80 < x ≤ 0, exact for small x. x = k ln 2 + r, |r| ≤ ½ ln 2; e^r − 1 by Taylor's series, whose term of
// degree 8 is below 10⁻⁸ of it.
inline float lane_expm1(float x) {
  constexpr float to_whole = 0x1.8p23F;  // adding and subtracting it rounds to an integer
  const float rounded = x * 1.44269504F + to_whole;
  const float k = rounded - to_whole;
  const float r = (x - k * 0.693359375F) - k * -2.12194440e-4F;
  float sum = 1.0F / 5040.0F;
  sum = sum * r + 1.0F / 720.0F;
  sum = sum * r + 1.0F / 120.0F;
  sum = sum * r + 1.0F / 24.0F;
  sum = sum * r + 1.0F / 6.0F;
  sum = sum * r + 0.5F;
  const float small = r + r * r * sum;  // e^r − 1
  // 2^k from the lowest bits of `rounded`, which contain k.
  const float scale = std::bit_cast<float>((std::bit_cast<std::uint32_t>(rounded) + 127U) << 23);
  return scale * small + (scale - 1.0F);
}

// atan2(y, x), also for 0, 0: then 0 or π by the sign of x. The smaller component divided by the larger, beyond tan π/8
// turned by π/4; then S. Moshier's rational function (Cephes, atan.c).
inline double lane_atan2(double y, double x) {
  constexpr double pi = std::numbers::pi;
  constexpr double tan_eighth = 0.41421356237309505;
  const double across = std::abs(y);
  const double along = std::abs(x);
  const bool steep = across > along;
  const double low = steep ? along : across;
  const double high = steep ? across : along;
  const bool turned = low > tan_eighth * high;
  const double top = turned ? low - high : low;
  const double bottom = turned ? low + high : high;
  const double t = top / (bottom > 0.0 ? bottom : 1.0);
  const double z = t * t;
  double p = -8.750608600031904122785e-1;
  p = p * z - 1.615753718733365076637e1;
  p = p * z - 7.500855792314704667340e1;
  p = p * z - 1.228866684490136173410e2;
  p = p * z - 6.485021904942025371773e1;
  double q = z + 2.485846490142306297962e1;
  q = q * z + 1.650270098316988542046e2;
  q = q * z + 4.328810604912902668951e2;
  q = q * z + 4.853903996359136964868e2;
  q = q * z + 1.945506571482613964425e2;
  const double small = (t + t * (z * p / q)) + (turned ? 0.25 * pi : 0.0);
  const double octant = steep ? 0.5 * pi - small : small;
  const double half = std::signbit(x) ? pi - octant : octant;
  return std::signbit(y) ? -half : half;
}

}  // namespace lichtmc
