#include "gltf/texture_image.hpp"

#include <cmath>
#include <cstddef>
#include <vector>

#include <stb/stb_image_write.h>

#include "lichtmc/error.hpp"

namespace lichtmc {

namespace {

// IEC 61966-2-1, from light to the value that stands for it.
double srgb(double light) {
  return light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1.0 / 2.4) - 0.055;
}

void append(void* text, void* bytes, int count) {
  static_cast<std::string*>(text)->append(static_cast<const char*>(bytes), static_cast<std::size_t>(count));
}

}  // namespace

std::string png_of(const ReflectanceMap& map) {
  std::vector<unsigned char> pixels;
  pixels.reserve(map.values.size());
  for (const float value : map.values)
    pixels.push_back(static_cast<unsigned char>(std::lround(255.0 * srgb(double{value}))));
  std::string file;
  const auto columns = static_cast<int>(map.columns);
  const auto rows = static_cast<int>(map.rows);
  if (stbi_write_png_to_func(append, &file, columns, rows, 1, pixels.data(), columns) == 0)
    throw RuntimeError("The reflectance map '" + map.name + "' cannot be written as a picture. Free some memory.");
  return file;
}

}  // namespace lichtmc
