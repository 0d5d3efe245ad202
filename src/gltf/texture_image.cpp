#include "gltf/texture_image.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "base/png.hpp"

namespace lichtmc {

namespace {

std::uint8_t pixel_of(double value) {
  return static_cast<std::uint8_t>(std::lround(255.0 * srgb_of_light(value)));
}

std::string grey_png(const TextureMap& map, double white) {
  std::vector<std::uint8_t> pixels;
  pixels.reserve(map.values.size());
  for (const float value : map.values) pixels.push_back(pixel_of(double{value} / white));
  return png_file(map.columns, map.rows, 1, pixels);
}

}  // namespace

std::string reflectance_png(const ReflectanceMap& map) {
  if (map.colours.empty()) return grey_png(map, 1.0);
  std::vector<std::uint8_t> pixels;
  pixels.reserve(3 * map.colours.size());
  for (const glm::vec3& colour : map.colours) {
    for (int k = 0; k < 3; ++k) pixels.push_back(pixel_of(double{colour[k]}));
  }
  return png_file(map.columns, map.rows, 3, pixels);
}

std::string emission_png(const EmissionMap& map) {
  return grey_png(map, highest_value(map));
}

double highest_value(const TextureMap& map) {
  const double highest = double{*std::max_element(map.values.begin(), map.values.end())};
  return highest > 0.0 ? highest : 1.0;
}

}  // namespace lichtmc
