// Reflectance at a position on a reflectance map.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

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

// ρ at a position on a reflectance map; u and v are finite.
inline double reflectance_at(const ReflectanceMap& reflectance_map, double u, double v) {
  const Between column = pixels_about(u, reflectance_map.columns, reflectance_map.wrap_u);
  const Between row = pixels_about(v, reflectance_map.rows, reflectance_map.wrap_v);
  const float* first = reflectance_map.values.data() + std::size_t{row.first} * reflectance_map.columns;
  const float* second = reflectance_map.values.data() + std::size_t{row.second} * reflectance_map.columns;
  const auto along = [&column](const float* values) {
    return double{values[column.first]} + column.share * (double{values[column.second]} - double{values[column.first]});
  };
  const double a = along(first);
  return a + row.share * (along(second) - a);
}

// The highest reflectance of each surface; with a reflectance map the highest value of the map.
class HighestReflectance {
 public:
  explicit HighestReflectance(const Room& room);
  double of(const Surface& surface) const {
    return surface.reflectance_map ? of_reflectance_map_[*surface.reflectance_map] : surface.reflectance;
  }

 private:
  std::vector<double> of_reflectance_map_;
};

}  // namespace lichtmc
