#include "chance/law_lanes.hpp"

#include <cmath>

#include "base/lanes.hpp"
#include "chance/candela_sampler.hpp"
#include "chance/lane_math.hpp"

namespace lichtmc {

namespace {

// 1 − cos θ = −expm1(ln u · share), share = 1/(m + 1).
LICHTMC_LANES void lambert_angles(std::size_t n, const std::uint32_t* LICHTMC_APART words, float share,
                                  float* LICHTMC_APART sine, float* LICHTMC_APART cosine) {
  for (std::size_t i = 0; i < n; ++i) {
    const float versine = -lane_expm1(share * lane_log_unit(words[i]));
    sine[i] = std::sqrt(versine * (2.0F - versine));
    cosine[i] = 1.0F - versine;
  }
}

// cos θ = 1 − 2u; near both poles from 1 − u, which float holds exactly there.
LICHTMC_LANES void isotropic_angles(std::size_t n, const std::uint32_t* LICHTMC_APART words, float* LICHTMC_APART sine,
                                    float* LICHTMC_APART cosine) {
  for (std::size_t i = 0; i < n; ++i) {
    const float u = (static_cast<float>(words[i]) + 0.5F) * 0x1p-32F;
    const float rest = (static_cast<float>(~words[i]) + 0.5F) * 0x1p-32F;
    sine[i] = 2.0F * std::sqrt(u * rest);
    cosine[i] = rest - u;
  }
}

}  // namespace

void polar_angles(const LambertLaw& law, std::size_t n, const std::uint32_t* words, float* sine, float* cosine) {
  lambert_angles(n, words, static_cast<float>(1.0 / (law.exponent + 1.0)), sine, cosine);
}

void polar_angles(const IsotropicLaw& /*law*/, std::size_t n, const std::uint32_t* words, float* sine, float* cosine) {
  isotropic_angles(n, words, sine, cosine);
}

void lane_directions(const MeasuredLaw& law, std::size_t n, const std::uint32_t* polar, const std::uint32_t* azimuth,
                     float* x, float* y, float* z) {
  law.table->sampler().sample(n, polar, azimuth, x, y, z);
}

}  // namespace lichtmc
