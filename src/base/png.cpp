#include "base/png.hpp"

#include <cassert>
#include <cmath>
#include <limits>

#include <stb/stb_image_write.h>

#include "lichtmc/error.hpp"

namespace lichtmc {

namespace {

void append(void* text, void* bytes, int count) {
  static_cast<std::string*>(text)->append(static_cast<const char*>(bytes), static_cast<std::size_t>(count));
}

}  // namespace

std::string png_file(std::size_t columns, std::size_t rows, int channels, const std::vector<std::uint8_t>& pixels) {
  assert(pixels.size() == columns * rows * static_cast<std::size_t>(channels));
  // The encoder stores the number of bytes in an int.
  constexpr std::size_t most_bytes = std::numeric_limits<int>::max() / 2;
  std::string file;
  const int stride = static_cast<int>(columns) * channels;
  if (pixels.size() > most_bytes ||
      stbi_write_png_to_func(append, &file, static_cast<int>(columns), static_cast<int>(rows), channels, pixels.data(),
                             stride) == 0) {
    throw RuntimeError("A picture of " + std::to_string(columns) + " × " + std::to_string(rows) +
                       " pixels cannot be encoded. Free some memory, or leave the report out (--no-report).");
  }
  return file;
}

double srgb_of_light(double light) {
  return light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1.0 / 2.4) - 0.055;
}

double light_of_srgb(double value) {
  return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}

}  // namespace lichtmc
