// Emitter laws: how the flux of an emitter is distributed over directions.
//
// One class per law. Everything that depends on the law alone is in its class: sampling, density, extent, limits of its
// parameters, name. Photon launch, light sampling, integration over tiles, checks, readers and writers use the class.
//
// Directions are unit vectors in the emitter's own frame: +Z is its axis, +X the reference of its azimuth. A law has
//   sample(u, turns)   a direction with the law's density, by inversion; 0 < u < 1, 0 ≤ turns ≤ 1 (azimuth 2π·turns)
//   density(local)     probability density of that direction in 1/sr; it integrates to 1 over the sphere
//   extent()           the cone that contains the emitted power
//   fault()            the first parameter that is out of its range, or none
//   name()             a word for tables
// The intensity in a direction is Φ times the density: see intensity().
//
// Source of the formulas: H. Schulze, Lichtausbreitung in Räumen: Skizzen zur Monte-Carlo-Simulation, 2021, eq. 1-12.
#pragma once

#include <cmath>
#include <concepts>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include <glm/vec3.hpp>

#include "lichtmc/candela_table.hpp"

namespace lichtmc {

// A cone about the axis outside of which the intensity is below 10⁻¹⁶ of that on the axis, and the angle over which the
// intensity changes. Both in rad.
struct EmitterExtent {
  double half_angle = 0.0;  // 0 … π
  double width = 0.0;       // > 0
  bool sharp = false;       // whether the intensity falls to 0 at the cone within less than 1/64 of its half angle
};

// A parameter that is out of its range, as the parts of a message: "The {what} of … is {value} (allowed: {allowed}).
// {remedy}"
struct LawFault {
  std::string what;
  double value = 0.0;
  std::string allowed;
  std::string remedy;
};

// Direction with 1 − cos θ = `versine` (0 … 2) and azimuth 2π·turns; exact near the axis, where 1 − cos²θ would cancel.
inline glm::dvec3 direction_at(double versine, double turns) {
  const double sin_polar = std::sqrt(versine * (2.0 - versine));
  const double azimuth = 2.0 * std::numbers::pi * turns;
  return {sin_polar * std::cos(azimuth), sin_polar * std::sin(azimuth), 1.0 - versine};
}

// 1 − cos of an angle, exact for small angles.
inline double versine_of(double angle) {
  const double sine = std::sin(0.5 * angle);
  return 2.0 * sine * sine;
}

// The same intensity in all directions: density 1/4π.
struct IsotropicLaw {
  glm::dvec3 sample(double u, double turns) const { return direction_at(2.0 * u, turns); }
  double density(const glm::dvec3& /*local*/) const { return 1.0 / (4.0 * std::numbers::pi); }
  EmitterExtent extent() const { return {std::numbers::pi, std::numbers::pi}; }
  std::optional<LawFault> fault() const { return std::nullopt; }
  static constexpr std::string_view name() { return "isotropic"; }
};

// Generalized Lambert law: density (m+1)/(2π) cos^m θ on the hemisphere about the axis.
struct LambertLaw {
  double exponent = 1.0;  // m ≥ 0: 0 uniform hemisphere, 1 Lambert's law, ∞ pencil beam

  // cos θ = u^{1/(m+1)} as 1 − cos θ = −expm1(ln u/(m+1)): accurate for every m up to infinity.
  glm::dvec3 sample(double u, double turns) const {
    return direction_at(-std::expm1(std::log(u) / (exponent + 1.0)), turns);
  }
  double density(const glm::dvec3& local) const { return density_at(local.z); }
  // The law is the same at all azimuths.
  double density_at(double cos_polar) const {
    if (cos_polar <= 0.0) return 0.0;
    // Most emitters follow Lambert's law, whose power is the cosine itself.
    const double power = exponent == 1.0 ? cos_polar : std::pow(cos_polar, exponent);
    return (exponent + 1.0) / (2.0 * std::numbers::pi) * power;
  }
  // cos^m θ falls to 10⁻¹⁶ at 1 − cos θ = 36.8/m, and by half over an angle of about √(2 ln 2/m).
  EmitterExtent extent() const {
    constexpr double log_of_1e16 = 36.8;
    const double versine = -std::expm1(-log_of_1e16 / std::fmax(exponent, 1.0));
    return {std::fmin(0.5 * std::numbers::pi, 2.0 * std::asin(std::sqrt(0.5 * versine))),
            1.0 / std::sqrt(exponent + 1.0)};
  }
  std::optional<LawFault> fault() const {
    if (exponent >= 0.0) return std::nullopt;
    return LawFault{"exponent m (lambert_exponent)", exponent, "0 or more",
                    "Use 0 for a uniform hemisphere, 1 for Lambert's law, more for a beam."};
  }
  static constexpr std::string_view name() { return "lambert"; }
};

// Spot: full intensity inside the inner cone; between the cones a² of it, a = (cos θ − cos outer)/(cos inner − cos
// outer); 0 outside. With inner = outer the edge is hard. This is the falloff that the specification of
// KHR_lights_punctual shows as an implementation note; it leaves the choice to the reader.
struct SpotLaw {
  double inner = 0.0;                      // rad, half angle, 0 ≤ inner ≤ outer
  double outer = std::numbers::pi * 0.25;  // rad, half angle, smallest_outer ≤ outer ≤ π/2

