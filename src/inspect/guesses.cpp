#include "inspect/guesses.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>

namespace lichtmc {

namespace {

// Longest dimension of rooms, halls and houses, in m.
constexpr double min_length = 1.0;
constexpr double max_length = 200.0;

// Height of a storey in m: the unit that comes closest to it is the most probable.
constexpr double usual_height = 2.7;

// Rooms higher than this exist (naves, atria, arenas). It is doubtful if in another unit the height would be that of a
// storey: between the lowest attics and small halls. Such a room is a hall of 75 m to 236 m in height if it is in
// metres, and a storey if it is in inches.
constexpr double high_room = 30.0;
constexpr double lowest_storey = 1.9;
constexpr double highest_storey = 6.0;

constexpr std::array<LengthUnit, 4> other_units{
    {{"centimetres", 0.01}, {"millimetres", 0.001}, {"inches", 0.0254}, {"feet", 0.3048}}};

}  // namespace

std::optional<LengthUnit> guess_unit(const glm::dvec3& size) {
  const double length = std::max({size.x, size.y, size.z});
  const bool plausible_length = length >= min_length && length <= max_length;
  if (plausible_length && size.y <= high_room) return std::nullopt;
  std::optional<LengthUnit> best;
  double min_deviation = std::numeric_limits<double>::infinity();
  for (const LengthUnit& unit : other_units) {
    const double metres = length * unit.metres;
    if (metres < min_length || metres > max_length) continue;
    const double height = std::max(size.y, 1e-3 * length) * unit.metres;
    if (plausible_length && (height < lowest_storey || height > highest_storey)) continue;
    const double deviation = std::abs(std::log(height / usual_height));
    if (deviation >= min_deviation) continue;
    min_deviation = deviation;
    best = unit;
  }
  return best;
}

bool looks_z_up(const Room& room, const glm::dvec3& size) {
  if (size.z > size.y) return false;
  constexpr double along = 0.99;  // cosine: within 8° of the axis
  constexpr double noticeable = 1.5;
  double normal_y = 0.0;  // twice the area of triangles with a normal along ±y
  double normal_z = 0.0;
  for (const Surface& surface : room.surfaces) {
    for (const glm::uvec3& t : surface.triangles) {
      const glm::dvec3& a = surface.positions[t.x];
      const glm::dvec3 cross = glm::cross(surface.positions[t.y] - a, surface.positions[t.z] - a);
      const double length = glm::length(cross);
      if (std::abs(cross.y) > along * length) normal_y += length;
      if (std::abs(cross.z) > along * length) normal_z += length;
    }
  }
  return normal_z > noticeable * normal_y;
}

}  // namespace lichtmc
