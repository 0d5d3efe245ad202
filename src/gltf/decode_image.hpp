// Decodes images of textures: PNG, JPEG and WebP.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace lichtmc {

// Pixels with three channels (red, green, blue), row by row from the top, with 8 or 16 bits per channel. Alpha is
// dropped.
struct DecodedImage {
  std::uint32_t columns = 0;
  std::uint32_t rows = 0;
  std::vector<std::uint8_t> bytes;   // 3 per pixel; empty for 16 bits
  std::vector<std::uint16_t> words;  // 3 per pixel; empty for 8 bits
  std::string fault;                 // why it was not decoded: "it is a KTX2 image", …; empty if it was
};

// Decodes the content of an image file. The size is checked before memory is taken: at most 2^28 pixels.
DecodedImage decode_image(std::string_view file);

}  // namespace lichtmc
