// Diffuse reflection: directions by Lambert's law, the sampler beside its density, in float for loops over photons.
//
// Directions are given in a frame whose third axis is the surface's normal. Sampling is by inversion, azimuth uniform.
// Densities are per solid angle (1/sr). The laws of emitters are in lichtmc/emitter_law.hpp.
// Source: H. Schulze, Lichtausbreitung in Räumen: Skizzen zur Monte-Carlo-Simulation, 2021, eq. 1-12.
#pragma once

#include <cmath>
#include <numbers>

#include <glm/vec3.hpp>

namespace lichtmc {

// Sine and cosine of 2π·turns for 0 ≤ turns ≤ 1, accurate to 1.5e-7, in arithmetic that vectorises in a loop over
// photons. Polynomials of degree 7 and 8 on [−π/4, π/4] by S. Moshier (Cephes, sinf.c).
inline void sine_cosine(float turns, float& sine, float& cosine) {
  const float quarters = turns * 4.0F;
  const int quadrant = static_cast<int>(quarters + 0.5F);  // nearest of 0 … 4
  const float angle = (quarters - static_cast<float>(quadrant)) * (std::numbers::pi_v<float> / 2.0F);
  const float square = angle * angle;
  const float s =
      angle + angle * square * (-1.6666654611e-1F + square * (8.3321608736e-3F + square * -1.9515295891e-4F));
  const float c =
      1.0F - 0.5F * square +
      square * square * (4.166664568298827e-2F + square * (-1.388731625493765e-3F + square * 2.443315711809948e-5F));
  const bool swapped = (quadrant & 1) != 0;
  const float sine_size = swapped ? c : s;
  const float cosine_size = swapped ? s : c;
  sine = (quadrant & 2) != 0 ? -sine_size : sine_size;
  cosine = ((quadrant + 1) & 2) != 0 ? -cosine_size : cosine_size;
}

// Lambert's law of diffuse reflection, density cos θ/π. Two random words; every direction has cos θ > 0.
inline glm::vec3 sample_lambert(std::uint32_t word_polar, std::uint32_t word_azimuth) {
  // (word + ½)/2³² in float: at least 2⁻³³, so that no direction is tangential to the surface; at most 1.
  const float u = (static_cast<float>(word_polar) + 0.5F) * 0x1p-32F;
  const float cos_polar = std::sqrt(u);
  const float sin_polar = std::sqrt(1.0F - u);
  float sine = 0.0F;
  float cosine = 0.0F;
  sine_cosine(static_cast<float>(word_azimuth) * 0x1p-32F, sine, cosine);
  return {sin_polar * cosine, sin_polar * sine, cos_polar};
}

inline double pdf_lambert(double cos_polar) {
  return cos_polar > 0.0 ? cos_polar / std::numbers::pi : 0.0;
}

}  // namespace lichtmc
