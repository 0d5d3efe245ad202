#include "gltf/texture_source.hpp"

#include <cstdint>
#include <limits>
#include <string_view>

#include "base/message.hpp"
#include "base/read_file.hpp"
#include "gltf/external_files.hpp"

namespace lichtmc {

namespace {

constexpr const char* formats = "PNG, JPEG or WebP";

// The first extension of a texture with an image in a format that is not read.
std::string other_source(const tinygltf::Texture& texture) {
  for (const char* name : {"KHR_texture_basisu", "MSFT_texture_dds", "EXT_texture_avif"}) {
    if (texture.extensions.count(name) != 0) return name;
  }
  return "";
}

// `what`: the image, for messages.
DecodedImage read_image_file(const Document& document, std::size_t index, const std::string& what,
                             const std::string& way_out) {
  // An image of 2^28 pixels has at most 2^31 bytes, if it is not compressed; the decoders count in 31 bits.
  constexpr std::uint64_t most_bytes = std::numeric_limits<std::int32_t>::max();
  const ContainedPath place = locate_uri(document, document.image_uris[index]);
  if (!place.fault.empty()) {
    refuse(document, what + " is not opened: " + place.fault + " (allowed: " + place.allowed + "). " + place.remedy +
                         " " + way_out);
  }
  const FileContent content = read_regular_file(place.path, most_bytes);
  if (content.missing) refuse(document, what + " is missing. Copy it into the folder of the room file. " + way_out);
  if (!content.fault.empty())
    refuse(document, what + " cannot be read (" + content.fault + "; allowed: a regular file). " + way_out);
  return decode_image(content.bytes);
}

}  // namespace

std::optional<std::size_t> image_of_texture(const Document& document, int texture, const std::string& where) {
  const auto& model = document.model;
  const auto& used = model.textures[checked_index(document, texture, model.textures.size(), where)];
  double source = used.source;
  const auto webp = used.extensions.find("EXT_texture_webp");
  if (source < 0 && webp != used.extensions.end()) source = number_in(document, webp->second, "source", -1.0, where);
  if (source < 0) return std::nullopt;
  // Beyond every index if it is not a whole number.
  const auto index = source < 1e9 ? static_cast<long long>(source) : std::numeric_limits<long long>::max();
  return checked_index(document, index, model.images.size(), "the image of " + where);
}

std::string image_name(const Document& document, std::size_t image) {
  const auto& one = document.model.images[image];
  return !one.name.empty() ? one.name : !one.uri.empty() ? one.uri : std::to_string(image);
}

DecodedImage read_texture(const Document& document, int texture, const std::string& where, const std::string& way_out) {
  const auto index = image_of_texture(document, texture, where);
  if (!index) {
    const std::string other = other_source(document.model.textures[static_cast<std::size_t>(texture)]);
    refuse(document, where + " has no image in a format that is read (" + (other.empty() ? "" : other + "; ") +
                         "allowed: " + formats + "). Export its textures as PNG or JPEG. " + way_out);
  }
  const std::string what = "the image " + in_quotes(image_name(document, *index)) + ", " + where + ",";
  DecodedImage image;
  if (!document.image_uris[*index].empty()) {
    image = read_image_file(document, *index, what, way_out);
  } else {
    const auto& bytes = document.images[*index];
    image = decode_image({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  }
  if (!image.fault.empty()) {
    refuse(document, what + " cannot be read (" + image.fault + "; allowed: " + formats +
                         "). Export its textures as PNG or JPEG. " + way_out);
  }
  return image;
}

}  // namespace lichtmc