  // Below 10⁻⁶ rad a cone is a pencil beam: that is a Lambert law of large exponent. π/2 as a float may be rounded up.
  static constexpr double smallest_outer = 1e-6;
  static constexpr double largest_outer = std::numbers::pi / 2.0 * (1.0 + 1e-6);

  // Φ = full intensity times this: 2π [(1 − cos inner) + (cos inner − cos outer)/3], in sr.
  double solid_angle() const {
    const double core = versine_of(inner);
    return 2.0 * std::numbers::pi * (core + (versine_of(outer) - core) / 3.0);
  }
  glm::dvec3 sample(double u, double turns) const {
    const double core = versine_of(inner);
    const double between = versine_of(outer) - core;
    const double core_share = core / (core + between / 3.0);
    if (u < core_share) return direction_at(core * (u / core_share), turns);
    // Between the cones the density over cos θ is proportional to a²: its inverse is a cube root.
    const double a = std::cbrt((1.0 - u) / (1.0 - core_share));
    return direction_at(core + between * (1.0 - a), turns);
  }
  double density(const glm::dvec3& local) const {
    const double edge = versine_of(outer);
    const double core = versine_of(inner);
    const double below_edge = edge - (1.0 - local.z);
    // A hard edge, also if the cones differ by less than the rounding of their versines: the ramp has no width.
    if (!(edge > core)) return below_edge >= 0.0 ? 1.0 / solid_angle() : 0.0;
    const double a = std::fmin(std::fmax(below_edge / (edge - core), 0.0), 1.0);
    return a * a / solid_angle();
  }
  EmitterExtent extent() const { return {outer, outer, outer - inner < outer / 64.0}; }
  std::optional<LawFault> fault() const {
    if (!(outer >= smallest_outer && outer <= largest_outer))
      return LawFault{"outer cone angle", outer, "1e-6 to π/2 = 1.5708 rad",
                      "Give the half angle of the cone that contains its light."};
    if (!(inner >= 0.0 && inner <= outer))
      return LawFault{"inner cone angle", inner, "0 rad to the outer angle",
                      "Give the half angle of the cone of full intensity."};
    return std::nullopt;
  }
  static constexpr std::string_view name() { return "spot"; }
};

// A measured luminaire: the density is the intensity of a table divided by its flux. Its frame has +X towards C0 and +Y
// towards C90.
struct MeasuredLaw {
  std::shared_ptr<const CandelaTable> table;

  glm::dvec3 sample(double u, double turns) const { return table->sample(u, turns); }
  double density(const glm::dvec3& local) const { return table->candela(local) / table->flux(); }
  EmitterExtent extent() const { return {table->half_angle(), table->width(), table->has_sharp_edge()}; }
  std::optional<LawFault> fault() const {
    if (table != nullptr) return std::nullopt;
    return LawFault{"number of candela tables", 0.0, "1", "Read the luminaire from a photometric file."};
  }
  static constexpr std::string_view name() { return "measured"; }
};

// One of the laws. A class that is added here must satisfy the concept below, and every visit must handle it; otherwise
// the program does not compile.
using EmitterLaw = std::variant<IsotropicLaw, LambertLaw, SpotLaw, MeasuredLaw>;

template <class Law>
concept DirectionalLaw = requires(const Law& law, double u, const glm::dvec3& local) {
  { law.sample(u, u) } -> std::same_as<glm::dvec3>;
  { law.density(local) } -> std::same_as<double>;
  { law.extent() } -> std::same_as<EmitterExtent>;
  { law.fault() } -> std::same_as<std::optional<LawFault>>;
  { Law::name() } -> std::same_as<std::string_view>;
};
static_assert(DirectionalLaw<IsotropicLaw> && DirectionalLaw<LambertLaw> && DirectionalLaw<SpotLaw> &&
              DirectionalLaw<MeasuredLaw>);

// Intensity in W/sr or cd of an emitter of flux Φ (W or lm), in a direction of its own frame.
inline double intensity(const EmitterLaw& law, double flux, const glm::dvec3& local) {
  return flux * std::visit([&](const auto& one) { return one.density(local); }, law);
}

}  // namespace lichtmc
