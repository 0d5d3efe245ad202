#include "inspect/guesses.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>

namespace lichtmc {

namespace {

// What rooms, halls and houses measure in metres, at their longest.
constexpr double shortest = 1.0;
constexpr double longest = 200.0;

// A storey is about this high; that is what a unit is judged by.
constexpr double usual_height = 2.7;

constexpr std::array<LengthUnit, 4> other_units{
    {{"centimetres", 0.01}, {"millimetres", 0.001}, {"inches", 0.0254}, {"feet", 0.3048}}};

}  // namespace

std::optional<LengthUnit> guess_unit(const glm::dvec3& size) {
  const double length = std::max({size.x, size.y, size.z});
  if (length >= shortest && length <= longest) return std::nullopt;
  std::optional<LengthUnit> best;
  double least = std::numeric_limits<double>::infinity();
  for (const LengthUnit& unit : other_units) {
    const double metres = length * unit.metres;
    if (metres < shortest || metres > longest) continue;
    const double miss = std::abs(std::log(std::max(size.y, 1e-3 * length) * unit.metres / usual_height));
    if (miss >= least) continue;
    least = miss;
    best = unit;
  }
  return best;
}

bool looks_z_up(const Room& room, const glm::dvec3& size) {
  if (size.z > size.y) return false;
  constexpr double along = 0.99;  // cosine: within 8° of the axis
  constexpr double noticeable = 1.5;
  double across_y = 0.0;
  double across_z = 0.0;
  for (const Surface& surface : room.surfaces) {
    for (const glm::uvec3& t : surface.triangles) {
      const glm::dvec3& a = surface.positions[t.x];
      const glm::dvec3 cross = glm::cross(surface.positions[t.y] - a, surface.positions[t.z] - a);
      const double length = glm::length(cross);
      if (std::abs(cross.y) > along * length) across_y += length;
      if (std::abs(cross.z) > along * length) across_z += length;
    }
  }
  return across_z > noticeable * across_y;
}

}  // namespace lichtmc
