// Directions as emitters and surfaces send light: each sampler beside its density.
//
// Directions are given in a frame whose third axis is the emitter's axis or the surface's normal. Sampling is by
// inversion, azimuth uniform. Densities are per solid angle (1/sr) and take the cosine of the angle to the third axis.
// Source: H. Schulze, Lichtausbreitung in Räumen: Skizzen zur Monte-Carlo-Simulation, 2021, eq. 1-12.
#pragma once

#include <cmath>
#include <numbers>

#include <glm/vec3.hpp>

namespace lichtmc {

// Sine and cosine of 2π·turns for 0 ≤ turns ≤ 1, accurate to 1.5e-7: plain arithmetic, so that a loop over photons
// vectorises. Polynomials of degree 7 and 8 on [−π/4, π/4] by S. Moshier (Cephes, sinf.c).
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

// Lambert's law, density cos θ/π: how a diffuse surface scatters. Two random words; every direction has cos θ > 0.
inline glm::vec3 sample_lambert(std::uint32_t word_polar, std::uint32_t word_azimuth) {
  // (word + ½)/2³² in float: at least 2⁻³³, so that no photon flies along its own surface; at most 1.
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

// Direction at 1 − cos θ = `versine` (0 … 2) and azimuth 2π·turns; exact near the axis, where 1 − cos²θ would cancel.
inline glm::dvec3 direction_at(double versine, double turns) {
  const double sin_polar = std::sqrt(versine * (2.0 - versine));
  const double azimuth = 2.0 * std::numbers::pi * turns;
  return {sin_polar * std::cos(azimuth), sin_polar * std::sin(azimuth), 1.0 - versine};
}

// Generalized Lambert emitter, density (m+1)/(2π) cos^m θ on the hemisphere, m ≥ 0; 0 < u < 1, 0 ≤ turns ≤ 1.
// cos θ = u^{1/(m+1)} as 1 − cos θ = −expm1(ln u/(m+1)): accurate for every m up to infinity, the pencil beam.
inline glm::dvec3 sample_generalized_lambert(double exponent, double u, double turns) {
  return direction_at(-std::expm1(std::log(u) / (exponent + 1.0)), turns);
}

inline double pdf_generalized_lambert(double exponent, double cos_polar) {
  if (cos_polar <= 0.0) return 0.0;
  return (exponent + 1.0) / (2.0 * std::numbers::pi) * std::pow(cos_polar, exponent);
}

// The whole sphere, density 1/4π; 0 < u < 1.
inline glm::dvec3 sample_sphere(double u, double turns) {
  return direction_at(2.0 * u, turns);
}

inline double pdf_sphere(double /*cos_polar*/) {
  return 1.0 / (4.0 * std::numbers::pi);
}

// 1 − cos of an angle, exact for small angles.
inline double versine(double angle) {
  const double sine = std::sin(0.5 * angle);
  return 2.0 * sine * sine;
}

// Spot with half angles inner < outer (rad): full intensity in the inner cone, between the cones a² with
// a = (cos θ − cos outer)/(cos inner − cos outer). This is the falloff that the KHR_lights_punctual specification shows
// as an implementation note; the specification leaves the choice to the reader. Integrated over the sphere the cones
// hold 2π(1 − cos inner) and 2π(cos inner − cos outer)/3 of solid angle times intensity.
inline double spot_solid_angle(double inner, double outer) {
  const double core = versine(inner);
  return 2.0 * std::numbers::pi * (core + (versine(outer) - core) / 3.0);
}

inline glm::dvec3 sample_spot(double inner, double outer, double u, double turns) {
  const double core = versine(inner);
  const double rim = versine(outer) - core;
  const double core_share = core / (core + rim / 3.0);
  if (u < core_share) return direction_at(core * (u / core_share), turns);
  // Between the cones the density over cos θ is a²: its inverse is a cube root.
  const double a = std::cbrt((1.0 - u) / (1.0 - core_share));
  return direction_at(core + rim * (1.0 - a), turns);
}

inline double pdf_spot(double inner, double outer, double cos_polar) {
  const double rim = versine(outer);
  const double ramp = (rim - (1.0 - cos_polar)) / (rim - versine(inner));
  const double a = std::fmin(std::fmax(ramp, 0.0), 1.0);
  return a * a / spot_solid_angle(inner, outer);
}

}  // namespace lichtmc
