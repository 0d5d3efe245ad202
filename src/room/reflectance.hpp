// Reflectance at a position on a surface where it varies.
#pragma once

#include <algorithm>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "base/luminance.hpp"
#include "lichtmc/room.hpp"
#include "room/texture_map.hpp"

namespace lichtmc {

// Whether the reflectance of a surface may vary from point to point.
inline bool has_varying_reflectance(const Surface& surface) {
  return surface.reflectance_map.has_value() || !surface.vertex_colours.empty();
}

// ρ at a position on a reflectance map; u and v are finite.
inline double reflectance_at(const ReflectanceMap& reflectance_map, double u, double v) {
  return value_at(reflectance_map, u, v);
}

// ρ at a point of a surface with vertex colours, which have this value there. map: null if the surface has none. Linear
// interpolation and luminance are both linear: without a map this is the interpolated luminance of the vertices.
inline double coloured_reflectance(const glm::dvec3& colour, const ReflectanceMap* map, const glm::dvec2& uv,
                                   double highest) {
  glm::dvec3 product = colour;
  if (map != nullptr)
    product *= map->colours.empty() ? glm::dvec3(value_at(*map, uv.x, uv.y)) : colour_at(*map, uv.x, uv.y);
  return std::min(luminance(product.x, product.y, product.z), highest);
}

// The highest reflectance of each surface; if it varies, a bound: the highest value of its map, times the highest
// luminance of its vertex colours.
class HighestReflectance {
 public:
  explicit HighestReflectance(const Room& room);
  double of(const Surface& surface) const;

 private:
  std::vector<double> of_reflectance_map_;
};

}  // namespace lichtmc
