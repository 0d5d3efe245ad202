// Values at a position on a texture map.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include "lichtmc/room.hpp"

namespace lichtmc {

// The two neighbouring values of a texture coordinate, and its relative distance from the first to the second. Values
// are at the centres of their pixels: the first of n at 0.5/n (glTF 2.0 specification, section 3.8.3).
struct Between {
  std::uint32_t first = 0;
  std::uint32_t second = 0;
  double share = 0.0;
};

inline Between pixels_about(double coordinate, std::uint32_t count, Wrap wrap) {
  // Reduced to one period of the image.
  double place = coordinate;
  if (wrap == Wrap::repeat) {
    place -= std::floor(place);
  } else if (wrap == Wrap::mirror) {
    place -= 2.0 * std::floor(0.5 * place);
    if (place > 1.0) place = 2.0 - place;
  } else {
    place = place < 0.0 ? 0.0 : place > 1.0 ? 1.0 : place;
  }
  const double pixel = place * count - 0.5;
  const double low = std::floor(pixel);
  const std::uint32_t last = count - 1;
  Between between;
  between.share = pixel - low;
  // Beyond an edge a repeated image continues with the opposite edge, any other with the same edge.
  between.first = low >= 0.0 ? static_cast<std::uint32_t>(low) : (wrap == Wrap::repeat ? last : 0);
  between.second = low + 1.0 < count ? static_cast<std::uint32_t>(low + 1.0) : (wrap == Wrap::repeat ? 0 : last);
  return between;
}

// The weighted mean of the four pixels about a position; u and v are finite. `pixels`: of the map, row by row.
template <class Value, class Pixel>
Value interpolate(const TextureMap& map, const std::vector<Pixel>& pixels, double u, double v) {
  const Between column = pixels_about(u, map.columns, map.wrap_u);
  const Between row = pixels_about(v, map.rows, map.wrap_v);
  const Pixel* first = pixels.data() + std::size_t{row.first} * map.columns;
  const Pixel* second = pixels.data() + std::size_t{row.second} * map.columns;
  const auto along = [&column](const Pixel* values) -> Value {
    return Value{values[column.first]} + column.share * (Value{values[column.second]} - Value{values[column.first]});
  };
  const Value a = along(first);
  return a + row.share * (along(second) - a);
}

inline double value_at(const TextureMap& map, double u, double v) {
  return interpolate<double>(map, map.values, u, v);
}

// The map must have colours.
inline glm::dvec3 colour_at(const TextureMap& map, double u, double v) {
  return interpolate<glm::dvec3>(map, map.colours, u, v);
}

}  // namespace lichtmc
