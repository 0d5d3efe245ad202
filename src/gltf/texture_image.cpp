#include "gltf/texture_image.hpp"

#include <cmath>
#include <cstdint>
#include <vector>

#include "base/png.hpp"

namespace lichtmc {

std::string png_of(const ReflectanceMap& map) {
  std::vector<std::uint8_t> pixels;
  pixels.reserve(map.values.size());
  for (const float value : map.values)
    pixels.push_back(static_cast<std::uint8_t>(std::lround(255.0 * srgb_of_light(double{value}))));
  return png_file(map.columns, map.rows, 1, pixels);
}

}  // namespace lichtmc
