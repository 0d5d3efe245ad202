// The angles of a candela table as polar coordinates: ψ from a pole, φ about it.
//
// Types A and B have their poles at V = −90°, so that ψ = V + 90°; that of type C is the aim, ψ = γ. All three are then
// integrated and sampled alike, with sin ψ as the density of directions. Symmetries mirror the polar vector
//   (sin ψ cos φ, sin ψ sin φ, cos ψ)
// in its coordinate planes.
#pragma once

#include <cmath>
#include <cstddef>
#include <numbers>

#include <glm/vec3.hpp>

#include "lichtmc/candela_table.hpp"

namespace lichtmc {

inline constexpr double radians_per_degree = std::numbers::pi / 180.0;

// Degrees by which a direction may miss the edge of a table by rounding.
inline constexpr double table_rounding_deg = 1e-9;

// A direction of the luminaire's frame as polar vector, and back.
inline glm::dvec3 to_polar(const CandelaTable::Grid& grid, const glm::dvec3& d) {
  const double hand = grid.flip_horizontal ? -1.0 : 1.0;
  switch (grid.type) {
    case PhotometricType::c:
      break;
    case PhotometricType::b:
      return {d.z, -hand * d.y, -d.x};
    case PhotometricType::a:
      return {d.z, hand * d.x, -d.y};
  }
  return d;
}
inline glm::dvec3 from_polar(const CandelaTable::Grid& grid, const glm::dvec3& p) {
  const double hand = grid.flip_horizontal ? -1.0 : 1.0;
  switch (grid.type) {
    case PhotometricType::c:
      break;
    case PhotometricType::b:
      return {-p.z, -hand * p.y, p.x};
    case PhotometricType::a:
      return {hand * p.y, -p.z, p.x};
  }
  return p;
}

// ψ of the vertical angle 0, in degrees.
inline double polar_offset_deg(const CandelaTable::Grid& grid) {
  return grid.type == PhotometricType::c ? 0.0 : 90.0;
}

// In which coordinates of the polar vector a table is mirrored, and which half of them it contains.
struct Mirrors {
  bool x = false;
  bool y = false;
  bool z = false;
  double side_x = 1.0;  // sign of x in the table
  static constexpr double side_y = 1.0;
  static constexpr double side_z = -1.0;

  int copies() const { return (x ? 2 : 1) * (y ? 2 : 1) * (z ? 2 : 1); }
  // The polar vector of the table with the same intensity.
  glm::dvec3 into_table(const glm::dvec3& p) const {
    return {x ? side_x * std::abs(p.x) : p.x, y ? side_y * std::abs(p.y) : p.y, z ? side_z * std::abs(p.z) : p.z};
  }
};

inline Mirrors mirrors_of(const CandelaTable::Grid& grid) {
  Mirrors mirrors;
  switch (grid.symmetry) {
    case PhotometricSymmetry::none:
    case PhotometricSymmetry::rotational:
      break;
    case PhotometricSymmetry::c0_c180:
    case PhotometricSymmetry::horizontal:
      mirrors.y = true;
      break;
    case PhotometricSymmetry::c90_c270:
      mirrors.x = true;
      mirrors.side_x = grid.horizontal_deg.back() > 180.0 ? -1.0 : 1.0;
      break;
    case PhotometricSymmetry::quadrants:
      mirrors.x = mirrors.y = true;
      break;
    case PhotometricSymmetry::vertical:
      mirrors.z = true;
      break;
    case PhotometricSymmetry::both:
      mirrors.y = mirrors.z = true;
      break;
  }
  return mirrors;
}

// ∫ (c + m t) sin(μ + t) dt over −h … h, where c + m t runs linearly from `first` to `last`: intensity times sin ψ over
// an interval of ψ with the middle μ and half its length h. Both parts are computed without cancellation.
inline double weighted_interval(double first, double last, double sine_middle, double cosine_middle, double half) {
  const double mean = 0.5 * (first + last);
  const double squared = half * half;
  // sin h − h cos h: below 0.1 by its series, whose next term is 2·10⁻¹¹ of it.
  const double odd =
      half < 0.1 ? half * squared * (1.0 / 3.0 - squared * (1.0 / 30.0 - squared * (1.0 / 840.0 - squared / 45360.0)))
                 : std::sin(half) - half * std::cos(half);
  return 2.0 * mean * sine_middle * std::sin(half) + (last - first) / half * cosine_middle * odd;
}

}  // namespace lichtmc
