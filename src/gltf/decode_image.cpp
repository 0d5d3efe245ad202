#include "gltf/decode_image.hpp"

#include <limits>
#include <memory>
#include <utility>

#include <stb/stb_image.h>
#include <webp/decode.h>

namespace lichtmc {

namespace {

using namespace std::string_view_literals;

constexpr double max_pixels = 0x1p28;

const unsigned char* data_of(std::string_view file) {
  return reinterpret_cast<const unsigned char*>(file.data());
}

bool is_webp(std::string_view file) {
  return file.size() >= 12 && file.substr(0, 4) == "RIFF" && file.substr(8, 4) == "WEBP";
}

// The name of a format that glTF files contain and that is not read; empty for others.
std::string_view other_format(std::string_view file) {
  if (file.substr(0, 7) == "\xABKTX 20"sv) return "KTX2";
  if (file.substr(0, 7) == "\xABKTX 11"sv) return "KTX";
  if (file.substr(0, 4) == "DDS "sv) return "DDS";
  if (file.size() >= 12 && file.substr(4, 4) == "ftyp"sv) return "AVIF or HEIF";
  if (file.substr(0, 5) == "<svg "sv || file.substr(0, 5) == "<?xml"sv) return "SVG";
  return "";
}

// Sets the size of an image; returns the fault if it is too large.
std::string set_size(int columns, int rows, DecodedImage& image) {
  if (columns <= 0 || rows <= 0) return "it has no pixels";
  if (double{1} * columns * rows > max_pixels)
    return "it has " + std::to_string(columns) + " × " + std::to_string(rows) + " pixels, more than 2^28";
  image.columns = static_cast<std::uint32_t>(columns);
  image.rows = static_cast<std::uint32_t>(rows);
  return "";
}

std::string decode_webp(std::string_view file, DecodedImage& image) {
  WebPBitstreamFeatures features;
  if (WebPGetFeatures(data_of(file), file.size(), &features) != VP8_STATUS_OK) return "the WebP image is damaged";
  if (features.has_animation != 0) return "it is an animated WebP image";
  if (std::string fault = set_size(features.width, features.height, image); !fault.empty()) return fault;
  const std::size_t row_bytes = 3 * std::size_t{image.columns};
  image.bytes.resize(row_bytes * image.rows);
  const auto* const end = WebPDecodeRGBInto(data_of(file), file.size(), image.bytes.data(), image.bytes.size(),
                                            static_cast<int>(row_bytes));
  return end == nullptr ? "the WebP image is damaged" : "";
}

// Never empty: the library has faults without a text.
std::string stb_fault() {
  const char* const text = stbi_failure_reason();
  return text != nullptr && *text != '\0' ? text : "the image is damaged";
}

std::string decode_png_or_jpeg(std::string_view file, DecodedImage& image) {
  using Free = void (*)(void*);
  const auto size = static_cast<int>(file.size());
  int columns = 0;
  int rows = 0;
  int channels = 0;
  if (stbi_info_from_memory(data_of(file), size, &columns, &rows, &channels) == 0) return stb_fault();
  if (std::string fault = set_size(columns, rows, image); !fault.empty()) return fault;
  const std::size_t count = 3 * std::size_t{image.columns} * image.rows;
  if (stbi_is_16_bit_from_memory(data_of(file), size) != 0) {
    const std::unique_ptr<stbi_us, Free> pixels(
        stbi_load_16_from_memory(data_of(file), size, &columns, &rows, &channels, 3), stbi_image_free);
    if (!pixels) return stb_fault();
    image.words.assign(pixels.get(), pixels.get() + count);
  } else {
    const std::unique_ptr<stbi_uc, Free> pixels(
        stbi_load_from_memory(data_of(file), size, &columns, &rows, &channels, 3), stbi_image_free);
    if (!pixels) return stb_fault();
    image.bytes.assign(pixels.get(), pixels.get() + count);
  }
  return "";
}

}  // namespace

DecodedImage decode_image(std::string_view file) {
  DecodedImage image;
  const std::string_view other = other_format(file);
  if (file.size() > std::size_t{std::numeric_limits<int>::max()}) {
    image.fault = "it has more than 2^31 bytes";
  } else if (!other.empty()) {
    image.fault = "it is in the format " + std::string(other);
  } else if (is_webp(file)) {
    image.fault = decode_webp(file, image);
  } else {
    image.fault = decode_png_or_jpeg(file, image);
  }
  return image;
}

}  // namespace lichtmc
